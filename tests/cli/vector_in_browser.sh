#!/usr/bin/env bash
# vector_in_browser.sh MOBBSCOPE BROWSER SCENES FOLDER: an SVG shown by a browser is the PNG, within the loose tolerance
# of picture tests, but for the levels that slanting edges differ by: browsers smooth them over a wider square. 77: there
# is no browser.
set -euo pipefail
program=$1 browser=$2 scenes=$3 folder=$4
[ -x "$browser" ] || { echo "no Chromium; scripts/setup --ci installs it"; exit 77; }
rm -rf "$folder"
mkdir -p "$folder"

# check NAME COMMAND...: draws NAME.svg and NAME.png and compares them.
check() {
  local name=$1
  shift
  for extension in svg png; do "$program" "$@" --size 1280x720 -o "$folder/$name.$extension" >/dev/null; done
  # The browser is a script that calls more than tests may.
  HOME=$folder PATH=/usr/bin:/bin timeout 120 "$browser" --headless --no-sandbox --disable-gpu --hide-scrollbars --force-device-scale-factor=1 \
    --user-data-dir="$folder/profile" --window-size=1280,720 --screenshot="$folder/$name.browser.png" "file://$folder/$name.svg" \
    >"$folder/$name.log" 2>&1
  "$program" diff "$folder/$name.browser.png" "$folder/$name.png" --threshold 16 --allowed 0.5% --shift 1 \
    -o "$folder/$name.heat.png"
}

check boxes render "$scenes/crossing.json"
check query render "$scenes/crossing.json" --query 0 --step end
check light render "$scenes/crossing.json" --theme light --view top
check map map "$scenes/crossing.json" --over dx=-5:5,dy=-5:5 --cells 32x32 --show clearance
