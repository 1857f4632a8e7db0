"""Conversions: a random program is converted to another machine, control or way of writing, the result is read and followed here, and both
tool paths are compared moment for moment within each cut: tip, tool axis and time."""

import bisect
import math
import random
import re

import lines
from compare import Findings
from follow import Follower, minutes, nearest
from machine import random_machine
from reader import Reader, Unread
from space import angle, sub, to_segment
from trunnion import ENDINGS, Broken

WINDOW = 0.01  # of the time that the cut takes
CLAIM = re.compile(r"the tip is proved within ([\d.]+) mm \(allowed ([\d.]+) mm\) and the tool axis within ([\d.]+) deg")


class Cuts:
    """The cuts of a run: each an uninterrupted row of feed motions, as tip and tool axis against time."""

    def __init__(self, legs, machine, length):
        self.length, self.machine, self.groups, self.rapids, fresh = length, machine, [], [], True
        for leg in legs:
            if leg.end is None or leg.start is None and leg.motion.kind != "rapid":
                raise ValueError("not known")
            if leg.motion.kind == "rapid":
                fresh = True
                self.rapids.append(leg)
                continue
            took = minutes(leg, machine)
            if took is None or math.isnan(took):
                raise ValueError("time not known")
            if took < 1e-12:
                continue
            if fresh:
                self.groups.append(([], [0.0]))
                fresh = False
            legs_, times = self.groups[-1]
            legs_.append(leg)
            times.append(times[-1] + took)

    def places(self, group):
        """Share of the time, tip of the tool in the spindle (whatever length the control reckons with) from the zero point in force, and its
        axis, at the ends of all motions and evenly between."""
        legs, times = self.groups[group]
        out = []
        for i, leg in enumerate(legs):
            fine = 300 if leg.motion.kind in ("cw", "ccw") else max(2, min(200, 1200 // len(legs)))
            # the tip runs on a curve where an axis turns: five places a degree
            turn = max((abs(leg.end[x.letter] - leg.start[x.letter]) for x in self.machine.rotaries), default=0.0)
            fine = max(fine, min(2000, int(5 * turn)))
            zero = tuple(leg.motion.shift[a] for a in "XYZ")
            for k in range(fine + 1 if i == len(legs) - 1 else fine):
                q = leg.joints(k / fine)
                t = (times[i] + (times[i + 1] - times[i]) * k / fine) / times[-1]
                out.append((t, sub(self.machine.tip(q, self.length), zero), self.machine.direction(q)))
        return out


def follow(text, machine, dialect, tools, zero):
    def posture(u, start, motion):
        return nearest(machine, u, [start[a.letter] or 0.0 for a in machine.rotaries])

    follower = Follower(machine, posture)
    reader = Reader(dialect, tools, zero, follower.position)
    return [follower.step(m) for m in reader.run(text)]


def control(dialect, rng):
    from run import control as plain

    return plain(rng, dialect)


def case(seed, theme):
    rng = random.Random(f"{theme}-{seed}")
    here, there = rng.choice(["fanuc-30i", "sinumerik-840d", "linuxcnc"]), rng.choice(["fanuc-30i", "sinumerik-840d", "linuxcnc", "haas-ngc"])
    machine = random_machine(rng, control(here, rng), askew=rng.choice([0.0, 0.4]))
    same = rng.random() < 0.4
    other = machine if same else random_machine(rng, control(there, rng), askew=rng.choice([0.0, 0.4]))
    for a in machine.axes + other.axes:
        a.limits = None if a.rotary else (-9000.0, 9000.0)
    tools = {n: round(rng.uniform(0, 150), 2) for n in (1, 2, 3)}
    zero = {"G54": {a: round(rng.uniform(-30, 30), 3) for a in "XYZ"}, "G55": {a: round(rng.uniform(-30, 30), 3) for a in "XYZ"}}
    options = rng.choice([[], [], ["--no-tcp"], ["--no-tcp"], ["--orientation", "vectors"], ["--lines-only"], ["--units", "inch"], ["--via-apt"], ["--via-apt"]])
    themes = rng.choice([{"tcp"}, {"tcp", "arcs"}, {"tcp", "arcs", "g91", "inch", "feeds", "shifts"}]) | {"own-length"}
    tools[2] = tools[1]  # whichever number is switched on, it is the tool in the spindle
    text = lines.program(rng, machine, here, rng.randint(3, 8), themes)
    return machine, here, tools, zero, text, same, other, here if same else there, options


def judge(trunnion, machine, dialect, tools, zero, text, same, other, to, options):
    findings = Findings()
    body = "\n".join(text) + "\n"
    try:
        before = Cuts(follow(body, machine, dialect, tools, zero), machine, tools[1])
    except (Unread, ValueError):
        return findings
    trunnion.settings(machine, tools, zero)
    trunnion.write("m2.toml", other.toml("other"))
    name = trunnion.write("p." + ENDINGS[dialect], body)
    more = [] if same else ["--to-machine", "m2.toml"]
    try:
        if "--via-apt" in options:
            made = trunnion.call("convert", name, "--machine", "m.toml", "--dialect", dialect, "--to", "apt")
            if made.returncode != 0:
                findings.motions, findings.unknown = 1, 1
                return findings
            name, dialect = trunnion.write("p.apt", made.stdout), "apt"
            # CL data stand alone: the machine is the one that they are written for
            trunnion.write("m.toml", other.toml())
            more, options = [], []
        done = trunnion.call("convert", name, "--machine", "m.toml", "--dialect", dialect, "--to", to, *more, *options, quiet=False)
    except Broken as broken:
        findings.append(str(broken))
        return findings
    findings.motions += 1
    if done.returncode != 0 and "the tip ends" in done.stderr:
        findings.append(f"its own proof refutes what it wrote: {done.stderr.strip()[-200:]}")
        return findings
    if done.returncode != 0:
        findings.unknown += 1
        reason = re.sub(r"[-\d.]+", "#", done.stderr.strip().splitlines()[-1].split(": ", 1)[-1])[:90] if done.stderr.strip() else "?"
        findings.reasons[reason] = findings.reasons.get(reason, 0) + 1
        return findings
    claim = CLAIM.search(done.stderr) if dialect != "apt" else None  # of the second step alone
    try:
        after = Cuts(follow(done.stdout, other, to, tools, zero), other, tools[1])
    except (Unread, ValueError) as why:
        findings.reasons[f"result not read: {why!r}"] = 1
        return findings
    same_path(before, after, claim, findings)
    if findings:
        trunnion.write("converted.txt", done.stdout + done.stderr)
    return findings


def same_path(before, after, claim, findings):
    if len(before.groups) != len(after.groups):
        findings.append(f"{len(before.groups)} cuts became {len(after.groups)}")
        return
    allowed = float(claim.group(1)) + 2e-3 if claim else 0.022  # two steps of 0.01 mm
    turned = math.radians(float(claim.group(3)) + 2e-4) if claim else math.inf
    for g in range(len(before.groups)):
        t0, t1 = before.groups[g][1][-1], after.groups[g][1][-1]
        if abs(t0 - t1) > 1e-3 * t0 + 1e-9:
            findings.append(f"cut {g + 1} takes {t0 * 60:.5f} s, converted {t1 * 60:.5f} s")
            continue
        compare_cut(before.places(g), after.places(g), g, allowed, turned, findings)


def compare_cut(before, after, g, allowed, turned, findings):
    """Each place of one way near the other one. Times along chords differ a little from those along an arc, so the places are looked for
    in a window of time, and the tool axis may differ by what it turns there."""
    for end in (0, -1):
        off = angle(before[end][2], after[end][2])
        if off > math.radians(0.001):
            findings.append(f"cut {g + 1}: the tool axis is {math.degrees(off):.5f} deg off at its {'end' if end else 'start'}")
    tip = axis = steps = 0.0
    for one, two in ((before, after), (after, before)):
        times = [place[0] for place in two]
        for t, p, u in one:
            low = max(0, bisect.bisect_left(times, t - WINDOW) - 1)
            high = min(len(two) - 1, bisect.bisect_right(times, t + WINDOW) + 1)
            tip = max(tip, min(to_segment(p, two[i][1], two[i + 1][1]) for i in range(low, high)))
            axis = max(axis, min(angle(u, two[i][2]) for i in range(low, high + 1)))
        steps = max([steps] + [angle(a[2], b[2]) for a, b in zip(one, one[1:])])
    if tip > allowed:
        findings.append(f"cut {g + 1}: the tip strays by {tip:.6f} mm, claimed {allowed:.6f}")
    if axis > turned + steps:
        findings.append(f"cut {g + 1}: the tool axis strays by {math.degrees(axis):.5f} deg, claimed {math.degrees(turned):.5f}")
