#!/usr/bin/env bash
# run_suite.sh PROGRAM SUITE: the cases of a suite of GoogleTest in one process, which crash with it: then one by one, so that
# it is seen which does. MOBBSCOPE_LEAVE_OUT: cases that are left out, as --gtest_filter names them, with ':' between.
# Exit status: 77 if all were skipped or left out.
set -u
program=$1 suite=$2
but=${MOBBSCOPE_LEAVE_OUT:+-$MOBBSCOPE_LEAVE_OUT}
said=$(mktemp)
trap 'rm -f "$said"' EXIT

"$program" --gtest_filter="$suite.*$but" >"$said" 2>&1
status=$?
cat "$said"
if [ "$status" -gt 1 ]; then
  echo "$suite ended with status $status; its cases one by one:"
  "$program" --gtest_filter="$suite.*$but" --gtest_list_tests | sed -n 's/^  \([^ ]*\).*/\1/p' | while read -r name; do
    "$program" --gtest_brief=1 --gtest_filter="$suite.$name" || echo "$suite.$name ended with status $?"
  done
  exit "$status"
fi
if [ "$status" -eq 0 ] && ! grep -q '^\[       OK \]' "$said"; then exit 77; fi
exit "$status"
