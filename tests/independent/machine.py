"""A machine as a chain of axes from the workpiece to the tool: forward and inverse kinematics, written from the formulas of the design
notes (sec. 2.1, 2.2) and, for the inverse, from the cosine equation of the angle to the first axis, not from the notes' closed form."""

import math
from dataclasses import dataclass, field

from space import add, cross, dot, norm, scale, solve3, sub, turn, unit


@dataclass
class Axis:
    letter: str
    rotary: bool
    side: str
    direction: tuple
    sign: int = 1
    point: tuple = (0.0, 0.0, 0.0)
    limits: tuple | None = None  # mm or deg; None: unbounded
    vmax: float = 100.0  # mm/s or deg/s
    extra: str = ""  # further lines of TOML


@dataclass
class Machine:
    axes: list
    tool_axis: tuple = (0.0, 0.0, 1.0)
    gauge: tuple = (0.0, 0.0, 0.0)
    control: dict = field(default_factory=dict)

    def axis(self, letter):
        return next((a for a in self.axes if a.letter == letter), None)

    @property
    def letters(self):
        return [a.letter for a in self.axes]

    @property
    def rotaries(self):
        return [a for a in self.axes if a.rotary]

    @property
    def linears(self):
        return [a for a in self.axes if not a.rotary]

    def carry(self, joints, point):
        """A point that hangs on the tool, in the frame of the part; joints in mm and degrees by letter."""
        for a in reversed(self.axes):
            q = a.sign * joints[a.letter]
            if a.rotary:
                point = add(a.point, turn(a.direction, math.radians(q), sub(point, a.point)))
            else:
                point = add(point, scale(a.direction, q))
        return point

    def tip(self, joints, length):
        return self.carry(joints, sub(self.gauge, scale(self.tool_axis, length)))

    def direction(self, joints):
        """The tool axis, tip to spindle, in the frame of the part."""
        v = self.tool_axis
        for a in reversed(self.rotaries):
            v = turn(a.direction, math.radians(a.sign * joints[a.letter]), v)
        return v

    def linears_for(self, rotary, tip, length):
        """The three linear joints that put the tip there while the rotary ones stand as given."""
        names = [a.letter for a in self.linears]
        at = dict(rotary) | {n: 0.0 for n in names}
        origin = self.tip(at, length)
        columns = [sub(self.tip(at | {n: 1.0}, length), origin) for n in names]
        return dict(zip(names, solve3(columns, sub(tip, origin))))

    def postures(self, u):
        """Both settings (first, second), each in degrees in (-180, 180], that give the tool axis u; the first is None at the pole."""
        first, second = self.rotaries
        e1, e2, k = first.direction, second.direction, self.tool_axis
        along = scale(e2, dot(e2, k))
        across = sub(k, along)
        side = cross(e2, k)
        b, c = dot(e1, across), dot(e1, side)
        reach = math.hypot(b, c)
        wanted = (dot(e1, u) - dot(e1, along)) / reach
        if abs(wanted) > 1 + 1e-12:
            return []
        middle, half = math.atan2(c, b), math.acos(max(-1.0, min(1.0, wanted)))
        found = []
        for t2 in (middle + half, middle - half):
            w = turn(e2, t2, k)
            w_across, u_across = sub(w, scale(e1, dot(e1, w))), sub(u, scale(e1, dot(e1, u)))
            t1 = None
            if norm(u_across) > 1e-9 and norm(w_across) > 1e-9:
                t1 = math.degrees(math.atan2(dot(e1, cross(w_across, u_across)), dot(w_across, u_across)))
                t1 = wrap(first.sign * t1)
            found.append((t1, wrap(second.sign * math.degrees(t2))))
        return found

    def branch(self, joints):
        """The sign quantity S of the notes, sec. 2.3."""
        first, second = self.rotaries
        e2 = turn(first.direction, math.radians(first.sign * joints[first.letter]), second.direction)
        return dot(first.direction, cross(e2, self.direction(joints)))

    def toml(self, name="random"):
        def row(v):
            return "[" + ", ".join(repr(float(x)) for x in v) + "]"

        out = ['schema = "ncmachine/1"', f'name = "{name}"', 'units = { length = "mm", angle = "deg", time = "s" }']
        out += ["[spindle]", f"tool_axis = {row(self.tool_axis)}", f"gauge_point = {row(self.gauge)}"]
        for a in self.axes:
            out += ["[[axis]]", f'letter = "{a.letter}"', f'kind = "{"rotary" if a.rotary else "linear"}"', f'side = "{a.side}"']
            out += [f"dir = {row(a.direction)}", f"sign = {a.sign}"]
            if a.rotary:
                out.append(f"point = {row(a.point)}")
            out.append(f"limits = {row(a.limits)}" if a.limits else 'limits = "unbounded"')
            out.append(f"dyn = {{ vmax = {float(a.vmax)!r} }}")
            if a.extra:
                out.append(a.extra)
        out.append("[control]")
        out += [f"{key} = {value}" for key, value in self.control.items()]
        return "\n".join(out) + "\n"


