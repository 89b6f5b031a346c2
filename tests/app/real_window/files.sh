#!/usr/bin/env bash
# files.sh PROGRAM FOLDER: opens three clips by the dialog alone, with the keys of the display, ends the program, and
# reopens what was open. FOLDER holds assets/; the settings are left in its config/.
set -euo pipefail
command -v xdotool >/dev/null || { echo "xdotool is not installed" >&2; exit 77; }
program=$1 folder=$2
cd "$folder"
export XDG_CONFIG_HOME=$folder/config
trap 'kill "$watching" 2>/dev/null || true' EXIT

# start TITLE [FILE]: the program, until its window has that title.
start() {
  local title=$1
  shift
  "$program" "$@" &
  watching=$!
  window=$(timeout 60 xdotool search --sync --onlyvisible --name Mobbscope | head -1)
  xdotool windowfocus --sync "$window"
  titled "$title"
}
titled() {
  for _ in $(seq 600); do
    [ "$(xdotool getwindowname "$window")" = "$1 - Mobbscope" ] && return
    kill -0 "$watching"
    sleep 0.05
  done
  echo "the window is called $(xdotool getwindowname "$window"), not $1" >&2
  exit 1
}
finish() {
  xdotool key ctrl+q
  wait "$watching"
}

start crossing.json assets/scenes/crossing.json
xdotool windowsize --sync "$window" 1100 720
xdotool key ctrl+o
# From the folder of the scene up to the assets, and into the clips: bend, circle, run.
xdotool key BackSpace type clips
xdotool key Return key shift+Down key shift+Down key Return
titled '3 files'
finish

start crossing
xdotool getwindowgeometry --shell "$window" >geometry.txt
xdotool key ctrl+p
xdotool type 'reopen last'
xdotool key Return
titled '3 files'
finish
