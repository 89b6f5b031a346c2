#!/usr/bin/env bash
# run_script.sh PROGRAM SCRIPT ASSETS FOLDER: runs the script headless in a new FOLDER with a copy of the assets and
# files for it to open; its exit status is the program's. What the script writes stays there.
set -euo pipefail
program=$1 script=$2 assets=$3 folder=$4
rm -rf "$folder"
mkdir -p "$folder/clips/deeper" "$folder/nothing"
cp -r "$assets" "$folder/assets"
cd "$folder"

walk() {
  awk -v turn="$1" 'BEGIN {
    print "t,x,y,r"
    for (i = 0; i < 60; ++i) printf "%.4f,%.4f,%.4f,0.4\n", i / 30, i / 30, turn * i * i / 3600 }'
}
walk 0 >clips/straight.csv
walk 1 >clips/left.csv
walk -1 >clips/right.csv
cp clips/left.csv clips/deeper/other.csv
mkdir seventeen
for i in $(seq -w 17); do cp clips/left.csv "seventeen/clip$i.csv"; done
cp clips/left.csv going.csv
printf '{"clips": {"a": {"dt": 1, "samples": [[0, 0, 0.3], [1, 0, 0.3]]}}, "view": {"query": 7}}' >query-out-of-range.json
printf '{"clips": {}}' >no-clips.json
printf '{"clips":\n oops}' >broken.json
printf 't,x,y,r\n0,0,0,0.3\n1,\0,0,0.3\n' >nul.csv
printf 'HIERARCHY\n' >short.bvh
: >empty.json
# A crowd on a grid, of which neighbours are asked.
awk 'BEGIN {
  printf "{\"clips\": {\"straight\": {\"source\": \"clips/straight.csv\"}, \"left\": {\"source\": \"clips/left.csv\"}},\n\"agents\": ["
  for (i = 0; i < 1000; ++i)
    printf "%s{\"name\": \"P%d\", \"clip\": \"%s\", \"translate\": [%d, %d], \"rotate_deg\": %d, \"start\": %.2f}", i ? ",\n" : "",
      i, i % 2 ? "straight" : "left", 2 * (i % 40), 2 * int(i / 40), i * 37 % 360, i % 7 / 10
  printf "],\n\"queries\": ["
  for (i = 0; i + 1 < 1000; ++i) printf "%s{\"a\": \"P%d\", \"b\": \"P%d\"}", i ? ",\n" : "", i, i + 1
  print "]}" }' >thousand.json
# The same without queries: all pairs are asked.
sed 's/^"queries.*/"queries": []}/; /^{"a"/d' thousand.json >all-pairs.json
# A run of 24 people; its clips lie with the assets.
sed 's#../../../../assets/#assets/#' "$(dirname "$script")/../goldens/files/run.json" >run.json
"$program" --headless --size 1024x640 --script "$script" assets/scenes/crossing.json
