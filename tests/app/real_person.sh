#!/usr/bin/env bash
# real_person.sh PROGRAM SCRIPT FOLDER: works the window with the mouse and keys of the display, while the script in it
# says what is reached. FOLDER holds assets/; pictures and states are left there.
set -euo pipefail
command -v xdotool >/dev/null || { echo "xdotool is not installed" >&2; exit 77; }
program=$1 script=$2 folder=$3
cd "$folder"
"$program" --size 1280x800 --script "$script" assets/scenes/crossing.json &
watching=$!
trap 'kill "$watching" 2>/dev/null || true' EXIT

# Ends with the script's status if it has ended.
watch() {
  kill -0 "$watching" 2>/dev/null && return
  local status=0
  wait "$watching" || status=$?
  exit $((status > 0 ? status : 1))
}
# Until the script has written the file.
reached() {
  until [ -e "$1" ]; do
    watch
    sleep 0.02
  done
}
# to MARKS NAME RIGHT DOWN: the mouse to pixels from the middle of a widget; from its left or right end with L or R.
to() {
  local x y
  read -r x y < <(awk -v name="$2" -v right="$3" -v down="$4" '
    $1 == name { printf "%d %d\n", ($2 + $4) / 2 + right, ($3 + $5) / 2 + down }' "$1") || {
    echo "no $2 in $1" >&2
    exit 1
  }
  xdotool mousemove $((x0 + x)) $((y0 + y))
}
click() {
  to "$@"
  xdotool click 1
}
# pull FILE RIGHT DOWN: with the button held, step by step until the script has written the file.
pull() {
  xdotool mousedown 1
  for _ in $(seq 200); do
    xdotool mousemove_relative -- "$2" "$3"
    watch
    sleep 0.03
    [ -e "$1" ] && break
  done
  xdotool mouseup 1
  reached "$1"
}
# again FILE CHORD: the same key until the script has written the file.
again() {
  for _ in $(seq 200); do
    xdotool key "$2"
    watch
    sleep 0.1
    [ -e "$1" ] && break
  done
  reached "$1"
}

reached opened.txt
window=$(xdotool search --onlyvisible --name Mobbscope | head -1)
x0=0 y0=0
eval "$(xdotool getwindowgeometry --shell "$window" | sed -n 's/^X=/x0=/p; s/^Y=/y0=/p')"
xdotool windowfocus --sync "$window"

to opened.txt viewport 200 200
pull orbited.txt 12 1

# From the left over the scene until there is a box under the mouse.
to orbited.txt viewport -300 0
for _ in $(seq 200); do
  xdotool mousemove_relative -- 12 0
  watch
  sleep 0.06
  [ -e over-box.txt ] && break
done
reached over-box.txt
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
click kind.txt tree.leaf -40 0
xdotool key ctrl+a type 6
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
