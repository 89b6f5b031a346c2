#!/usr/bin/env bash
# under_xvfb.sh COMMAND...: runs it on a virtual display of its own; its exit status is the command's, 77 without Xvfb.
# XVFB_PROCESS is the server's number.
set -euo pipefail
command -v Xvfb >/dev/null || { echo "Xvfb is not installed" >&2; exit 77; }
number=$(mktemp)
# The server picks a number that is free. Where its last client leaves it would begin anew, and refuse clients meanwhile.
Xvfb -displayfd 3 -screen 0 1600x1000x24 -nolisten tcp -noreset 3>"$number" >/dev/null 2>&1 &
server=$!
trap 'kill "$server" 2>/dev/null || true; rm -f "$number"' EXIT
for _ in $(seq 200); do
  [ -s "$number" ] && break
  sleep 0.05
done
[ -s "$number" ] || { echo "Xvfb does not start" >&2; exit 77; }
status=0
env -u WAYLAND_DISPLAY XVFB_PROCESS="$server" DISPLAY=":$(cat "$number")" "$@" || status=$?
exit "$status"
