#!/usr/bin/env python3
"""Makes the walking skeletons in assets/clips/: GLB files from formulas and a seed, the same bytes every time.

A walker follows a heading h(t) at a speed that falls and rises with each step, and sways to the side once a stride:

    x' = v (1 + 0.08 sin 2pi s) cos h,  y' likewise    s = steps taken
    sideways offset 0.025 sin(pi s) m                  one stride is two steps

A wanderer does so at a speed of its own choosing: it walks, runs, turns, stops and sets off again.

Feet are planted on the floor beside that path and swing from plant to plant; hip and knee follow by inverse kinematics
of two bones. Arms swing against the legs. The seed varies the body's size, the swing of the arms and where feet land.

The files: metres, y up, facing the way they go; ground point (x, y) is (X, -Z). 19 joints, all in skin 0, root `Hips`.
Hips are keyed 30 times a second, the other joints 15 times, as normalized 16-bit quaternions. A mesh of one diamond a
bone lets any viewer show them.

Usage: scripts/make_walkers.py [--seed N] [FOLDER]    (default: seed 1, assets/clips beside this script's folder)
"""
import argparse
import bisect
import json
import math
import pathlib
import random
import struct

RATE = 30  # keys of the hips a second
LIMB_EVERY = 2  # the limbs' keys, one for so many of those
SUBSTEPS = 8  # the path is integrated finer than it is keyed
MARGIN = 3.0  # seconds of path before and after the clip, for feet planted there

# Name, parent, offset from the parent in metres; facing +Z, so that the left is +X.
JOINTS = [
    ("Hips", None, (0.0, 0.95, 0.0)),
    ("Spine", "Hips", (0.0, 0.12, 0.0)),
    ("Chest", "Spine", (0.0, 0.20, 0.0)),
    ("Neck", "Chest", (0.0, 0.22, 0.0)),
    ("Head", "Neck", (0.0, 0.11, 0.02)),
    ("LeftUpperArm", "Chest", (0.19, 0.15, 0.0)),
    ("LeftLowerArm", "LeftUpperArm", (0.0, -0.29, 0.0)),
    ("LeftHand", "LeftLowerArm", (0.0, -0.26, 0.0)),
    ("RightUpperArm", "Chest", (-0.19, 0.15, 0.0)),
    ("RightLowerArm", "RightUpperArm", (0.0, -0.29, 0.0)),
    ("RightHand", "RightLowerArm", (0.0, -0.26, 0.0)),
    ("LeftUpperLeg", "Hips", (0.09, -0.04, 0.0)),
    ("LeftLowerLeg", "LeftUpperLeg", (0.0, -0.435, 0.0)),
    ("LeftFoot", "LeftLowerLeg", (0.0, -0.435, 0.0)),
    ("LeftToes", "LeftFoot", (0.0, -0.06, 0.13)),
    ("RightUpperLeg", "Hips", (-0.09, -0.04, 0.0)),
    ("RightLowerLeg", "RightUpperLeg", (0.0, -0.435, 0.0)),
    ("RightFoot", "RightLowerLeg", (0.0, -0.435, 0.0)),
    ("RightToes", "RightFoot", (0.0, -0.06, 0.13)),
]
# Where a bone without a child joint ends, for the mesh.
TIPS = {"Head": (0.0, 0.2, 0.0), "LeftHand": (0.0, -0.16, 0.0), "RightHand": (0.0, -0.16, 0.0),
        "LeftToes": (0.0, 0.0, 0.06), "RightToes": (0.0, 0.0, 0.06)}
ANKLE = 0.08  # height of the ankle above the floor in metres


# ---- vectors, and quaternions as (w, x, y, z)

def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def scaled(a, k):
    return tuple(x * k for x in a)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return scaled(a, 1 / math.sqrt(dot(a, a)))


def mul(a, b):
    """First b, then a."""
    return (a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
            a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
            a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0])


def inverse(q):
    return (q[0], -q[1], -q[2], -q[3])


def turned(q, v):
    return mul(mul(q, (0.0, *v)), inverse(q))[1:]


def about(axis, degrees):
    half = math.radians(degrees) / 2
    return (math.cos(half), *scaled(axis, math.sin(half)))


