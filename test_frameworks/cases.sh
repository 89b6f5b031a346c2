#!/bin/sh
# What CTest runs for a folder of cases.
#   cases.sh draw JUNIT PROGRAM ARGUMENT...  draws them; fails unless the program has told of the cases in JUNIT
#   cases.sh tell JUNIT OUTPUT NAME          what it told of one: exits with 0 if it passed, with 77 if it was skipped
#   cases.sh fail WORDS                      for what cannot be a test
set -u
refuse() {
  printf '%s\n' "$1" >&2
  exit 1
}
case $1 in
draw)
  junit=$2
  shift 2
  # What an earlier run told is not true of this one.
  rm -f "$junit" || refuse "$junit cannot be removed"
  status=0
  "$@" || status=$?
  case $status in
  0 | 1 | 3) ;;  # cases failed, or there is no OpenGL: each case tells that
  *) refuse "the cases could not be drawn (exit status $status)" ;;
  esac
  [ -s "$junit" ] || refuse "the cases could not be drawn (exit status $status): there is no $junit"
  ;;
tell)
  junit=$2 words=$3/$4.txt
  [ -s "$junit" ] || refuse "there is no $junit: the cases have not been drawn"
  name=$(printf '%s' "$4" | sed "s/&/\\&amp;/g; s/</\\&lt;/g; s/>/\\&gt;/g; s/\"/\\&quot;/g; s/'/\\&#39;/g")
  found=$(name=" name=\"$name\"" awk '
    index($0, "<testcase ") && index($0, ENVIRON["name"]) { inside = 1; found = "passed" }
    inside && (index($0, "<failure") || index($0, "<error")) { found = "failed" }
    inside && index($0, "<skipped") { found = "skipped" }
    inside && index($0, "</testcase>") { print found; exit }' "$junit")
  [ "$found" ] || refuse "$junit does not tell of it: the case was not drawn"
  [ "$found" = passed ] && exit 0
  if [ -f "$words" ]; then cat "$words"; else echo "$found: see $junit"; fi
  [ "$found" = skipped ] && exit 77
  exit 1
  ;;
*) refuse "${2-}" ;;
esac
