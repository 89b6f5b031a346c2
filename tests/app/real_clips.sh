#!/usr/bin/env bash
# real_clips.sh PROGRAM SCRIPT FOLDER: opens FOLDER/clips and hides all but two of them with the mouse and keys of the
# display, while the script says what is reached. Pictures and states are left in FOLDER.
set -euo pipefail
command -v xdotool >/dev/null || { echo "xdotool is not installed" >&2; exit 77; }
program=$1 script=$2 folder=$3
cd "$folder"
"$program" --size 1280x800 --script "$script" clips &
watching=$!
trap 'kill "$watching" 2>/dev/null || true' EXIT

# Until the script has written the file; ends with the script's status if it has ended.
reached() {
  until [ -e "$1" ]; do
    if ! kill -0 "$watching" 2>/dev/null; then
      local status=0
      wait "$watching" || status=$?
      exit $((status > 0 ? status : 1))
    fi
    sleep 0.02
  done
}
# click MARKS NAME [BUTTON]: in the middle of a widget.
click() {
  local x y
  read -r x y < <(awk -v name="$2" '$1 == name { printf "%d %d\n", ($2 + $4) / 2, ($3 + $5) / 2 }' "$1")
  xdotool mousemove $((x0 + x)) $((y0 + y)) sleep 0.2 click "${3:-1}"
}

reached opened.txt
window=$(xdotool search --onlyvisible --name Mobbscope | head -1)
x0=0 y0=0
eval "$(xdotool getwindowgeometry --shell "$window" | sed -n 's/^X=/x0=/p; s/^Y=/y0=/p')"
xdotool windowfocus --sync "$window"

click opened.txt agent.0.solo
reached alone.txt
click alone.txt clip.4.eye
reached two.txt
xdotool key shift+v
reached all.txt
click all.txt agent.4 3
reached open.txt
click open.txt context.agents.hide
reached menu.txt
trap - EXIT
wait "$watching"
