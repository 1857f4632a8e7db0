"""The machine follows the motions of a program: joints and tip along each block, as functions of the share t of the block in [0, 1]."""

import math
from dataclasses import dataclass

import planes
from space import add, angle, cross, dot, great_circle, mix, norm, scale, solve3, sub, to_segment, unit

PLANES = {"G17": ("X", "Y", "Z", "I", "J"), "G18": ("Z", "X", "Y", "K", "I"), "G19": ("Y", "Z", "X", "J", "K")}
NODES = 400


@dataclass
class Leg:
    motion: object
    start: dict | None  # joints, or None where not all are known
    end: dict | None
    joints: object = None  # t -> joints
    programmed: object = None  # t -> the tip where it should be, in the frame of the part
    why: str = ""  # why it is not known

    def deviation(self, machine, nodes=NODES):
        """Largest distance of the tip from the programmed curve, sampled; in mm."""
        tips = [machine.tip(self.joints(i / nodes), self.motion.length) for i in range(nodes + 1)]
        if self.motion.kind in ("rapid", "linear"):
            return max(to_segment(p, tips[0], tips[-1]) for p in tips)
        curve = [self.programmed(i / nodes) for i in range(nodes + 1)]
        worst = 0.0
        for i, p in enumerate(tips):
            worst = max(worst, min(to_segment(p, a, b) for a, b in zip(curve, curve[1:])))
        return worst


class Arc:
    """An arc or helix between two points given by axis words, in the coordinates of those words."""

    def __init__(self, motion, start, end):
        a, b, c, i, j = PLANES[motion.plane]
        self.names, self.start, self.end = (a, b, c), start, end
        if "R" in motion.arc or "CR" in motion.arc:
            radius = motion.arc.get("R", motion.arc.get("CR"))
            da, db = end[a] - start[a], end[b] - start[b]
            half = math.hypot(da, db) / 2
            up = math.sqrt(max(0.0, radius * radius - half * half))
            side = 1 if (motion.kind == "ccw") == (radius > 0) else -1
            self.centre = (start[a] + da / 2 - side * up * db / (2 * half), start[b] + db / 2 + side * up * da / (2 * half))
        else:
            self.centre = (start[a] + motion.arc.get(i, 0.0), start[b] + motion.arc.get(j, 0.0))
        self.from_angle = math.atan2(start[b] - self.centre[1], start[a] - self.centre[0])
        self.radii = [math.hypot(p[a] - self.centre[0], p[b] - self.centre[1]) for p in (start, end)]
        if abs(self.radii[0] - self.radii[1]) > 0.004 or min(self.radii) < 0.5:
            raise ValueError("radii of the arc")
        sweep = math.atan2(end[b] - self.centre[1], end[a] - self.centre[0]) - self.from_angle
        if motion.kind == "ccw":
            sweep = sweep % (2 * math.pi) or 2 * math.pi
            self.sweep = 2 * math.pi if sweep < 1e-9 else sweep
        else:
            sweep = sweep % (2 * math.pi) - 2 * math.pi
            self.sweep = -2 * math.pi if sweep > -1e-9 else sweep

    def at(self, t):
        a, b, c = self.names
        radius = self.radii[0] + (self.radii[1] - self.radii[0]) * t
        w = self.from_angle + self.sweep * t
        found = {a: self.centre[0] + radius * math.cos(w), b: self.centre[1] + radius * math.sin(w)}
        return found | {c: self.start[c] + (self.end[c] - self.start[c]) * t}

    def length(self):
        return math.hypot(self.sweep * sum(self.radii) / 2, self.end[self.names[2]] - self.start[self.names[2]])


