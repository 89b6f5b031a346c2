#!/usr/bin/env python3
"""Measures how many plays of a crowd are forced in a minute, by the number of agents on 30 x 40 m, and draws the figure of
docs/crowd.md: docs/pictures/forced.svg. Prints the table beside it.

The counts are the same every time; the seconds are the machine's.

Usage: scripts/make_forced_figure.py MOBBSCOPE GRAPH... [-o FILE.svg]
"""
import argparse
import json
import math
import pathlib
import subprocess
import tempfile

AGENTS = [25, 50, 100, 200, 300, 400]
SECONDS = 60
PLANS = [0, 8]
COLORS = ["#D55E00", "#0072B2", "#009E73", "#CC79A7"]


def simulate(program, graph, agents, plan, folder):
    result = subprocess.run([program, "simulate", graph, "-o", folder / "run.json", "--agents", str(agents), "--plan",
                             str(plan), "--seconds", str(SECONDS), "--json"], capture_output=True, text=True)
    if result.returncode != 0:
        raise SystemExit(result.stderr.strip())
    return json.loads(result.stdout)


def drawn(curves):
    """Forced plays of a hundred choices, on a scale that is linear up to 0.1 and has a step for each factor of 10 above."""
    width, height, left, top, right, bottom = 640, 360, 64, 28, 200, 48
    def x(agents):
        return left + (width - left - right) * math.log(agents / AGENTS[0]) / math.log(AGENTS[-1] / AGENTS[0])
    def y(percent):
        unit = percent / 0.1 if percent < 0.1 else 1 + math.log10(percent / 0.1)
        return height - bottom - (height - bottom - top) * unit / 4
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="12">',
           f'<rect width="{width}" height="{height}" fill="white"/>',
           f'<text x="{left}" y="16">forced plays, % of choices</text>']
    for percent in (0, 0.1, 1, 10, 100):
        out.append(f'<path d="M{left} {y(percent):.1f}H{width - right}" stroke="#DDD"/>'
                   f'<text x="{left - 6}" y="{y(percent) + 4:.1f}" text-anchor="end">{percent:g}</text>')
    for agents in AGENTS:
        out.append(f'<text x="{x(agents):.1f}" y="{height - bottom + 18}" text-anchor="middle">{agents}</text>')
    out.append(f'<text x="{(left + width - right) / 2}" y="{height - 10}" text-anchor="middle">agents on 30 x 40 m</text>')
    for row, (name, plan, color, points) in enumerate(curves):
        dash = ' stroke-dasharray="6 4"' if plan == 0 else ""
        path = "L".join(f"{x(agents):.1f} {y(percent):.1f}" for agents, percent in points)
        out.append(f'<path d="M{path}" fill="none" stroke="{color}" stroke-width="2"{dash}/>')
        out += [f'<circle cx="{x(agents):.1f}" cy="{y(percent):.1f}" r="3" fill="{color}"/>' for agents, percent in points]
        at = top + 10 + 20 * row
        out.append(f'<path d="M{width - right + 14} {at}h24" stroke="{color}" stroke-width="2"{dash}/>'
                   f'<text x="{width - right + 44}" y="{at + 4}">{name}, plan {plan} s</text>')
    return "\n".join(out + ["</svg>", ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("graphs", nargs="+", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path,
                        default=pathlib.Path(__file__).resolve().parent.parent / "docs" / "pictures" / "forced.svg")
    arguments = parser.parse_args()
    curves = []
    print("| graph | agents | choices | forced, plan 0 | forced, plan 8 s | queries, plan 0 | plan 8 s | seconds, plan 0 | plan 8 s |")
    print("|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for graph, color in zip(arguments.graphs, COLORS):
            points = {plan: [] for plan in PLANS}
            for agents in AGENTS:
                runs = [simulate(arguments.program, graph, agents, plan, pathlib.Path(folder)) for plan in PLANS]
                for plan, run in zip(PLANS, runs):
                    points[plan].append((agents, 100 * run["forced"] / run["choices"]))
                cells = [graph.stem, agents, f'{runs[1]["choices"]:,}']
                cells += [f'{run["forced"]:,}' for run in runs] + [f'{run["queries"] / 1e6:.2f} M' for run in runs]
                cells += [f'{run["wall_seconds"]:.1f}' for run in runs]
                print("| " + " | ".join(map(str, cells)) + " |", flush=True)
            curves += [(graph.stem, plan, color, points[plan]) for plan in PLANS]
    arguments.output.write_text(drawn(curves))


if __name__ == "__main__":
    main()
