#!/usr/bin/env python3
"""Runs all experiments of docs/experiments.md, one after the other, and writes what each command says into a folder.
Then fills the tables of the document, which stand there between <!-- table NAME --> and <!-- end -->: in a copy of it in
the folder, or with --write in the document itself. Takes some ten minutes; nothing else should run meanwhile.

Usage: scripts/measure_experiments.py BUILD -o FOLDER [--short PLACE...] [--long PLACE...] [--quick]
       scripts/measure_experiments.py --fill FOLDER [--write]

BUILD is a build folder, such as build/release. --short and --long are recordings of about 2 s and 40 s; without them
the built-in clips are taken. --quick measures little, to see that everything runs. --fill fills the tables from what is
in the folder.
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
DOCUMENT = ROOT / "docs" / "experiments.md"
NAMES = {
    "brute": "direct search",
    "mobb_1level": "MOBB 1 level",
    "umobb_1level": "UMOBB 1 level",
    "mobb": "MOBB",
    "umobb": "UMOBB",
    "hybrid1": "Hybrid 1",
    "hybrid2": "Hybrid 2",
}
SEEDS = [1, 2, 3, 4, 5]
AHEAD = [0, 1, 2.5, 5]
WITHIN = [0.5, 1, 2, 5]
RANGE = [1.5, 2.5, 3.5, 5, 10]
CHAINS = [2, 4, 8, 32, 200]


class Runner:
    """Runs commands, keeps what they say in files of the folder, and how much memory and time they took in runs.json."""

    def __init__(self, build, folder):
        self.bin, self.folder, self.runs = build / "bin", folder, {}

    def run(self, name, program, *arguments):
        command = [str(self.bin / program), *map(str, arguments)]
        begin = time.monotonic()
        with open(self.folder / f"{name}.json", "w") as out, open(self.folder / f"{name}.err", "w+") as err:
            child = subprocess.Popen(command, stdout=out, stderr=err)
            _, status, usage = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
            if child.returncode != 0:
                err.seek(0)
                raise SystemExit(f"{' '.join(command)}\n{err.read().strip()}\nexit status {child.returncode}")
        (self.folder / f"{name}.err").unlink()
        self.runs[name] = {"command": " ".join(command), "seconds": time.monotonic() - begin,
                "peak_mb": usage.ru_maxrss / 1024}
        (self.folder / "runs.json").write_text(json.dumps(self.runs, indent=1) + "\n")
        print(f"{self.runs[name]['seconds']:6.1f} s  {name}", file=sys.stderr, flush=True)


def measure(runner, short, long, quick):
    few = ["--queries", 2000, "--rounds", 1] if quick else []
    graphs = {"graph_clips": [ROOT / "assets" / "clips"]}
    if short:
        graphs["graph_short"] = short

    def bench(name, table, places, *options):
        runner.run(name, "mobbscope", "bench", table, *places, "--json", *few, *options)

    bench("table2", "table2", long, "--sweep", "--variants")
    bench("table1", "table1", short, "--sweep", "--variants")
    for name, places in graphs.items():
        graph = runner.folder / f"{name}.scene.json"
        runner.run(f"build_{name}", "mobbscope", "graph", "build", *places, "-o", graph)
        bench(name, "table1", [graph], "--sweep")
    if short or long:
        bench("table2_built_in", "table2", [])
        bench("table1_built_in", "table1", [], "--sweep")
    for seed in SEEDS[1:]:
        bench(f"table2_seed_{seed}", "table2", long, "--seed", seed)
        bench(f"table1_seed_{seed}", "table1", short, "--seed", seed)
    for ahead in AHEAD:
        bench(f"table1_ahead_{ahead}", "table1", short, "--ahead", ahead)
    for within in WITHIN:
        bench(f"table1_within_{within}", "table1", short, "--within", within)
    for distance in RANGE:
        bench(f"table2_range_{distance}", "table2", long, "--range", distance)
    for table, places in (("table2", long), ("table1", short)):
        if places:
            bench(f"{table}_linear", table, places, "--motion", "linear")
    # In the order of chance, so that what slows the machine down slows all of them.
    google = ["--benchmark_format=json", "--benchmark_min_time=" + ("0.01" if quick else "0.1"),
              "--benchmark_repetitions=" + ("1" if quick else "5"), "--benchmark_enable_random_interleaving=true"]
    runner.run("chains", "bench_chain", *google)
    if (runner.bin / "bench_reservation_grid").exists():
        runner.run("grid", "bench_reservation_grid", *google)
    out = runner.folder / "run.scene.json"
    moves = short or [ROOT / "assets" / "clips"]
    if len(moves) == 1:
        simulate = ["simulate", moves[0], "--whole", "-o", out, "--json"]
        for seed in SEEDS:
            runner.run(f"crowd_seed_{seed}", "mobbscope", *simulate, "--plan", 0, "--seed", seed)
        runner.run("crowd_plan", "mobbscope", *simulate)
        runner.run("crowd_2000", "mobbscope", *simulate, "--plan", 0, "--agents", 100 if quick else 2000, "--area",
                "134x179",
                   "--seconds", 60)
    for scene in runner.folder.glob("*.scene.json"):
        scene.unlink()


def number(value):
    """Three significant digits, or whole."""
    if value == 0:
        return ""
    if value >= 100:
        return f"{value:,.0f}"
    return f"{value:.1f}" if value >= 10 else f"{value:.2f}"


def row(*cells):
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def head(*cells):
    return row(*cells) + "\n" + "|" + "---|" * len(cells)


class Results:
    """What the commands of a folder said, by name; only of those that were run."""

    def __init__(self, folder):
        self.folder = folder

    def __getitem__(self, name):
        return json.loads((self.folder / f"{name}.json").read_text())

    def labelled(self, labels):
        """(label, result) of each (label, name) that was run."""
        return [(label, self[name]) for label, name in labels if (self.folder / f"{name}.json").exists()]


MAIN = [("Table 2", "table2"), ("Table 1", "table1")]
CROWDS = [
    ("whole clips", "table1"),
    ("whole clips, built in", "table1_built_in"),
    ("graph of the short recordings", "graph_short"),
    ("graph of `assets/clips`", "graph_clips"),
]
TESTS = {"obb2d": "2D box", "obb3d": "3D box", "sample_pair": "pair of samples"}


def label_of(method):
    return NAMES.get(method, f"{method} (ours)")


def beyond_the_paper(rows):
    """The kinds of trees that are in no table of the paper."""
    return [method for method in rows if method not in NAMES and "_" not in method]


def methods(result, key="rows"):
    return {each["method"]: each for each in result[key]}


def speedups(rows, kinds):
    """Times as fast as one level, in the same rounds."""
    return [f'{rows["mobb_1level"]["time_ns"] / rows[kind]["time_ns"]:.2f}' for kind in kinds]


def main_table(result):
    rows = methods(result)
    base = rows["mobb_1level"]
    yield head("", "2D boxes", "3D boxes", "samples", "pairs", "ns a query", "times as fast", "paper: 2D", "3D",
            "samples", "µs", "times as fast")
    for method, each in rows.items():
        paper = each["paper"]
        two, three = number(each["obb2d"]), number(each["obb3d"])
        for kind in result["test_ns"]:
            if kind not in TESTS and each[kind]:
                two = f"{number(each[kind])} {kind}"
        cells = [label_of(method), two, three, number(each["sample_steps"]), number(each["samples"]), number(each["time_ns"]),
                 *speedups(rows, [method])]
        cells += [""] * 5 if not paper else [number(paper["obb2d"]), number(paper["obb3d"]), number(paper["samples"]),
                                             f'{paper["time_ns"] / 1000:g}',
                                             f'{base["paper"]["time_ns"] / paper["time_ns"]:.1f}']
        yield row(*cells)
    spread = max((each["time_ns_quartiles"][1] - each["time_ns_quartiles"][0]) / each["time_ns"]
            for each in rows.values())
    yield ""
    costs = [f"{TESTS.get(test, test)} {cost:.1f}" for test, cost in result["test_ns"].items() if cost]
    yield f'{100 * result["positive"]:.1f} % collide; {100 * result["root_rejected"]:.1f} % end at the MOBB roots. ' + \
        f"The quartiles of a time are at most {100 * spread:.0f} % of it apart. " + \
        "Many times over, one test costs in ns: " + ", ".join(costs) + "."


def comparison_table(results):
    kinds = ["brute", "umobb_1level", "mobb", "umobb", "hybrid2", "moving"]
    yield head("", "end at the roots", "collide", "samples, 1 level", "samples, MOBB", "2D boxes, MOBB",
            "ns, 1 level", "times as fast: direct search",
               *(label_of(kind) for kind in kinds[1:]))
    for label, result in results:
        rows = methods(result)
        one, mobb = rows["mobb_1level"], rows["mobb"]
        yield row(label, f'{100 * result["root_rejected"]:.1f} %', f'{100 * result["positive"]:.2f} %',
                number(one["sample_steps"]),
                  number(mobb["sample_steps"]), number(mobb["obb2d"]), number(one["time_ns"]), *speedups(rows, kinds))


def spread_table(results):
    """Least and most over runs that differ by their seed."""
    kinds = ["brute", "umobb_1level", "mobb", "umobb", "hybrid2", "moving"]
    yield head("", "end at the roots, %", "collide, %", "samples, 1 level", "samples, MOBB", "2D boxes, MOBB",
            "times as fast: direct search",
               *(label_of(kind) for kind in kinds[1:]))
    for label, runs in results:
        tables = [methods(run) for run in runs]
        figures = [[100 * run["root_rejected"] for run in runs], [100 * run["positive"] for run in runs],
                   [rows["mobb_1level"]["sample_steps"] for rows in tables],
                   [rows["mobb"]["sample_steps"] for rows in tables],
                   [rows["mobb"]["obb2d"] for rows in tables]]
        figures += [[rows["mobb_1level"]["time_ns"] / rows[kind]["time_ns"] for rows in tables] for kind in kinds]
        cells = [f"{number(min(values))} to {number(max(values))}" for values in figures]
        yield row(f"{label}, {len(runs)} seeds", *cells)


LEAF_KINDS = ["mobb", "umobb", "hybrid2", "moving"]


def swept(result):
    return {(each["method"], each["leaf"]): each for each in result["leaf_sweep"]}


def leaves(result):
    return sorted(leaf for method, leaf in swept(result) if method == "mobb")


def leaf_table(results):
    by = [swept(result) for _, result in results]
    first = [f"{label}: {label_of(kind)}" if kind == LEAF_KINDS[0] else label_of(kind)
             for label, _ in results for kind in LEAF_KINDS]
    yield head("n_min", *first)
    for leaf in leaves(results[0][1]):
        yield row(leaf, *(number(rows[kind, leaf]["time_ns"]) for rows in by for kind in LEAF_KINDS))
    beside = [methods(result, "leaf_sweep") for _, result in results]
    ones = ["mobb_1level", "umobb_1level", "umobb_1level", None]
    yield row("1 level", *(number(rows[kind]["time_ns"]) if kind else "" for rows in beside for kind in ones))
    yield row("direct search", *(cell for rows in beside for cell in [number(rows["brute"]["time_ns"]), "", "", ""]))


def best_table(results):
    yield head("", *(f"best n_min, {label_of(kind)}" for kind in LEAF_KINDS),
            "MOBB at its best, times as fast as 1 level", "as n_min = 10")
    for label, result in results:
        by = swept(result)
        best = {kind: min(leaves(result), key=lambda leaf: by[kind, leaf]["time_ns"]) for kind in LEAF_KINDS}
        mobb = by["mobb", best["mobb"]]["time_ns"]
        yield row(label, *best.values(), f'{methods(result, "leaf_sweep")["mobb_1level"]["time_ns"] / mobb:.2f}',
                  f'{by["mobb", 10]["time_ns"] / mobb:.2f}')


def solved(matrix, right):
    """Gauss, with the largest pivot first."""
    n = len(right)
    rows = [list(line) + [value] for line, value in zip(matrix, right)]
    for column in range(n):
        pivot = max(range(column, n), key=lambda line: abs(rows[line][column]))
        rows[column], rows[pivot] = rows[pivot], rows[column]
        for line in range(n):
            if line != column:
                factor = rows[line][column] / rows[column][column]
                rows[line] = [a - factor * b for a, b in zip(rows[line], rows[column])]
    return [rows[line][n] / rows[line][line] for line in range(n)]


def cost_table(results):
    """What a box test and a pair cost in the midst of a query: least squares of relative errors over all n_min."""
    yield head("", "2D box test, many times over", "pair of samples", "worth pairs", "the rule's n_min",
            "box test within queries", "pair of samples",
               "worth pairs", "the rule's n_min", "largest error")
    for label, result in results:
        lines = [([1, each["obb2d"], each["samples"]], each["time_ns"])
                 for (method, _), each in swept(result).items() if method == "mobb"]
        weighted = [[value / time_ns for value in line] for line, time_ns in lines]
        square = [[sum(line[i] * line[j] for line in weighted) for j in range(3)] for i in range(3)]
        fixed, box, pair = solved(square, [sum(line[i] for line in weighted) for i in range(3)])
        error = max(abs(fixed + box * line[1] + pair * line[2] - time_ns) / time_ns for line, time_ns in lines)
        alone = result["test_ns"]["obb2d"], result["test_ns"]["sample_pair"]
        cells = [label]
        for one_box, one_pair in (alone, (box, pair)):
            cells += [f"{one_box:.1f} ns", f"{one_pair:.1f} ns", f"{one_box / one_pair:.1f}",
                    f"{2 * one_box / one_pair:.0f}"]
        yield row(*cells, f"{100 * error:.0f} %")


VARIANTS = {
    "mobb": "MOBB, endpoints",
    "mobb_covariance": "MOBB, covariance",
    "mobb_minarea": "MOBB, smallest area",
    "umobb": "UMOBB, endpoints",
    "umobb_covariance": "UMOBB, covariance",
    "umobb_minarea": "UMOBB, smallest volume",
    "umobb_w0.25": "UMOBB, w = 0.25 m/s",
    "umobb_w0.5": "UMOBB, w = 0.5 m/s",
    "umobb_w2": "UMOBB, w = 2 m/s",
    "umobb_w4": "UMOBB, w = 4 m/s",
    "mobb_walk_boxes": "MOBB, box tests in Fig. 4 (c)",
    "umobb_walk_boxes": "UMOBB, box tests in Fig. 4 (c)",
}


def variant_table(result):
    rows = methods(result, "variants")
    yield head("", "box tests", "samples", "pairs", "ns a query", "times the endpoints' time", "µs to build",
            "volume, level 0", "1", "2", "3", "leaves")
    for method, label in VARIANTS.items():
        each, base = rows[method], rows["umobb" if method.startswith("umobb") else "mobb"]
        volume, of_mobb = each["volumes"], rows["mobb"]["volumes"]
        levels = [f"{volume[i] / of_mobb[i]:.2f}" for i in (0, 1, 2, 3, -1)]
        tests = sum(each[kind] for kind in ("obb2d", "obb3d"))
        yield row(label, number(tests), number(each["sample_steps"]), number(each["samples"]), number(each["time_ns"]),
                  f'{each["time_ns"] / base["time_ns"]:.2f}', number(each["build_ns"] / 1000), *levels)


def volume_table(results):
    yield head("volume, MOBB = 1", *(f"level {i}" for i in range(10)))
    for label, result in results:
        rows = methods(result)
        for kind in ["umobb", *beyond_the_paper(rows)]:
            cells = [f"{a / b:.2f}" for a, b in zip(rows[kind]["volumes"], rows["mobb"]["volumes"])]
            yield row(f"{label}: {label_of(kind)}", *cells, *[""] * (10 - len(cells)))


def level_table(results):
    yield head("MOBB", "level", "pairs a query", "apart in time", "boxes separate", "samples measured", "go on",
            "queries that end here")
    for label, result in results:
        for i, level in enumerate(methods(result)["mobb"]["pair_levels"]):
            on = level["pairs"] - level["apart_in_time"] - level["separated"] - level["sampled"]
            parts = [level["apart_in_time"], level["separated"], level["sampled"], on]
            yield row(label, i, f'{level["pairs"]:.2f}', *(f'{100 * part / level["pairs"]:.0f} %' for part in parts),
                      f'{100 * level["queries_ended"]:.1f} %')


def tree_table(results):
    kinds = ["mobb", "umobb", *beyond_the_paper(methods(results[0][1]))]
    yield head("", "s a clip", "levels", "nodes", "bytes", *(f"{label_of(kind)}: µs to build" for kind in kinds))
    for label, result in results:
        rows = methods(result)
        tree = rows["mobb"]
        yield row(label, f'{result["clips"]["mean_duration"]:.2f}', f'{tree["depth"]:.1f}', f'{tree["nodes"]:.1f}',
                f'{tree["bytes"]:,.0f}',
                  *(number(rows[kind]["build_ns"] / 1000) for kind in kinds))


def google_times(result):
    """Seconds of CPU time by name, the median of repetitions; and the first line of each, which has the counters."""
    times, lines = {}, {}
    for line in result["benchmarks"]:
        name = line["run_name"]
        lines.setdefault(name, line)
        if line.get("aggregate_name", "median") == "median":
            times[name] = line["cpu_time"] * {"ns": 1e-9, "us": 1e-6, "ms": 1e-3}[line["time_unit"]]
    return times, lines


def chain_table(result):
    times, lines = google_times(result)
    hows = ["composed", "rebuilt", "a query for each two clips"]
    yield head("clips a chain", *(cell for how in hows for cell in (f"{how}: 2D boxes", "pairs", "ns")))
    for links in CHAINS:
        cells = []
        for how in ("composed", "rebuilt", "segments"):
            name = f"query_{how}/{links}"
            cells += [f'{lines[name]["2D"]:.1f}', f'{lines[name]["samples"]:.1f}', f"{1e9 * times[name]:,.0f}"]
        yield row(links, *cells)


def chain_build_table(result):
    times, _ = google_times(result)
    yield head("clips a chain", "compose, µs", "rebuild, µs", "one more clip, µs")
    for links in (10, 100, 1000):
        yield row(f"{links:,}", *(number(1e6 * times[name]) if (name := f"{what}/{links}") in times else ""
                                  for what in ("compose", "rebuild", "append_one")))


def grid_table(result):
    times, _ = google_times(result)
    yield head("agents", "replace one's motion", "ask who is near a candidate")
    for agents in (100, 1000, 2000, 10000):
        yield row(f"{agents:,}", *(" / ".join(f"{1e9 * times[f'{what}<{how}>/{agents}']:.0f}"
                for how in ("Grid", "RTree"))
                                   for what in ("replace", "ask")))


def crowd_table(results, runs):
    yield head("", "choices", "candidates", "queries", "a second", "pivots", "forced", "s", "MB")
    for label, result in results:
        yield row(label, f'{result["choices"]:,}', f'{result["candidates"]:,}', f'{result["queries"]:,}',
                f'{result["queries_per_second"]:,.0f}',
                  result["pivots"], result["forced"], f'{result["wall_seconds"]:.1f}', f"{runs[label]:.0f}")


def crowd_tables(results):
    labels = [(f"100 agents, 120 s, no plans, seed {seed}", f"crowd_seed_{seed}") for seed in SEEDS]
    labels += [("the same with plans of 8 s, seed 1", "crowd_plan"),
            ("2,000 agents, 60 s, 134 x 179 m, no plans", "crowd_2000")]
    runs = results["runs"]
    peaks = {label: runs[name]["peak_mb"] for label, name in labels if name in runs}
    return crowd_table(results.labelled(labels), peaks)


def tables(results):
    """The lines of each table, by its name."""
    table2, table1 = results["table2"], results["table1"]
    main = results.labelled(MAIN)
    crowds = results.labelled(CROWDS)
    all_runs = main + crowds[1:]
    seeds = [(label, results.labelled([("", name), *(("", f"{name}_seed_{seed}") for seed in SEEDS)]))
             for label, name in MAIN]
    drawn = [(f"chosen {v:g} s ahead", f"table1_ahead_{v}") for v in AHEAD]
    drawn += [(f"asked within {v:g} m", f"table1_within_{v}") for v in WITHIN]
    placed = [(f"within {v:g} m", f"table2_range_{v}") for v in RANGE]
    out = {
        "machine": [f"Measured on {table2['machine']}."],
        "table2": main_table(table2),
        "built_in": comparison_table(results.labelled([("built-in walks", "table2_built_in")])),
        "table1": main_table(table1),
        "crowds": comparison_table(crowds),
        "n_min": leaf_table(main),
        "best": best_table(all_runs),
        "costs": cost_table(all_runs),
        "volumes": volume_table(main),
        "variants2": variant_table(table2),
        "variants1": variant_table(table1),
        "levels": level_table(main),
        "trees": tree_table(all_runs),
        "seeds": spread_table([(label, [run for _, run in runs]) for label, runs in seeds]),
        "crowd_drawn": comparison_table(results.labelled(drawn)),
        "placed": comparison_table(results.labelled(placed)),
        "linear": comparison_table(results.labelled([("held", "table2"), ("linear", "table2_linear")])),
        "chains": chain_table(results["chains"]),
        "chain_building": chain_build_table(results["chains"]),
    }
    for _, grid in results.labelled([("", "grid")]):
        out["grid"] = grid_table(grid)
    if results.labelled([("", "crowd_plan")]):
        out["crowd"] = crowd_tables(results)
    return {name: "\n".join(lines) for name, lines in out.items()}


def fill(folder, write):
    made = tables(Results(folder))
    text = DOCUMENT.read_text()
    for name in re.findall(r"<!-- table (\w+) -->", text):
        if name not in made:
            print(f"{name}: not measured, left as it was", file=sys.stderr)
            continue
        text = re.sub(rf"(<!-- table {name} -->\n).*?(<!-- end -->)",
                lambda found: f"{found[1]}\n{made[name]}\n\n{found[2]}", text, flags=re.DOTALL)
    target = DOCUMENT if write else folder / "experiments.md"
    target.write_text(text)
    print(f"The tables are in {target}", file=sys.stderr)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", nargs="?", type=pathlib.Path, metavar="BUILD")
    parser.add_argument("-o", "--output", type=pathlib.Path, metavar="FOLDER")
    parser.add_argument("--short", nargs="+", type=pathlib.Path, default=[], metavar="PLACE")
    parser.add_argument("--long", nargs="+", type=pathlib.Path, default=[], metavar="PLACE")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--fill", type=pathlib.Path, metavar="FOLDER")
    parser.add_argument("--write", action="store_true")
    arguments = parser.parse_args()
    if not arguments.fill:
        if not arguments.build or not arguments.output:
            parser.error("give BUILD and -o FOLDER, or --fill FOLDER")
        arguments.output.mkdir(parents=True, exist_ok=True)
        measure(Runner(arguments.build, arguments.output), arguments.short, arguments.long, arguments.quick)
    fill(arguments.fill or arguments.output, arguments.write)


if __name__ == "__main__":
    main()
