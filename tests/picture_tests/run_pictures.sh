#!/usr/bin/env bash
# run_pictures.sh PROGRAM FOLDER BACKEND OUTPUT: the cases of a folder, with a report at OUTPUT.html. The exit status is
# the program's: 3, which CTest takes as skipped, where there is no such backend; 1 then too if MOBBSCOPE_REQUIRE_GL,
# such as "osmesa,egl", names it.
set -uo pipefail
program=$1 folder=$2 backend=$3 output=$4
mkdir -p "$(dirname "$output")"
"$program" test "$folder" --backend "$backend" --output "$output" --html "$output.html"
status=$?
if [ "$status" -eq 3 ] && [[ ",${MOBBSCOPE_REQUIRE_GL-}," == *",$backend,"* ]]; then
  echo "required by MOBBSCOPE_REQUIRE_GL"
  exit 1
fi
exit "$status"
