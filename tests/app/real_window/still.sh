#!/usr/bin/env bash
# still.sh PROGRAM SCRIPT FOLDER: what must move no camera, and what must, with the mouse and keys of the display, while the
# script says what is reached. FOLDER holds assets/; states are left there.
set -euo pipefail
source "$(dirname "$0")/hand.sh"
cd "$3"
begin "$1" "$2" assets/scenes/crossing.json

# Nothing of this moves it.
click opened.txt query.0
reached query.txt
xdotool key shift+Left
reached first.txt
xdotool key Right key Right key Right
reached third.txt
xdotool key q
reached left.txt
xdotool key e
reached leaves.txt
xdotool key period
reached time.txt
click time.txt tree.kind
reached kinds.txt
click kinds.txt tree.kind.umobb
reached kind.txt
to kind.txt viewport -300 0
move_until over-box.txt 12 0
xdotool click 1
reached selected.txt

# The mouse turns it, and steps leave it so.
to selected.txt viewport 200 200
pull turned.txt 12 1
click turned.txt query.0
reached turned-query.txt
xdotool key shift+Left
reached turned-step.txt

# From the front, wherever the mouse had left it: F, Home, another size of the window.
xdotool key 3
reached front.txt
click front.txt agent.1
reached agent.txt
xdotool key f
reached framed.txt
xdotool key Home
reached home.txt
xdotool windowsize "$(xdotool search --onlyvisible --name Mobbscope | head -1)" 1280 700
reached resized.txt

# It goes to the test where that is asked for.
for _ in $(seq 8); do xdotool key equal; done
reached near.txt
xdotool key ctrl+p
reached palette.txt
xdotool type --delay 30 "follow the test"
xdotool key Return
reached following.txt
trap - EXIT
wait "$watching"
