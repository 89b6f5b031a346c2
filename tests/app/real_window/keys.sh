#!/usr/bin/env bash
# keys.sh PROGRAM ASSETS SCRIPT FOLDER: works the window by the keyboard of the display alone, while a script
# watches and says by files of marks which state is reached.
set -euo pipefail
command -v xdotool >/dev/null || { echo "xdotool is not installed" >&2; exit 77; }
program=$1 assets=$2 script=$3 folder=$4
cp -r "$assets" "$folder/assets"
cd "$folder"
"$program" --size 1280x800 --script "$script" assets/scenes/crossing.json &
watching=$!

reached() {
  for _ in $(seq 600); do
    [ -s "$1" ] && return
    kill -0 "$watching" 2>/dev/null || { wait "$watching" && exit 1 || exit "$?"; }
    sleep 0.1
  done
  echo "$1 was never reached" >&2
  kill "$watching"
  exit 1
}

# Keys one after the other until the state is reached that the file tells.
keys() {
  local file=$1
  shift
  for key in "$@"; do
    xdotool key --delay 40 "$key"
    sleep 0.1
  done
  reached "$file"
}

reached opened.txt
window=$(xdotool search --onlyvisible --name Mobbscope | head -1)
xdotool windowfocus --sync "$window"
keys query.txt Next
keys menu.txt F10
keys submenu.txt t Escape alt+t Right
keys kind.txt Down Return
keys kept.txt Escape Escape
keys focus.txt Tab
keys dropdown.txt Tab Tab Tab Tab Tab Tab Return
keys chosen.txt Up Return
keys left.txt Escape
keys alone.txt alt
keys stepped.txt Escape shift+Left Right
keys asked.txt Menu
# The modifier is let go before the key, as fast hands do.
xdotool key --delay 40 Escape ctrl+shift+s
sleep 0.5
xdotool key End keydown ctrl sleep 0.2 keydown a keyup ctrl keyup a sleep 0.2 type --delay 40 made.json
keys saved.txt Return
wait "$watching"
