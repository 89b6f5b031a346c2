"""Checks certificates (mobbscope query --certificate) in exact rationals, against a scene with its samples inside.
Written from the file format alone: it shares no code with the program. Why a proof fails, or None."""
import math
from fractions import Fraction as Exact

MOMENT = Exact(1e-9)  # what a pair must share in seconds to count, and metres that touching disks may overlap by


def disks(scene, side):
    """[(begin, end, disk at begin, disk at end)] of an agent: times as the doubles start + i*dt, disks as placed."""
    agent = next(each for each in scene["agents"] if each["name"] == side)
    clip = scene["clips"][agent["clip"]]
    (tx, ty), start = agent.get("translate", [0, 0]), agent.get("start", 0)
    angle = math.radians(agent.get("rotate_deg", 0))
    c, s, dt = math.cos(angle), math.sin(angle), clip["dt"]
    placed = [(Exact(c * x - s * y + tx), Exact(s * x + c * y + ty), Exact(r)) for x, y, r in clip["samples"]]
    linear = clip.get("motion") == "linear" and len(placed) > 1
    return [(Exact(start + i * dt), Exact(start + (i + 1) * dt), placed[i], placed[i + 1 if linear else i])
            for i in range(len(placed) - 1 if linear else len(placed))]


def at(disk, time):
    begin, end, first, last = disk
    share = (time - begin) / (end - begin)
    return [a + share * (b - a) for a, b in zip(first, last)]


def tolerance(points):
    return MOMENT * max(1, max(max(abs(x), abs(y)) for x, y, _ in points) / 10000)


def why_tile_fails(tile, a, b):
    t0, t1, gap, speed = (Exact(tile.get(key, 0)) for key in ("t0", "t1", "gap", "speed"))
    ux, uy = map(Exact, tile["direction"])
    if t1 <= t0 or abs(math.hypot(*tile["direction"]) - 1) > 1e-15:
        return "no time, or no unit direction"
    reach, points = [], []
    for side, way in ((a, 1), (b, -1)):
        found = []
        for disk in side:
            begin, end = max(disk[0], t0), min(disk[1], t1)
            if end > begin:
                for time in (begin, end):
                    x, y, r = at(disk, time)
                    points.append((x, y, r))
                    found.append(way * (ux * x + uy * y - speed * (time - t0)) + r)
        reach.append(max(found, default=None))
    if None in reach:
        return None
    allowed = tolerance(points)
    if gap < -allowed:
        return "a negative gap"
    return "a disk passes the line" if reach[0] + gap + reach[1] > allowed else None


def why_not_proven(scene, entry):
    a, b = disks(scene, entry["a"]), disks(scene, entry["b"])
    end = min(a[-1][1], b[-1][1])
    if entry["contact"]:
        time = Exact(entry["contact"]["time"])
        end = time - max(MOMENT, abs(time) / 2**51)  # a moment, or the rounding of such a time
    for tile in entry["tiles"]:
        why = why_tile_fails(tile, a, b)
        if why:
            return why
    edges = [max(a[0][0], b[0][0])] + [Exact(tile[key]) for tile in entry["tiles"] for key in ("t0", "t1")] + [end]
    if any(later < earlier for earlier, later in zip(edges[1:-1], edges[2:-1])):
        return "tiles are not in order of time"
    for crack in zip(edges[::2], edges[1::2]):
        for p in a:
            for q in b:
                begin, last = max(p[0], q[0]), min(p[1], q[1])
                if last - begin > MOMENT and min(last, crack[1]) > max(begin, crack[0]):
                    return "nothing is said of some pair"
    return None
