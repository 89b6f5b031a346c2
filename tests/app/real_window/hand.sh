# Sourced by the scripts that work the window with the mouse and keys of the display, while a script in the window says what
# is reached: each file of marks that it writes says that a state is.
command -v xdotool >/dev/null || { echo "xdotool is not installed" >&2; exit 77; }

# begin PROGRAM SCRIPT ARGUMENT...: the window of these arguments, once the script has written opened.txt.
begin() {
  "$1" "${@:3}" --size 1280x800 --script "$2" &
  watching=$!
  trap 'kill "$watching" 2>/dev/null || true' EXIT
  reached opened.txt
  local window
  window=$(xdotool search --onlyvisible --name Mobbscope | head -1)
  x0=0 y0=0
  eval "$(xdotool getwindowgeometry --shell "$window" | sed -n 's/^X=/x0=/p; s/^Y=/y0=/p')"
  xdotool windowfocus --sync "$window"
}
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
# to MARKS NAME [RIGHT DOWN]: the mouse to pixels from the middle of a widget.
to() {
  local x y
  read -r x y < <(awk -v name="$2" -v right="${3:-0}" -v down="${4:-0}" '
    $1 == name { printf "%d %d\n", ($2 + $4) / 2 + right, ($3 + $5) / 2 + down }' "$1") || {
    echo "no $2 in $1" >&2
    exit 1
  }
  xdotool mousemove $((x0 + x)) $((y0 + y))
}
# click MARKS NAME [RIGHT DOWN [BUTTON]]: a frame goes by under the mouse before the button goes down.
click() {
  to "$@"
  sleep 0.2
  xdotool click "${5:-1}"
}
# repeat FILE PAUSE COMMAND...: over and over, with so many seconds between, until the script has written the file.
repeat() {
  for _ in $(seq 200); do
    "${@:3}"
    watch
    sleep "$2"
    [ -e "$1" ] && break
  done
}
# move_until FILE RIGHT DOWN: step by step until the script has written the file.
move_until() {
  repeat "$1" 0.06 xdotool mousemove_relative -- "$2" "$3"
  reached "$1"
}
# pull FILE RIGHT DOWN: with the button held, step by step until the script has written the file.
pull() {
  xdotool mousedown 1
  repeat "$1" 0.03 xdotool mousemove_relative -- "$2" "$3"
  xdotool mouseup 1
  reached "$1"
}
# again FILE CHORD: the same key until the script has written the file.
again() {
  repeat "$1" 0.1 xdotool key "$2"
  reached "$1"
}