X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def from_axes(x, y, z):
    """The rotation that takes X, Y, Z to three orthogonal unit vectors."""
    # Each component's square, largest first: dividing by a small one loses digits.
    squares = (1 + x[0] + y[1] + z[2], 1 + x[0] - y[1] - z[2], 1 - x[0] + y[1] - z[2], 1 - x[0] - y[1] + z[2])
    largest = max(range(4), key=lambda i: squares[i])
    d = 2 * math.sqrt(squares[largest])
    a, b, c = (y[2] - z[1]) / d, (z[0] - x[2]) / d, (x[1] - y[0]) / d
    e, f, g = (x[1] + y[0]) / d, (x[2] + z[0]) / d, (y[2] + z[1]) / d
    return ((d / 4, a, b, c), (a, d / 4, e, f), (b, e, d / 4, g), (c, f, g, d / 4))[largest]


# ---- the path

class Path:
    """Where hips go on the ground, in metres and radians; it begins at the origin."""

    def __init__(self, duration, heading, speed=1.3, steps_per_second=1.9, phase=0.0):
        self.duration = duration
        self.speed = speed
        self.steps_per_second = steps_per_second
        self.phase = phase
        self.heading = lambda t: heading(min(max(t, 0.0), duration))
        count = round((duration + 2 * MARGIN) * RATE * SUBSTEPS)
        step = 1 / (RATE * SUBSTEPS)
        points = [(0.0, 0.0)]
        for i in range(count):
            t = i * step - MARGIN
            v = speed * (1 + 0.08 * math.sin(2 * math.pi * self.steps(t)))
            x, y = points[-1]
            points.append((x + v * math.cos(self.heading(t)) * step, y + v * math.sin(self.heading(t)) * step))
        origin = points[round(MARGIN / step)]
        self.points = [sub(point, origin) for point in points]

    def steps(self, t):
        return self.steps_per_second * t + self.phase

    def time_of(self, s):
        """When so many steps are taken."""
        return (s - self.phase) / self.steps_per_second

    def point(self, t):
        """On the line that the body follows, without sway."""
        place = min(max((t + MARGIN) * RATE * SUBSTEPS, 0.0), len(self.points) - 1.0)
        i = min(int(place), len(self.points) - 2)
        a, b = self.points[i], self.points[i + 1]
        return add(a, scaled(sub(b, a), place - i))

    def beside(self, t, left):
        """So many metres to the left of the line."""
        x, y = self.point(t)
        h = self.heading(t)
        return (x - left * math.sin(h), y + left * math.cos(h))

    def hips(self, t):
        sway = 0.025 * (math.sin(math.pi * self.steps(t)) - math.sin(math.pi * self.phase))
        return self.beside(t, sway)


def turning(degrees, begin, end):
    """A heading that turns by so many degrees between two times, smoothly."""

    def heading(t):
        share = min(max((t - begin) / (end - begin), 0.0), 1.0)
        return math.radians(degrees) * share * share * (3 - 2 * share)

    return heading


def circling(t):
    """Lap after lap, the laps getting wider and narrower: about 9 s each, 2 m in radius."""
    return 2 * math.pi * t / 9.0 + 0.9 * math.sin(2 * math.pi * t / 42.0)


