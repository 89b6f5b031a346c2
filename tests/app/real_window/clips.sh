#!/usr/bin/env bash
# clips.sh PROGRAM SCRIPT FOLDER: opens FOLDER/clips and hides all but two of them with the mouse and keys of the
# display, while the script says what is reached. Pictures and states are left in FOLDER.
set -euo pipefail
source "$(dirname "$0")/hand.sh"
cd "$3"
begin "$1" "$2" clips

click opened.txt agent.0.solo
reached alone.txt
click alone.txt clip.4.eye
reached two.txt
xdotool key shift+v
reached all.txt
click all.txt agent.4 0 0 3
reached open.txt
click open.txt context.agents.hide
reached menu.txt
trap - EXIT
wait "$watching"
