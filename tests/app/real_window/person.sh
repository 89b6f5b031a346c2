#!/usr/bin/env bash
# person.sh PROGRAM SCRIPT FOLDER: works the window with the mouse and keys of the display, while the script in it
# says what is reached. FOLDER holds assets/; pictures and states are left there.
set -euo pipefail
source "$(dirname "$0")/hand.sh"
program=$1 script=$2 folder=$3
cd "$folder"
begin "$program" "$script" assets/scenes/crossing.json

to opened.txt viewport 200 200
pull orbited.txt 12 1

# From the left over the scene until there is a box under the mouse.
to orbited.txt viewport -300 0
move_until over-box.txt 12 0
xdotool click 1
reached box.txt
xdotool click 3
reached menu.txt
click menu.txt context.edit.copy_figures 0 0
reached copied.txt

click box.txt tree.kind 0 0
reached kinds.txt
click kinds.txt tree.kind.umobb 0 0
reached kind.txt
to kind.txt tree.leaf 0 0
xdotool click --repeat 2 --delay 100 1 sleep 0.5 key ctrl+a type 6
xdotool key Return
reached leaf.txt

click leaf.txt query.0 0 0
reached query.txt
click query.txt agent.1 0 0
reached agent.txt
to agent.txt handle.shift 0 0
pull hit.txt 0 4
reached dragged.txt

xdotool key shift+Left
reached first.txt
xdotool key Right key Right key Right
reached third.txt
xdotool key h
reached stepped.txt

xdotool key ctrl+p
xdotool type --delay 30 history
xdotool key Return
reached history.txt
click history.txt history.0 0 0
reached gone-back.txt
again undone.txt Escape
again redone.txt ctrl+y
xdotool key ctrl+s
reached saved.txt
xdotool key ctrl+o
reached dialog.txt
xdotool type --delay 30 crossing.json
xdotool key Return
reached reopened.txt
reached narrow.txt
click narrow.txt toolbar.more 0 0
reached more.txt
click more.txt toolbar.view.moment 0 0
wait "$watching"