class Wander(Path):
    """A path made of stretches (seconds, speed, degrees to turn by), each blending into the next; speed 0 stands."""

    BLEND = 0.9  # seconds from one speed to the next

    def __init__(self, stretches):
        self.duration = sum(seconds for seconds, _, _ in stretches)
        self.stretches = stretches
        rate = RATE * SUBSTEPS
        count = round((self.duration + 2 * MARGIN) * rate)
        speeds = [self.speed_at(i / rate - MARGIN) for i in range(count)]
        turns = [self.turn_at(i / rate - MARGIN) for i in range(count)]
        cadences = self.whole_steps([self.cadence(v) for v in speeds], rate)
        self.speed = max(speeds)
        self.points, self.headings, self.counts = [(0.0, 0.0)], [0.0], [0.0]
        for v, turn, cadence in zip(speeds, turns, cadences):
            x, y = self.points[-1]
            h, s = self.headings[-1], self.counts[-1]
            v *= 1 + 0.08 * math.sin(2 * math.pi * s)
            self.points.append((x + v * math.cos(h) / rate, y + v * math.sin(h) / rate))
            self.headings.append(h + turn / rate)
            self.counts.append(s + cadence / rate)
        begin = round(MARGIN * rate)
        self.points = [sub(point, self.points[begin]) for point in self.points]
        self.headings = [h - self.headings[begin] for h in self.headings]
        self.phase = 0.0

    @staticmethod
    def cadence(speed):
        """Steps a second."""
        return 0.0 if speed < 0.02 else min(0.95 + 0.73 * speed, 2.2 + 0.2 * speed)

    @staticmethod
    def whole_steps(cadences, rate):
        """Stretched by a little, so that each stop comes between two steps, with both feet on the floor."""
        out = []
        while len(out) < len(cadences):
            begin = end = len(out)
            while end < len(cadences) and (cadences[end] > 0) == (cadences[begin] > 0):
                end += 1
            steps = sum(cadences[begin:end]) / rate
            scale = max(round(steps), 1) / steps if steps > 0 else 1.0
            out.extend(c * scale for c in cadences[begin:end])
        return out

    def stretch(self, t):
        """The stretch at a time, and how long it has lasted."""
        t = min(max(t, 0.0), self.duration - 1e-9)
        for i, (seconds, _, _) in enumerate(self.stretches):
            if t < seconds:
                return i, t
            t -= seconds
        return len(self.stretches) - 1, self.stretches[-1][0]

    def speed_at(self, t):
        i, since = self.stretch(t)
        before = self.stretches[max(i - 1, 0)][1]
        speed = self.stretches[i][1]
        return before + (speed - before) * smooth(since / self.BLEND)

    def turn_at(self, t):
        """Radians a second; slow at both ends of a stretch."""
        if not 0 <= t < self.duration:
            return 0.0
        i, since = self.stretch(t)
        seconds, _, degrees = self.stretches[i]
        share = since / seconds
        return math.radians(degrees) * 6 * share * (1 - share) / seconds

    def sampled(self, values, t):
        place = min(max((t + MARGIN) * RATE * SUBSTEPS, 0.0), len(values) - 1.0)
        i = min(int(place), len(values) - 2)
        return values[i] + (values[i + 1] - values[i]) * (place - i)

    def heading(self, t):
        return self.sampled(self.headings, t)

    def steps(self, t):
        return self.sampled(self.counts, t)

    def time_of(self, s):
        return bisect.bisect_left(self.counts, s) / (RATE * SUBSTEPS) - MARGIN


def wandering(seed):
    """Every way to go a few times, in an order that the seed decides."""
    turns = [(2.4, 1.3, 0), (1.8, 1.3, 0), (2.0, 1.35, 35), (2.0, 1.35, -35), (2.2, 1.25, 65), (2.2, 1.25, -65),
             (2.2, 1.1, 95), (2.2, 1.1, -95), (2.6, 1.0, 140), (2.6, 1.0, -140), (2.2, 0.8, 25), (2.2, 0.8, -25),
             (2.0, 1.6, 15), (2.0, 1.6, -15)]
    runs = [(2.6, 2.8, 0), (2.6, 2.8, 40), (2.6, 2.8, -40)]
    stops = [(2.2, 0.0, 0), (3.0, 0.0, 0)]
    chance = random.Random(seed)
    stretches = []
    for _ in range(2):
        lap = turns + runs + stops + stops[:1]
        chance.shuffle(lap)
        stretches += lap
    walk = (2.4, 1.3, 0)
    return [walk, *stretches, walk]


# ---- the body

class Gait:
    """How a body moves along its path; angles in degrees, lengths in metres."""

    def __init__(self, stance=0.6, lift=0.10, bob=0.02, crouch=0.0, lean=3.0, arms=24.0, elbow=18.0, yaw=6.0, swing=1.0,
                 roll=1.0):
        self.stance = stance  # share of a stride that a foot is on the floor
        self.lift = lift
        self.bob = bob
        self.crouch = crouch
        self.lean = lean
        self.arms = arms
        self.elbow = elbow
        self.yaw = yaw
        self.swing = swing  # of arms, spine and pelvis, as a share
        self.roll = roll  # of the feet, as a share

    def mixed(self, other, share):
        gait = Gait()
        for name, value in vars(self).items():
            setattr(gait, name, value + (getattr(other, name) - value) * share)
        return gait


WALK = Gait()
RUN = Gait(stance=0.36, lift=0.26, bob=0.03, crouch=0.05, lean=10.0, arms=38.0, elbow=80.0, yaw=8.0)
STAND = Gait(bob=0.0, crouch=-0.02, lean=1.0, elbow=22.0, swing=0.0, roll=0.0)


def smooth(share):
    share = min(max(share, 0.0), 1.0)
    return share * share * (3 - 2 * share)