def wrap(degrees):
    """The same angle in (-180, 180]."""
    d = math.fmod(degrees, 360.0)
    if d > 180:
        d -= 360
    if d <= -180:
        d += 360
    return d


def nudge(rng, v, by):
    return unit(add(v, tuple(rng.uniform(-by, by) for _ in range(3))))


X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def random_machine(rng, control, kinds=("tt", "ht", "hh", "nut"), askew=0.3):
    """A machine with two rotary axes: tables, a head and a table, or heads; one in three with nutating or tilted axes."""
    kind = rng.choice(kinds)
    pairs = [("C", Z, "A", X), ("C", Z, "B", Y), ("A", X, "B", Y), ("B", Y, "A", X)]
    if kind == "hh" or kind == "nut":
        pairs = pairs[:2]
    l1, e1, l2, e2 = rng.choice(pairs)
    if kind == "nut":
        nu = math.radians(rng.choice([30, 40, 45, 50, 60]))
        l1, e1, l2, e2 = "C", Z, "B", (0.0, math.sin(nu), math.cos(nu) * rng.choice([1, -1]))
    if rng.random() < askew:
        e1, e2 = nudge(rng, e1, 0.1), nudge(rng, e2, 0.1)

    def rotary(letter, direction, side):
        limits = rng.choice([None, None, (-360.0, 360.0), (-200.0, 200.0), (float(-rng.randint(30, 120)), float(rng.randint(30, 120)))])
        point = tuple(round(rng.uniform(-80, 80), 3) for _ in range(3)) if rng.random() < 0.8 else (0.0, 0.0, 0.0)
        return Axis(letter, True, side, direction, rng.choice([1, -1]), point, limits, rng.choice([20.0, 60.0, 120.0, 360.0]))

    lin = []
    for letter, direction in (("X", X), ("Y", Y), ("Z", Z)):
        if rng.random() < askew / 3:
            direction = nudge(rng, direction, 0.3)
        span = float(rng.choice([150, 300, 600, 3000]))
        lin.append(Axis(letter, False, "head", direction, rng.choice([1, 1, 1, -1]) if askew else 1, (0.0,) * 3, (-span, span), rng.choice([50.0, 200.0, 500.0])))
    rng.shuffle(lin)
    tables = {"tt": 2, "ht": 1, "hh": 0, "nut": rng.choice([0, 2])}[kind]
    r1, r2 = rotary(l1, e1, "table" if tables >= 1 else "head"), rotary(l2, e2, "table" if tables == 2 else "head")
    cut = rng.randint(0, 3)
    if tables == 2:
        for a in lin[:cut]:
            a.side = "table"
        axes = lin[:0] + [r1, r2] + lin
    elif tables == 1:
        for a in lin[:cut]:
            a.side = "table"
        axes = [r1] + lin + [r2]
    else:
        for a in lin[:cut]:
            a.side = "table"
        axes = lin + [r1, r2]
    gauge = (0.0,) * 3 if rng.random() < 0.6 else tuple(round(rng.uniform(-50, 50), 3) for _ in range(3))
    tool_axis = (0.0, 0.0, 1.0) if not askew or rng.random() < 0.7 else nudge(rng, Z, 0.2)
    return Machine(axes, tool_axis, gauge, dict(control))
