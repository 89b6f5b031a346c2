#!/usr/bin/env bash
# environment.sh PROGRAM ASSETS FOLDER: the same pictures, byte for byte, whatever is around the program: locale, time
# zone, settings, working folder, display scale, display, number of cores. Exits with 77 where there is no OpenGL.
set -euo pipefail
program=$1 assets=$2 folder=$3
rm -rf "$folder"
mkdir -p "$folder/empty" "$folder/settings/mobbscope" "$folder/settings/.config/mobbscope" "$folder/elsewhere" "$folder/locales"
cd "$folder"

# Another person's: everything larger, other panels, files opened before; and what an interface library would leave.
cat >settings/mobbscope/settings.json <<EOF
{"ui_scale": 2, "left_width": 400, "right_width": 200, "bottom_height": 60, "recent": ["$assets/scenes/circles.json"]}
EOF
cp settings/mobbscope/settings.json settings/.config/mobbscope/
printf '[Window][why]\nPos=7,7\nSize=99,99\nCollapsed=1\n' >elsewhere/imgui.ini

# Locales with another decimal sign and other letters, where the machine can make them.
for name in de_DE tr_TR; do
  localedef -f UTF-8 -i "$name" "locales/$name.UTF-8" 2>/dev/null || true
done

# draw NAME [WORD...]: the pictures, by a command line that begins with the words.
draw() {
  local name=$1
  shift
  "$@" "$program" render "$assets/scenes/crossing.json" --query 0 --step 60% --size 640x360 -o "$folder/$name.png"
  "$@" "$program" render "$assets/scenes/crossing.json" --query 0 --step 60% --size 800x500 --ui -o "$folder/$name.window.png"
}

# Sanitizers keep what they were told.
kept=(${ASAN_OPTIONS:+"ASAN_OPTIONS=$ASAN_OPTIONS"} ${UBSAN_OPTIONS:+"UBSAN_OPTIONS=$UBSAN_OPTIONS"})
clean=(env -i "${kept[@]}" PATH="$PATH" LOCPATH="$folder/locales")
status=0
"${clean[@]}" "$program" render "$assets/scenes/crossing.json" --size 64x64 -o probe.png || status=$?
[ "$status" -ne 3 ] || exit 77
draw reference "${clean[@]}"

failed=0
# same NAME [WORD...]: draws likewise and compares.
same() {
  local name=$1
  draw "$@"
  for picture in "$name.png" "$name.window.png"; do
    if ! cmp "$folder/reference${picture#"$name"}" "$folder/$picture"; then failed=1; fi
  done
}

same as-it-is env
same german "${clean[@]}" LC_ALL=de_DE.UTF-8
same turkish "${clean[@]}" LANG=tr_TR.UTF-8
same tokyo "${clean[@]}" TZ=Asia/Tokyo
same no-settings "${clean[@]}" HOME="$folder/empty" XDG_CONFIG_HOME="$folder/empty"
same settings "${clean[@]}" HOME="$folder/settings" XDG_CONFIG_HOME="$folder/settings"
same settings-at-home "${clean[@]}" HOME="$folder/settings"
same scaled "${clean[@]}" GDK_SCALE=2 QT_SCALE_FACTOR=2 QT_AUTO_SCREEN_SCALE_FACTOR=1
same no-display-there "${clean[@]}" DISPLAY=:4711 WAYLAND_DISPLAY=wayland-4711
for threads in 0 1 2 4; do
  same "threads-$threads" "${clean[@]}" LP_NUM_THREADS=$threads
done
if command -v taskset >/dev/null; then
  core=$(taskset -cp $$ | sed 's/.*: //; s/[,-].*//')
  same one-core taskset -c "$core" "${clean[@]}"
fi
cd elsewhere
same elsewhere "${clean[@]}"
cd ..
exit "$failed"