class Walker:
    def __init__(self, path, gait, seed):
        self.path = path
        self.gait = gait
        chance = random.Random(seed)
        self.size = chance.uniform(0.97, 1.03)
        self.arms = chance.uniform(0.9, 1.1)
        self.offsets = {name: scaled(offset, self.size) for name, _, offset in JOINTS}
        self.jitter = [chance.uniform(-0.015, 0.015) for _ in range(512)]

    def gait_at(self, t):
        return self.gait

    def plant(self, side, stride):
        """Where a foot stands in its so-manieth stance, and the heading it has there. side: +1 left, -1 right."""
        if self.path.speed == 0:
            return self.path.beside(0.0, 0.1 * side), self.path.heading(0.0)
        # Sway is to the left where s is 0.5, so the left foot must carry the body there.
        s = 2 * stride + (0.5 if side > 0 else 1.5)
        t = self.path.time_of(s)
        jitter = self.jitter[(2 * stride + (side > 0)) % len(self.jitter)]
        return self.path.beside(t - 0.03, (0.07 + jitter) * side), self.path.heading(t)

    def foot(self, side, t):
        """Ground point, height of the ankle, heading and pitch (degrees, toes down) of a foot."""
        gait = self.gait_at(t)
        if self.path.speed == 0:
            point, heading = self.plant(side, 0)
            return point, ANKLE * self.size, heading, 0.0
        s = self.path.steps(t)
        # Stances are centred where plant() puts them.
        turn = (s - (0.5 if side > 0 else 1.5)) / 2 + gait.stance / 2
        stride = math.floor(turn)
        p = turn - stride
        point, heading = self.plant(side, stride)
        if p < gait.stance:
            along = p / gait.stance
            heel = gait.roll * smooth((along - 0.6) / 0.4)
            toes = gait.roll * (1 - smooth(along / 0.15))
            return point, (ANKLE + 0.10 * heel) * self.size, heading, 45 * heel - 18 * toes
        share = smooth((p - gait.stance) / (1 - gait.stance))
        end, end_heading = self.plant(side, stride + 1)
        height = ANKLE + 0.10 * gait.roll * (1 - share) + gait.lift * math.sin(math.pi * share)
        return (add(point, scaled(sub(end, point), share)), height * self.size,
                heading + (end_heading - heading) * share, gait.roll * (45 * (1 - share) - 18 * share))

    def leg(self, hip, knee_forward, ankle):
        """World rotations of upper and lower leg that bring the foot to `ankle`, or as near as it reaches."""
        upper = -self.offsets["LeftLowerLeg"][1]
        lower = -self.offsets["LeftFoot"][1]
        way = sub(ankle, hip)
        distance = min(math.sqrt(dot(way, way)), (upper + lower) * 0.999)
        down = unit(way)
        forward = unit(sub(knee_forward, scaled(down, dot(knee_forward, down))))
        cosine = (upper * upper + distance * distance - lower * lower) / (2 * upper * distance)
        knee = add(scaled(down, upper * cosine), scaled(forward, upper * math.sqrt(max(0.0, 1 - cosine * cosine))))
        rotations = []
        for bone in (knee, sub(scaled(down, distance), knee)):
            y = scaled(unit(bone), -1)
            z = unit(sub(knee_forward, scaled(y, dot(knee_forward, y))))
            rotations.append(from_axes(cross(y, z), y, z))
        return rotations

    def pose(self, t):
        """The translation of the hips, and the rotation of every joint that moves, relative to its parent."""
        gait = self.gait_at(t)
        s = self.path.steps(t)
        swing = gait.swing * math.sin(math.pi * (s - 0.5)) if self.path.speed else 0.12 * math.sin(1.3 * t)
        breath = math.sin(2 * math.pi * 0.25 * t)
        x, y = self.path.hips(t) if self.path.speed else self.path.beside(t, 0.012 * math.sin(1.1 * t))
        height = self.offsets["Hips"][1] - gait.crouch
        # Highest where one leg carries the body upright, or where a runner flies.
        height += gait.bob * math.cos(2 * math.pi * (s - 0.5)) * (1 if gait.stance > 0.5 else -1)
        hips = (x, height, -y)

        facing = about(Y, math.degrees(self.path.heading(t)) + 90)
        forward = turned(facing, Z)
        pelvis = mul(facing, mul(about(Y, gait.yaw * swing), about(Z, 2 * swing)))
        local = {"Hips": pelvis,
                 "Spine": mul(about(X, gait.lean), about(Y, -1.1 * gait.yaw * swing)),
                 "Chest": mul(about(X, 0.4 * breath), about(Y, -0.8 * gait.yaw * swing)),
                 "Head": about(X, -gait.lean)}
        for side, name in ((1, "Left"), (-1, "Right")):
            out = about(Z, 11 * side)
            local[name + "UpperArm"] = mul(out, about(X, -gait.arms * self.arms * swing * side + 0.2 * gait.elbow))
            local[name + "LowerArm"] = about(X, -gait.elbow * (1 + 0.5 * swing * side))
            point, ankle_height, heading, pitch = self.foot(side, t)
            hip = add(hips, turned(pelvis, self.offsets[name + "UpperLeg"]))
            upper, lower = self.leg(hip, forward, (point[0], ankle_height, -point[1]))
            foot = mul(about(Y, math.degrees(heading) + 90), about(X, pitch))
            local[name + "UpperLeg"] = mul(inverse(pelvis), upper)
            local[name + "LowerLeg"] = mul(inverse(upper), lower)
            local[name + "Foot"] = mul(inverse(lower), foot)
        return hips, local


