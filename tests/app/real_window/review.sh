#!/usr/bin/env bash
# review.sh PROGRAM SCRIPT FOLDER: looks at the picture tests in FOLDER/cases with the mouse and keys of the display,
# while the script says what is reached.
set -euo pipefail
source "$(dirname "$0")/hand.sh"
cd "$3"
begin "$1" "$2" review cases

# titled NAME: the window's title begins with it.
titled() {
  xdotool search --onlyvisible --name "^$1.* - Mobbscope$" >/dev/null || { echo "no window is called $1" >&2; exit 1; }
}
titled cases
click opened.txt case.moved
reached shown.txt
xdotool key 5
reached slider.txt
to slider.txt review.divider
xdotool sleep 0.2 mousedown 1 sleep 0.2 mousemove_relative -- -80 0 sleep 0.2 mouseup 1
reached dragged.txt
click dragged.txt review.accept
reached accepted.txt
xdotool key ctrl+z
reached undone.txt
xdotool key Return
reached scene.txt
titled moved
click scene.txt review.back
reached back.txt
xdotool key Escape
reached left.txt
wait "$watching"
