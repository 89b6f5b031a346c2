#!/usr/bin/env bash
# import.sh PROGRAM SCRIPT SCENE: mends the unit of the scene's first clip by hand, beginning with the button of its
# warning, while the script in the window says what is reached.
set -euo pipefail
source "$(dirname "$0")/hand.sh"
cd "$(dirname "$3")"
begin "$1" "$2" "$3"

click opened.txt message.0.offer 0 0
reached dialog.txt
# Two clicks.
click dialog.txt import.unit 0 0
reached units.txt
click units.txt import.unit.cm 0 0
reached mended.txt
# What no clip can have is said at its field.
to mended.txt import.fps 0 0
xdotool keydown ctrl click 1 keyup ctrl
xdotool key ctrl+a type 0
xdotool key Return
reached refused.txt
again undone.txt ctrl+z
again redone.txt ctrl+y
# How its disks move between samples.
click redone.txt import.motion 0 0
reached motions.txt
click motions.txt import.motion.linear 0 0
reached linear.txt
to linear.txt import.trim.begin 0 0
pull trimmed.txt 6 0
reached released.txt
xdotool key Escape
reached closed.txt
wait "$watching"