class Wanderer(Walker):
    """Walks, runs or stands, as fast as its path goes."""

    def __init__(self, path, seed):
        super().__init__(path, WALK, seed)

    def gait_at(self, t):
        speed = self.path.speed_at(t)
        walking = STAND.mixed(WALK, smooth(speed / 0.7))
        return walking.mixed(RUN, smooth((speed - 1.6) / 1.0))


# ---- the file

class Buffer:
    """Bytes, and the views and accessors on them."""

    def __init__(self):
        self.data = bytearray()
        self.views = []
        self.accessors = []

    def add(self, kind, component, values, width, **more):
        """An accessor over values packed by the struct code `kind`."""
        self.data.extend(b"\0" * (-len(self.data) % 4))
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": struct.calcsize(kind) * len(values)})
        self.data.extend(struct.pack("<" + kind * len(values), *values))
        self.accessors.append({"bufferView": len(self.views) - 1, "componentType": component,
                               "count": len(values) // width,
                               "type": {1: "SCALAR", 3: "VEC3", 4: "VEC4", 16: "MAT4"}[width], **more})
        return len(self.accessors) - 1


FLOAT, SHORT, UNSIGNED_SHORT, UNSIGNED_BYTE = 5126, 5122, 5123, 5121


def float32(value):
    return struct.unpack("<f", struct.pack("<f", value))[0]


def diamonds(places, offsets):
    """Positions, joints and triangles of a diamond for every bone, in the rest pose."""
    positions, joints, triangles = [], [], []
    children = {}
    for name, parent, _ in JOINTS:
        children.setdefault(parent, []).append(name)
    for index, (name, _, _) in enumerate(JOINTS):
        ends = [offsets[child] for child in children.get(name, [])]
        if name in TIPS:
            ends.append(TIPS[name])
        for end in ends:
            start = places[name]
            along = unit(end)
            side = unit(cross(along, X if abs(along[0]) < 0.9 else Z))
            other = cross(along, side)
            waist = add(start, scaled(end, 0.25))
            first = len(positions) // 3
            corners = [start] + [add(waist, scaled(d, 0.035 * k)) for d, k in ((side, 1), (other, 1), (side, -1), (other, -1))]
            for corner in corners + [add(start, end)]:
                positions.extend(round(c, 4) for c in corner)
                joints.extend((index, 0, 0, 0))
            for k in range(4):
                a, b = first + 1 + k, first + 1 + (k + 1) % 4
                triangles.extend((first, b, a, first + 5, a, b))
    return positions, joints, triangles


