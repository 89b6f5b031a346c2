"""certificates_test.py PROGRAM COUNT: random scenes; the program and an exact checker of its own agree on the proofs of
their answers, and on proofs that were damaged."""
import copy
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

from exact_checker import why_not_proven

PROGRAM, COUNT = sys.argv[1], int(sys.argv[2])
KINDS = ["mobb", "umobb", "hybrid1", "hybrid2", "moving", "aabb", "blocks"]
random.seed(35)


def path():
    x, y, heading, out = random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0, 6), []
    for _ in range(random.choice([1, 2, 5, 20, 40])):
        out.append([x, y, random.uniform(0.1, 0.5)])
        heading += random.uniform(-0.5, 0.5)
        x, y = x + 0.15 * math.cos(heading), y + 0.15 * math.sin(heading)
    return out


def scene(far, epoch):
    clip = lambda: {"dt": random.choice([0.1, 1 / 30, 0.07]), "samples": path(),
                    "motion": random.choice(["held", "linear"])}
    agent = lambda name: {"name": name, "clip": name, "translate": [far + random.uniform(-1, 1), random.uniform(-1, 1)],
                          "rotate_deg": random.uniform(-180, 180), "start": epoch + random.uniform(0, 1)}
    return {"clips": {"a": clip(), "b": clip()}, "agents": [agent("a"), agent("b")],
            "fit": {"tree": random.choice(KINDS), "leaf": random.choice([1, 5, 10])}}


def verdict(folder, certificate):
    (folder / "changed.json").write_text(json.dumps(certificate))
    done = subprocess.run([PROGRAM, "verify", folder / "scene.json", folder / "changed.json"], capture_output=True)
    assert done.returncode in (0, 1), done.stderr
    return done.returncode == 0


def damaged(entry):
    """What an honest checker refuses: a tile less, one that says too much, one that is too long."""
    tiles = entry["tiles"]
    if not tiles:
        return
    at = random.randrange(len(tiles))
    less = copy.deepcopy(entry)
    del less["tiles"][at]
    yield less
    wider = copy.deepcopy(entry)
    wider["tiles"][at]["gap"] += 1e-4 + abs(wider["tiles"][at]["gap"])
    yield wider
    turned = copy.deepcopy(entry)
    turned["tiles"][at]["direction"] = [-u for u in turned["tiles"][at]["direction"]]
    yield turned


counts = {"hit": 0, "miss": 0, "damaged": 0}
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    for number in range(COUNT):
        world = scene(1e4 if number % 10 == 9 else 0, {8: 1.7e9, 9: 1e5}.get(number % 10, 0))
        (folder / "scene.json").write_text(json.dumps(world))
        subprocess.run([PROGRAM, "query", folder / "scene.json", "--certificate", folder / "proof.json"], check=True,
                       capture_output=True)
        proof = json.loads((folder / "proof.json").read_text())
        entry = proof["queries"][0]
        counts["hit" if entry["collides"] else "miss"] += 1
        why = why_not_proven(world, entry)
        assert why is None, f"scene {number}: {why}"
        assert verdict(folder, proof), f"scene {number}: verify refuses what is proven"
        for changed in damaged(entry):
            counts["damaged"] += 1
            exact = why_not_proven(world, changed) is None
            assert not exact and not verdict(folder, {**proof, "queries": [changed]}), f"scene {number}: {changed}"
assert min(counts.values()) > COUNT // 20, counts
print(counts)
