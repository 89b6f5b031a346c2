#!/usr/bin/env python3
"""Makes the demo scenes in assets/scenes/: agents on the walking skeletons of assets/clips/ (scripts/make_walkers.py).

Also walk.csv, the same walk as a track of disks: the hips of make_walkers.py's paths, with a radius that grows when the
feet are far apart, r = 0.35 + 0.15 |sin(pi s)|^1.5 m after s steps. Nothing random: the same bytes every time.

Usage: scripts/make_scenes.py [FOLDER]    (default: assets/scenes beside this script's folder)
"""
import json
import math
import pathlib
import sys

sys.dont_write_bytecode = True  # no __pycache__ beside the scripts
from make_walkers import RATE, Path, turning


def write_scene(folder, name, clips, rest, up=".."):
    """clips: the name in the scene -> the name of a file in assets/clips/, or all that the scene says of the clip, with
    that name as its source. up: the way from the folder to assets/."""
    def clip_of(said):
        said = {"source": said} if isinstance(said, str) else said
        return {**said, "source": f"{up}/clips/{said['source']}.glb"} if "source" in said else said

    lines = ['{', '  "mobbscope": 1,', '  "clips": {']
    lines.append(",\n".join(f'    "{clip}": {json.dumps(clip_of(said))}' for clip, said in clips.items()))
    lines.append("  },")
    lines.append(",\n".join(f'  "{key}": {json.dumps(value)}' for key, value in rest.items()))
    lines.append("}")
    (folder / f"{name}.json").write_text("\n".join(lines) + "\n", encoding="utf-8")


def write_csv(folder, name, path):
    rows = []
    for i in range(round(path.duration * RATE)):
        t = i / RATE
        x, y = path.hips(t)
        radius = 0.35 + 0.15 * abs(math.sin(math.pi * path.steps(t))) ** 1.5
        rows.append(f"{t!r},{round(x, 4)},{round(y, 4)},{round(radius, 4)}\n")
    (folder / f"{name}.csv").write_text("t,x,y,r\n" + "".join(rows), encoding="utf-8")


def main():
    default = pathlib.Path(__file__).resolve().parent.parent / "assets" / "scenes"
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default
    folder.mkdir(parents=True, exist_ok=True)
    walkers = {"straight": "walk", "bend": "bend"}

    # The situation of the paper's Fig. 1: B comes through the place where A was nearly three seconds before.
    write_scene(folder, "crossing", walkers, {
        "agents": [
            {"name": "A", "clip": "straight", "translate": [-3.0, 0.3], "rotate_deg": 8, "start": 0, "color": "#E69F00"},
            {"name": "B", "clip": "bend", "translate": [-0.9, -4.3], "rotate_deg": 70, "start": 0.9, "color": "#56B4E9"},
        ],
        "fit": {"tree": "mobb", "leaf": 10},
        "queries": [{"a": "A", "b": "B", "expect": {"collides": False}}],
        "view": {"camera": {"preset": "free", "yaw_deg": -30, "pitch_deg": 24}, "levels": "2"},
    })

    # Two people who walk into each other at a corner.
    write_scene(folder, "collision", walkers, {
        "agents": [
            {"name": "A", "clip": "straight", "translate": [-3.0, 0.3], "rotate_deg": 8, "start": 0, "color": "#E69F00"},
            {"name": "B", "clip": "bend", "translate": [1.3, 4.0], "rotate_deg": -115, "start": 0.2, "color": "#56B4E9"},
        ],
        "fit": {"tree": "mobb", "leaf": 10},
        "queries": [{"a": "A", "b": "B", "expect": {"collides": True}}],
        "view": {"camera": {"preset": "iso"}, "levels": "3"},
    })

    # The paper's Fig. 8: a long walk in circles.
    write_scene(folder, "circles", {"circles": "circle"}, {
        "agents": [{"name": "walker", "clip": "circles", "color": "#CC79A7"}],
        "fit": {"tree": "mobb", "leaf": 10},
        "view": {"camera": {"preset": "iso"}, "levels": "5", "time_height": 0.28},
    })

    write_csv(folder, "walk", Path(4.0, turning(20, 0.5, 3.5)))


if __name__ == "__main__":
    main()
