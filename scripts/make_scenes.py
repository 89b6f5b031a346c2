#!/usr/bin/env python3
"""Makes the demo scenes in assets/scenes/ from formulas: nothing recorded, nothing random, the same bytes every time.

A walker follows a heading h(t) at a speed that falls and rises with each step, sways to the side once a stride, and
reaches further from the hip in mid-step than when the feet pass each other:

    x' = v (1 + 0.08 sin 2pi s) cos h,  y' likewise    s = steps taken, 1.9 a second
    sideways offset 0.025 sin(pi s) m                  one stride is two steps
    r = 0.35 + 0.15 |sin(pi s)|^1.5 m                  measured walks: 0.35 to 0.5 m

Usage: scripts/make_scenes.py [FOLDER]    (default: assets/scenes beside this script's folder)
"""
import json
import math
import pathlib
import sys

RATE = 30  # samples per second
STEPS_PER_SECOND = 1.9
SPEED = 1.3  # m/s


def walk(duration, heading, speed=SPEED, phase=0.0):
    """Samples [x, y, r] of a walk that begins at the origin; heading(t) is in radians."""
    samples = []
    x = y = 0.0
    substeps = 8  # the path is integrated finer than it is sampled
    for i in range(round(duration * RATE)):
        t = i / RATE
        steps = STEPS_PER_SECOND * t + phase
        sway = 0.025 * (math.sin(math.pi * steps) - math.sin(math.pi * phase))
        h = heading(t)
        radius = 0.35 + 0.15 * abs(math.sin(math.pi * steps)) ** 1.5
        samples.append([round(x - sway * math.sin(h), 4), round(y + sway * math.cos(h), 4), round(radius, 4)])
        for k in range(substeps):
            fine = t + k / (substeps * RATE)
            v = speed * (1 + 0.08 * math.sin(2 * math.pi * (STEPS_PER_SECOND * fine + phase)))
            x += v * math.cos(heading(fine)) / (substeps * RATE)
            y += v * math.sin(heading(fine)) / (substeps * RATE)
    return samples


def turning(degrees, begin, end):
    """A heading that turns by so many degrees between two times, smoothly."""

    def heading(t):
        share = min(max((t - begin) / (end - begin), 0.0), 1.0)
        return math.radians(degrees) * share * share * (3 - 2 * share)

    return heading


def circling(t):
    """Lap after lap, the laps getting wider and narrower: about 9 s each, 2 m in radius."""
    return 2 * math.pi * t / 9.0 + 0.9 * math.sin(2 * math.pi * t / 42.0)


def write_scene(folder, name, clips, rest):
    """One sample a line, so that differences can be read."""
    lines = ['{', '  "mobbscope": 1,', '  "clips": {']
    for index, (clip, samples) in enumerate(clips.items()):
        rows = ",\n".join("        " + json.dumps(sample) for sample in samples)
        end = "," if index + 1 < len(clips) else ""
        lines.append(f'    "{clip}": {{\n      "dt": {1 / RATE!r},\n      "samples": [\n{rows}\n      ]\n    }}{end}')
    lines.append("  },")
    lines.append(",\n".join(f'  "{key}": {json.dumps(value)}' for key, value in rest.items()))
    lines.append("}")
    (folder / f"{name}.json").write_text("\n".join(lines) + "\n", encoding="utf-8")


def write_csv(folder, name, samples):
    rows = "".join(f"{i / RATE!r},{x},{y},{r}\n" for i, (x, y, r) in enumerate(samples))
    (folder / f"{name}.csv").write_text("t,x,y,r\n" + rows, encoding="utf-8")


def main():
    default = pathlib.Path(__file__).resolve().parent.parent / "assets" / "scenes"
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default
    folder.mkdir(parents=True, exist_ok=True)
    straight = walk(5.0, turning(-15, 1.0, 4.0))
    bend = walk(5.0, turning(35, 1.5, 3.5), phase=0.4)

    # The situation of the paper's Fig. 1: B comes through the place where A was nearly three seconds before.
    write_scene(folder, "crossing", {"straight": straight, "bend": bend}, {
        "agents": [
            {"name": "A", "clip": "straight", "translate": [-3.0, 0.3], "rotate_deg": 8, "start": 0, "color": "#E69F00"},
            {"name": "B", "clip": "bend", "translate": [-0.9, -4.3], "rotate_deg": 70, "start": 0.9, "color": "#56B4E9"},
        ],
        "fit": {"tree": "mobb", "leaf": 10},
        "queries": [{"a": "A", "b": "B", "expect": {"collides": False}}],
        "view": {"camera": {"preset": "free", "yaw_deg": -30, "pitch_deg": 24}, "levels": "2"},
    })

    # Two people who walk into each other at a corner.
    write_scene(folder, "collision", {"straight": straight, "bend": bend}, {
        "agents": [
            {"name": "A", "clip": "straight", "translate": [-3.0, 0.3], "rotate_deg": 8, "start": 0, "color": "#E69F00"},
            {"name": "B", "clip": "bend", "translate": [1.3, 4.0], "rotate_deg": -115, "start": 0.2, "color": "#56B4E9"},
        ],
        "fit": {"tree": "mobb", "leaf": 10},
        "queries": [{"a": "A", "b": "B", "expect": {"collides": True}}],
        "view": {"camera": {"preset": "iso"}, "levels": "3"},
    })

    # The paper's Fig. 8: a long walk in circles.
    write_scene(folder, "circles", {"circles": walk(42.0, circling, speed=1.35)}, {
        "agents": [{"name": "walker", "clip": "circles", "color": "#009E73"}],
        "fit": {"tree": "mobb", "leaf": 10},
        "view": {"camera": {"preset": "iso"}, "levels": "5", "time_height": 0.28},
    })

    write_csv(folder, "walk", walk(4.0, turning(20, 0.5, 3.5)))


if __name__ == "__main__":
    main()