class Follower:
    def __init__(self, machine, posture=None, great_circle_default=False, rotary_zero_open=True):
        self.machine, self.joints, self.length = machine, {a: None for a in machine.letters}, 0.0
        self.posture, self.great_circle = posture, great_circle_default

    def tool_shift(self, length):
        """How far the linear axes go, without tool centre point control, so that the tip of a tool in the home posture stands where the
        gauge point would: the length along the tool axis at home, told along the axes, however they stand."""
        home = {a: 0.0 for a in self.machine.letters}
        names = [a.letter for a in self.machine.linears]
        columns = [sub(self.machine.tip(home | {n: 1.0}, 0.0), self.machine.tip(home, 0.0)) for n in names]
        return dict(zip(names, solve3(columns, scale(self.machine.tool_axis, length))))

    def tip_here(self, length):
        if any(v is None for v in self.joints.values()):
            return None
        return dict(zip("XYZ", self.machine.tip(self.joints, length)))

    def position(self, axis, reader):
        """Machine coordinate of an axis as G92 needs it: of the tip under tool centre point control, else of the joint less the tool."""
        if axis in "ABC" or not reader.tcp:
            here = self.joints[axis]
            if here is None:
                return None
            return here - (self.tool_shift(reader.length)[axis] if axis in "XYZ" else 0.0)
        tip = self.tip_here(reader.length)
        return tip and tip[axis]

    def targets(self, m):
        """Joint words of the rotary axes and of the linear ones without tool centre point control; tip words with it."""
        out, here = dict(self.joints), self.tip_here(m.length) if m.tcp else None
        shift = self.tool_shift(m.length)
        tip = dict(here) if here else {"X": None, "Y": None, "Z": None}
        for axis, (value, increment) in m.words.items():
            into = tip if m.tcp and axis in "XYZ" and not m.machine_frame else out
            if axis not in into:
                raise ValueError(f"no axis {axis}")
            if increment:
                into[axis] = None if into[axis] is None else into[axis] + value
            elif m.machine_frame:
                into[axis] = value
            elif m.shift[axis] is None:
                into[axis] = None
            else:
                into[axis] = value + m.shift[axis] + (shift[axis] if axis in "XYZ" and not m.tcp else 0.0)
        return out, tip

    def swivel(self, m, start, known):
        """The rotary axes turn onto the plane, the linear ones stay."""
        chosen = self.posture(m.tilt[1][2], start, m) if self.posture else None
        if chosen is None:
            return self.lost(m, start, "posture")
        self.joints = start | chosen
        leg = Leg(m, start if known else None, dict(self.joints) if known else None, why="" if known else "position")
        if known:
            self.between(leg)
        return leg

    def in_plane(self, m, start, known):
        """X Y Z of the tip in a tilted plane; the rotary axes stand."""
        rotary = [a.letter for a in self.machine.rotaries]
        rot = {r: start[r] for r in rotary}
        if any(v is None for v in rot.values()) or any(m.shift[r] for r in rotary):
            return self.lost(m, start, "a plane from there")
        if angle(self.machine.direction({a: 0.0 for a in self.machine.letters} | rot), m.tilt[1][2]) > 1e-7:
            return self.lost(m, start, "the tool does not stand along the plane's normal")
        zero = tuple(m.shift[a] for a in "XYZ")
        here = self.tip_here(m.length)
        point = dict(zip("XYZ", planes.to_plane(m.tilt, sub(tuple(here[a] for a in "XYZ"), zero)))) if here else {a: None for a in "XYZ"}
        begin = dict(point)
        for axis, (value, increment) in m.words.items():
            point[axis] = value if not increment else None if point[axis] is None else point[axis] + value

        def joints_at(p):
            return rot | self.machine.linears_for(rot, add(zero, planes.to_work(m.tilt, tuple(p[a] for a in "XYZ"))), m.length)

        if any(v is None for v in point.values()):
            self.joints = rot | {a: None for a in self.machine.letters if a not in rot}
            return Leg(m, None, None, why="position")
        self.joints = joints_at(point)
        leg = Leg(m, start if known else None, dict(self.joints))
        if known:
            leg.path = Arc(m, begin, point) if m.kind in ("cw", "ccw") else None

            def at(t):
                return leg.path.at(t) if leg.path else {a: begin[a] + (point[a] - begin[a]) * t for a in "XYZ"}

            leg.joints = lambda t: joints_at(at(t))
            leg.programmed = lambda t: add(zero, planes.to_work(m.tilt, tuple(at(t)[a] for a in "XYZ")))
        return leg

    def step(self, m):
        rotary = [a.letter for a in self.machine.rotaries]
        start = dict(self.joints)
        known = all(v is not None for v in start.values())
        if m.tilt:
            return self.swivel(m, start, known) if m.swivel else self.in_plane(m, start, known)
        out, tip = self.targets(m)
        if m.tcp and any(m.shift[r] for r in rotary):
            return self.lost(m, start, "a rotary offset under tool centre point control")
        if m.vector:
            u = unit(m.vector)
            chosen = self.posture(u, start, m) if self.posture else None
            if chosen is None:
                return self.lost(m, start, "posture")
            out.update(chosen)
        if m.tcp and not m.machine_frame:
            if any(v is None for v in tip.values()) or any(out[r] is None for r in rotary):
                self.joints = {a: out[a] if a in rotary else None for a in self.machine.letters}
                return Leg(m, start if known else None, None, why="position")
            end_tip = tuple(tip[a] for a in "XYZ")
            rot = {r: out[r] for r in rotary}
            out = rot | self.machine.linears_for(rot, end_tip, m.length)
        if any(v is None for v in out.values()):
            self.joints = out
            return Leg(m, start if known else None, None, why="position")
        self.joints = dict(out)
        leg = Leg(m, start if known else None, dict(out))
        if known:
            self.between(leg)
        return leg

    def lost(self, m, start, why):
        self.joints = {a: None for a in self.machine.letters}
        return Leg(m, None, None, why=why)

    def between(self, leg):
        m, machine = leg.motion, self.machine
        rotary = [a.letter for a in machine.rotaries]
        arc = m.kind in ("cw", "ccw")
        if m.tcp and not m.machine_frame:
            p0, p1 = machine.tip(leg.start, m.length), machine.tip(leg.end, m.length)
            path = Arc(m, dict(zip("XYZ", p0)), dict(zip("XYZ", p1))) if arc else None
            leg.path = path

            def tip(t):
                return tuple(path.at(t)[a] for a in "XYZ") if path else mix(p0, p1, t)

            u0, u1 = machine.direction(leg.start), machine.direction(leg.end)
            circle = self.great_circle if m.great_circle is None else m.great_circle
            leg.circle = circle

            way = [tuple(leg.start[r] for r in rotary)]
            if circle and angle(u0, u1) > 3.1:
                leg.why = "opposite tool axes"
                return
            if circle:  # followed without jumps
                for i in range(1, NODES + 1):
                    near = nearest(machine, great_circle(u0, u1, i / NODES), way[-1])
                    if near is None:
                        leg.why = "out of reach on the way"
                        return
                    way.append(tuple(near.values()))
                if max(abs(leg.end[r] - q) for r, q in zip(rotary, way[-1])) > 1e-3:
                    leg.why = "the great circle leads to another posture"
                    return

            def joints(t):
                rot = {r: leg.start[r] + (leg.end[r] - leg.start[r]) * t for r in rotary}
                if circle:
                    rot = nearest(machine, great_circle(u0, u1, t), way[round(t * NODES)])
                return rot | machine.linears_for(rot, tip(t), m.length)

            leg.joints, leg.programmed = joints, tip
            return
        path = Arc(m, {a: leg.start[a] for a in "XYZ"}, {a: leg.end[a] for a in "XYZ"}) if arc else None
        leg.path = path

        def joints(t):
            q = {a: leg.start[a] + (leg.end[a] - leg.start[a]) * t for a in machine.letters}
            return q | path.at(t) if path else q

        leg.joints = joints
        if arc:
            held = {r: leg.start[r] for r in rotary}
            gap = sub(machine.tip(leg.end, m.length), machine.tip(dict(leg.end) | held, m.length))
            leg.programmed = lambda t: add(machine.tip(dict(joints(t)) | held, m.length), scale(gap, t))


