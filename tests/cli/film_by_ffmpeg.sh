#!/usr/bin/env bash
# film_by_ffmpeg.sh MOBBSCOPE FFMPEG FFPROBE SCENES FOLDER: films that the real ffmpeg makes have their pictures, size and
# rate, and their last picture, held for two seconds, is the PNG, but for what encoding costs. 77: there is no ffmpeg.
set -euo pipefail
program=$1 ffmpeg=$2 ffprobe=$3 scenes=$4 folder=$5
[ -x "$ffmpeg" ] && [ -x "$ffprobe" ] || { echo "no ffmpeg with ffprobe; scripts/setup --ci installs it"; exit 77; }
rm -rf "$folder"
mkdir -p "$folder/bin"
ln -s "$ffmpeg" "$folder/bin/ffmpeg"
export PATH=$folder/bin:$PATH
shown=(--query 0 --frames 2:6)

"$program" render "$scenes/crossing.json" "${shown[@]}" --size 482x270 -o "$folder/p.png"
for extension in mp4 webm; do
  film=$folder/film.$extension
  "$program" render "$scenes/crossing.json" "${shown[@]}" --size 481x270 --rate 4 -o "$film"
  facts=$("$ffprobe" -v error -count_frames -select_streams v:0 -show_entries stream=width,height,pix_fmt,avg_frame_rate,nb_read_frames \
    -of default=nokey=1:noprint_wrappers=1 "$film" | tr '\n' ' ')
  [ "$facts" = "482 270 yuv420p 4/1 13 " ] || { echo "$film: $facts"; exit 1; }
  "$ffmpeg" -v error -sseof -0.25 -i "$film" -update 1 -y "$folder/last.$extension.png"
  "$program" diff "$folder/last.$extension.png" "$folder/p_0006.png" --threshold 48 --allowed 1% -o "$folder/heat.$extension.png"
done
