#!/usr/bin/env bash
# ci_recipe.sh PROGRAM CI_MD FOLDER: types what the walk-through in docs/ci.md says, its `sh` blocks, into a new folder of
# a person without settings. A line that ends with "# exits with N" must. Exits with 77 where there is no OpenGL.
set -euo pipefail
program=$1 document=$2 folder=$3
rm -rf "$folder"
mkdir -p "$folder/bin" "$folder/home" "$folder/work"
ln -s "$program" "$folder/bin/mobbscope"

{
  echo 'exits() { local expected=$1 status=0; shift; "$@" || status=$?; [ $status -eq $expected ] || { echo "exits with $status: $*"; exit 1; }; }'
  awk '/^```sh$/ { inside = 1; next } /^```$/ { inside = 0 } inside' "$document" |
    sed -E 's/^(.*[^ ]) +# exits with ([0-9]+)$/exits \2 \1/'
} >"$folder/commands"
[ "$(grep -c mobbscope "$folder/commands")" -ge 5 ] || { echo "$document: the walk-through is gone"; exit 1; }

# Both jobs call the program as the walk-through does.
call='mobbscope test pictures --output report/pictures --junit report/junit.xml --html report/index.html'
[ "$(grep -cF "$call" "$document")" -eq 3 ] || { echo "$document: the jobs and the walk-through differ"; exit 1; }

status=0
printf '{"clips": {"a": {"dt": 1, "samples": [[0, 0, 1]]}}}' >"$folder/probe.json"
"$program" render "$folder/probe.json" --size 64x64 -o "$folder/probe.png" || status=$?
[ "$status" -ne 3 ] || exit 77

cd "$folder/work"
# Sanitizers keep what they were told.
kept=(${ASAN_OPTIONS:+"ASAN_OPTIONS=$ASAN_OPTIONS"} ${UBSAN_OPTIONS:+"UBSAN_OPTIONS=$UBSAN_OPTIONS"})
env -i "${kept[@]}" PATH="$folder/bin:$PATH" HOME="$folder/home" bash -euo pipefail "$folder/commands"
# What was promised is there.
grep -q '<failure' report/junit.xml
grep -q 'mobbscope test pictures --update meeting' report/index.html
