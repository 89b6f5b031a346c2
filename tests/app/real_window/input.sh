#!/usr/bin/env bash
# input.sh PROGRAM FOLDER: drags the window's left border with the mouse of the display while a script watches.
set -euo pipefail
command -v xdotool >/dev/null || { echo "xdotool is not installed" >&2; exit 77; }
program=$1 folder=$2
cat >"$folder/watch.script" <<'SCRIPT'
marks
wait 4
marks
picture window.png
SCRIPT
cd "$folder"
"$program" --size 1280x700 --script watch.script >marks.txt &
watching=$!
window=$(timeout 20 xdotool search --sync --onlyvisible --name Mobbscope | head -1)
read -r x0 y0 < <(xdotool getwindowgeometry --shell "$window" | sed -n 's/^[XY]=//p' | tr '\n' ' '; echo)
xdotool mousemove $((x0 + 258)) $((y0 + 300)) sleep 0.3 mousedown 1 sleep 0.3 mousemove_relative 30 0 sleep 0.2 \
  mousemove_relative 30 0 sleep 0.3 mouseup 1
wait "$watching"
