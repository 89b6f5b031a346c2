#!/usr/bin/env python3
"""Makes the scenes of the paper's figures in assets/figures/scenes/: placements of the walkers of assets/clips/ at which
a query goes the way that the figure tells of. Figures 1b, 1c and 8 are of scenes in assets/scenes/
(scripts/make_scenes.py).

Nothing random: the same bytes every time.

Usage: scripts/make_figures.py [FOLDER]    (default: assets/figures/scenes beside this script's folder)
"""
import functools
import math
import pathlib
import sys

sys.dont_write_bytecode = True  # no __pycache__ beside the scripts
from make_scenes import write_scene

ORANGE, SKY = "#E69F00", "#56B4E9"


def slow_disks():
    """A path so coarse that a disk has a height to be seen: 0.25 s a sample at 1 m/s, from y = 0 back to it."""
    count, dt = 8, 0.25
    return {"dt": dt, "samples": [[round(i * dt, 4), round(0.12 * math.sin(2 * math.pi * i / (count - 1)), 4),
                                   round(0.42 + 0.05 * math.cos(1.3 * i), 4)] for i in range(count)]}


def main():
    default = pathlib.Path(__file__).resolve().parent.parent / "assets" / "figures" / "scenes"
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default
    folder.mkdir(parents=True, exist_ok=True)
    write = functools.partial(write_scene, folder, up="../..")

    # Fig. 1, left: one person at one moment.
    write("person", {"steps": {"source": "walk", "trim": [0.4, 1.6]}}, {
        "agents": [{"name": "A", "clip": "steps", "color": ORANGE}],
        "fit": {"tree": "mobb", "leaf": 10},
        "view": {"show": "moment", "time": 0.6, "theme": "light"},
    })

    # Figs. 2 and 5: half a circle, so that every level of boxes is tighter than the one before. Time is drawn as high
    # as free boxes are fitted with, so that they are seen with their right angles.
    write("levels", {"half": {"source": "circle", "trim": [0, 5]}}, {
        "agents": [{"name": "A", "clip": "half", "color": ORANGE}],
        "fit": {"tree": "mobb", "leaf": 10},
        "view": {"camera": {"preset": "iso", "perspective": False, "target": [-0.19, 1.37, 2.4], "distance": 38},
                 "levels": "1", "time_height": 1, "theme": "light"},
    })

    # Fig. 3: the roots overlap; of the four pairs of children the first is separated, the second apart in time, the
    # third separated, and the last overlaps.
    write("inner_nodes", {"bend": "bend", "straight": "walk"}, {
        "agents": [
            {"name": "A", "clip": "bend", "start": 0, "color": ORANGE},
            {"name": "B", "clip": "straight", "translate": [9.8, -1.8], "rotate_deg": 160, "start": 1.5, "color": SKY},
        ],
        "fit": {"tree": "mobb", "leaf": 20},
        "queries": [{"a": "A", "b": "B", "expect": {"collides": False}}],
        "view": {"camera": {"preset": "free", "yaw_deg": -95, "pitch_deg": 20}, "query": 0, "step": 1,
                 "time_height": 2.2, "past": "pair", "theme": "light"},
    })

    # Fig. 4: B is so short that a leaf of it meets an inner node of A. B goes where the first child of that node was,
    # but when it is over.
    write("leaf", {"bend": "bend", "short": {"source": "walk", "trim": [0, 1.3]}}, {
        "agents": [
            {"name": "A", "clip": "bend", "start": 0, "color": ORANGE},
            {"name": "B", "clip": "short", "translate": [4.6, -0.7], "rotate_deg": 120, "start": 3.5, "color": SKY},
        ],
        "fit": {"tree": "mobb", "leaf": 20},
        "queries": [{"a": "A", "b": "B", "expect": {"collides": False}}],
        "view": {"camera": {"preset": "free", "yaw_deg": -60, "pitch_deg": 20}, "query": 0, "step": 15,
                 "time_height": 1.8, "past": "pair", "theme": "light"},
    })

    # Fig. 6: a disk in a free box that leans along +x, so that the front view looks along its axis 1.
    write("disk", {"slow": slow_disks()}, {
        "agents": [{"name": "A", "clip": "slow", "color": ORANGE}],
        "fit": {"tree": "umobb", "leaf": 8},
        "view": {"camera": {"preset": "front"}, "projection": {"participant": 0, "node": 0, "sample": 3},
                 "theme": "light"},
    })


if __name__ == "__main__":
    main()