def glb(name, walker):
    """The bytes of a clip."""
    index_of = {joint: index for index, (joint, _, _) in enumerate(JOINTS)}
    places = {}
    for joint, parent, _ in JOINTS:
        places[joint] = add(places.get(parent, (0.0, 0.0, 0.0)), walker.offsets[joint])

    buffer = Buffer()
    count = round(walker.path.duration * RATE)
    poses = [walker.pose(i / RATE) for i in range(count)]
    limb_frames = list(range(0, count, LIMB_EVERY))
    if limb_frames[-1] != count - 1:
        limb_frames.append(count - 1)

    def times(frames):
        values = [float32(i / RATE) for i in frames]
        return buffer.add("f", FLOAT, values, 1, min=[values[0]], max=[values[-1]])

    def rotations(joint, frames):
        values = []
        last = None
        for i in frames:
            w, x, y, z = poses[i][1][joint]
            # Of q and -q, the one nearer to the key before.
            sign = -1 if last and dot(last, (w, x, y, z)) < 0 else 1
            last = scaled((w, x, y, z), sign)
            values.extend(round(c * 32767) for c in (last[1], last[2], last[3], last[0]))
        return buffer.add("h", SHORT, values, 4, normalized=True)

    all_times, limb_times = times(range(count)), times(limb_frames)
    samplers, channels = [], []

    def channel(joint, path, key_times, values):
        samplers.append({"input": key_times, "output": values, "interpolation": "LINEAR"})
        channels.append({"sampler": len(samplers) - 1, "target": {"node": index_of[joint], "path": path}})

    translation = [round(c, 5) for hips, _ in poses for c in hips]
    channel("Hips", "translation", all_times, buffer.add("f", FLOAT, translation, 3))
    channel("Hips", "rotation", all_times, rotations("Hips", range(count)))
    for joint, _, _ in JOINTS[1:]:
        if joint in poses[0][1]:
            channel(joint, "rotation", limb_times, rotations(joint, limb_frames))

    positions, joints, triangles = diamonds(places, walker.offsets)
    corners = [positions[i:i + 3] for i in range(0, len(positions), 3)]
    attributes = {
        "POSITION": buffer.add("f", FLOAT, positions, 3, min=[float32(min(axis)) for axis in zip(*corners)],
                               max=[float32(max(axis)) for axis in zip(*corners)]),
        "JOINTS_0": buffer.add("B", UNSIGNED_BYTE, joints, 4),
        "WEIGHTS_0": buffer.add("B", UNSIGNED_BYTE, [255, 0, 0, 0] * len(corners), 4, normalized=True),
    }
    inverse_bind = [c for joint, _, _ in JOINTS
                    for c in (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, *(-round(p, 5) for p in places[joint]), 1)]
    nodes = []
    for joint, _, _ in JOINTS:
        node = {"name": joint, "translation": [round(c, 5) for c in walker.offsets[joint]]}
        children = [index_of[child] for child, parent, _ in JOINTS if parent == joint]
        if children:
            node["children"] = children
        nodes.append(node)
    nodes.append({"name": "Body", "mesh": 0, "skin": 0})
    document = {
        "asset": {"version": "2.0", "generator": "mobbscope make_walkers.py"},
        "scene": 0,
        "scenes": [{"nodes": [0, len(JOINTS)]}],
        "nodes": nodes,
        "meshes": [{"primitives": [{"attributes": attributes,
                                    "indices": buffer.add("H", UNSIGNED_SHORT, triangles, 1)}]}],
        "skins": [{"joints": list(range(len(JOINTS))), "skeleton": 0,
                   "inverseBindMatrices": buffer.add("f", FLOAT, inverse_bind, 16)}],
        "animations": [{"name": name, "samplers": samplers, "channels": channels}],
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [{"byteLength": len(buffer.data)}],
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    data = bytes(buffer.data) + b"\0" * (-len(buffer.data) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def clips():
    """Name -> path and gait."""
    return {
        "walk": (Path(5.0, turning(-15, 1.0, 4.0)), Gait()),
        "bend": (Path(5.0, turning(35, 1.5, 3.5), phase=0.4), Gait()),
        "turn": (Path(4.0, turning(90, 1.2, 2.8), speed=1.1, steps_per_second=1.8), Gait()),
        "run": (Path(3.0, turning(10, 0.5, 2.5), speed=3.0, steps_per_second=2.8), RUN),
        "stand": (Path(3.0, turning(0, 0.0, 1.0), speed=0.0, steps_per_second=0.0), Gait(bob=0.0, crouch=-0.03, lean=1.0, elbow=26.0)),
        "circle": (Path(42.0, circling, speed=1.35), Gait()),
    }


def main():
    parser = argparse.ArgumentParser(description="Makes the walking skeletons in assets/clips/.")
    parser.add_argument("folder", nargs="?", type=pathlib.Path,
                        default=pathlib.Path(__file__).resolve().parent.parent / "assets" / "clips")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for name, (path, gait) in clips().items():
        walker = Walker(path, gait, f"{arguments.seed} {name}")
        (arguments.folder / f"{name}.glb").write_bytes(glb(name, walker))
    seed = f"{arguments.seed} wander"
    (arguments.folder / "wander.glb").write_bytes(glb("wander", Wanderer(Wander(wandering(seed)), seed)))


if __name__ == "__main__":
    main()
