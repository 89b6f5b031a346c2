#!/usr/bin/env bash
# lost.sh PROGRAM FOLDER: windows end in all the ways that are not asked about, each with an agent duplicated that was
# not saved; the next one restores it. FOLDER holds assets/; how each ended is left in its ends.txt, the settings in
# config/, and copies in state/.
set -euo pipefail
shopt -s nullglob
command -v xdotool >/dev/null || { echo "xdotool is not installed" >&2; exit 77; }
program=$1 folder=$2
cd "$folder"
export XDG_CONFIG_HOME=$folder/config XDG_STATE_HOME=$folder/state
# Who is started in the background ignores Ctrl+C, which is no signal to try here.
trap 'kill -9 $(jobs -p) 2>/dev/null || true' EXIT

# start TITLE [FILE]: the program, until its window has that title.
start() {
  local title=$1
  shift
  "$program" "$@" 2>>errors.txt &
  watching=$!
  # There may be two.
  window=$(timeout 60 xdotool search --sync --onlyvisible --name "^$title - Mobbscope" | head -1)
  xdotool windowfocus --sync "$window"
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
# Until so many copies are kept.
kept() {
  local copies
  for _ in $(seq 400); do
    copies=(state/mobbscope/unsaved/*/*.unsaved)
    [ "${#copies[@]}" -eq "$1" ] && return
    sleep 0.05
  done
  echo "${#copies[@]} copies are kept, not $1" >&2
  exit 1
}
duplicate() {
  xdotool key ctrl+p
  xdotool type 'select agent'
  xdotool key Return key Return
  xdotool key ctrl+d
  titled 'crossing.json*'
}
ended() {
  local status=0
  wait "$watching" || status=$?
  echo "$1 $status" >>ends.txt
}
restore() {
  start crossing
  xdotool key ctrl+p
  xdotool type 'restore unsaved'
  xdotool key Return key Return
  titled 'crossing.json*'
}

start crossing.json assets/scenes/crossing.json
duplicate
kept 1
kill -9 "$watching"
ended killed
restore
xdotool key ctrl+s
titled crossing.json
kept 0
# Before a copy is due.
duplicate
kill -TERM "$watching"
ended terminated
kept 1
restore
kill -HUP "$watching"
ended hung-up
kept 1
restore
# Two at once: the recent files of both are kept, whichever is closed last.
first=$watching
start walk assets/clips/walk.glb
kill -TERM "$watching"
ended second
watching=$first
kept 1
kill -9 "$XVFB_PROCESS"
ended without-display
kept 1
