#!/usr/bin/env bash
# real_review.sh PROGRAM SCRIPT FOLDER: looks at the picture tests in FOLDER/cases with the mouse and keys of the display,
# while the script says what is reached.
set -euo pipefail
command -v xdotool >/dev/null || { echo "xdotool is not installed" >&2; exit 77; }
program=$1 script=$2 folder=$3
cd "$folder"
"$program" review cases --size 1280x800 --script "$script" &
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
# click MARKS NAME: in the middle of a widget.
click() {
  local x y
  read -r x y < <(awk -v name="$2" '$1 == name { printf "%d %d\n", ($2 + $4) / 2, ($3 + $5) / 2 }' "$1") || {
    echo "no $2 in $1" >&2
    exit 1
  }
  xdotool mousemove $((x0 + x)) $((y0 + y))
  # A frame under the mouse before the button goes down.
  sleep 0.1
  xdotool click 1
}

reached opened.txt
window=$(xdotool search --onlyvisible --name Mobbscope | head -1)
x0=0 y0=0
eval "$(xdotool getwindowgeometry --shell "$window" | sed -n 's/^X=/x0=/p; s/^Y=/y0=/p')"
xdotool windowfocus --sync "$window"

click opened.txt case.moved
reached shown.txt
xdotool key 5
reached slider.txt
read -r x y < <(awk '$1 == "review.divider" { printf "%d %d\n", ($2 + $4) / 2, ($3 + $5) / 2 }' slider.txt)
xdotool mousemove $((x0 + x)) $((y0 + y)) sleep 0.2 mousedown 1 sleep 0.2 mousemove_relative -- -80 0 sleep 0.2 mouseup 1
reached dragged.txt
click dragged.txt review.accept
reached accepted.txt
xdotool key ctrl+z
reached undone.txt
xdotool key Return
reached scene.txt
click scene.txt review.back
reached back.txt
xdotool key Escape
reached left.txt
wait "$watching"