def nearest(machine, u, have):
    """The posture for the tool axis u, by axis, with the windings that lie nearest to the two given angles; None where there is none."""
    best = None
    for pair in machine.postures(u):
        near = [h if q is None else q + 360 * round((h - q) / 360) for q, h in zip(pair, have)]
        cost = max(abs(n - h) for n, h in zip(near, have))
        if best is None or cost < best[0]:
            best = (cost, near)
    return best and dict(zip((a.letter for a in machine.rotaries), best[1]))


def minutes(leg, machine):
    """How long a feed motion takes, in minutes; None where the notes leave it open, 0 where nothing moves."""
    m = leg.motion
    if m.feed is None or m.feed == 0:
        return None
    if m.feed_mode == "G93":
        return 1 / m.feed
    feed = m.feed * (m.speed or math.nan) if m.feed_mode == "G95" else m.feed
    rotary = [a.letter for a in machine.rotaries]
    turns = [abs(leg.end[r] - leg.start[r]) for r in rotary]
    if m.kind in ("cw", "ccw"):
        way = leg.path.length()
    elif m.tcp or m.tilt:
        way = norm(sub(machine.tip(leg.end, m.length), machine.tip(leg.start, m.length)))
    else:
        way = math.sqrt(sum((leg.end[a] - leg.start[a]) ** 2 for a in "XYZ"))
    if way > 1e-9:
        return way / feed
    if m.tcp:
        return None
    return math.sqrt(sum(t * t for t in turns)) / (feed / (25.4 if m.inch else 1.0))


def quickest(leg, machine, nodes=NODES):
    """The shortest time the block can take, in minutes, so that no axis exceeds its speed while it is run evenly, and the axis that says so."""
    worst, who = 0.0, None
    before = leg.joints(0.0)
    for i in range(1, nodes + 1):
        now = leg.joints(i / nodes)
        for a in machine.axes:
            t = abs(now[a.letter] - before[a.letter]) * nodes / a.vmax / 60
            if t > worst:
                worst, who = t, a.letter
        before = now
    return worst, who
