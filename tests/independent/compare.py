"""Holds what Trunnion says of a program against what the follower finds, motion by motion."""

import math

from follow import minutes, quickest
from space import angle, cross, dot, norm, sub, unit

TIGHT = 2e-6  # mm, deg: the table is written with nine decimals
TOLERANCE = 0.01  # mm: the default tolerance of the tip


class Findings(list):
    """Differences, and how much stayed unknown."""

    def __init__(self):
        super().__init__()
        self.motions = self.unknown = 0
        self.reasons = {}

    def say(self, line, text):
        self.append(f"line {line}: {text}")


def number(row, key):
    return float(row[key]) if row.get(key) not in (None, "") else None


def close(a, b, tolerance):
    return abs(a - b) <= tolerance * max(1.0, abs(a), abs(b))


def compare(legs, rows, report, machine, findings, lines=None):
    """`lines`: the line in the text that Trunnion read, for each leg, where the follower read another text."""
    if len(legs) != len(rows):
        findings.say(0, f"{len(rows)} motions, expected {len(legs)}")
        return
    told = Told(report, rows)
    before_known = False
    for index, (leg, row) in enumerate(zip(legs, rows)):
        line = (lines[index] or int(row["line"])) if lines else leg.motion.line
        if int(row["line"]) != line:
            findings.say(line, f"motion told at line {row['line']}")
            return
        findings.motions += 1
        ends(leg, row, line, machine, findings)
        known = all(number(row, "joint_" + a.lower()) is not None for a in machine.letters)
        start_known, before_known = before_known, known
        if leg.joints is None or not known or not start_known:
            continue
        between(leg, row, line, machine, findings, told)


def ends(leg, row, line, machine, findings):
    joints = {a: number(row, "joint_" + a.lower()) for a in machine.letters}
    if leg.end is None:
        told = all(v is not None for v in joints.values()) and (number(row, "x_mm") is not None or not leg.motion.swivel)
        if leg.why != "position" and told:
            findings.say(line, f"told as known: {leg.why}")
        return
    if any(v is None for v in joints.values()):
        findings.unknown += 1
        findings.reasons.setdefault("joints", []).append(line)
        for a, v in joints.items():
            if v is not None and not leg.motion.vector and abs(v - leg.end[a]) > TIGHT:
                findings.say(line, f"joint {a} {v}, expected {leg.end[a]:.6f}")
        return
    for a, v in joints.items():
        # a vector may ask for a limit plus rounding: the axis stands at the limit then
        if abs(v - leg.end[a]) > TIGHT * (50 if leg.motion.vector else 10):
            findings.say(line, f"joint {a} {v}, expected {leg.end[a]:.6f}")
    m = leg.motion
    tip = [number(row, a) for a in ("x_mm", "y_mm", "z_mm")]
    rotary_shift = any(m.shift[a] for a in "ABC") or None in m.shift.values()
    if None not in tip and not rotary_shift:
        truth = sub(machine.tip(leg.end, m.length), tuple(m.shift[a] for a in "XYZ"))
        if norm(sub(tuple(tip), truth)) > TIGHT * 10:
            findings.say(line, f"tip {tip}, expected {[round(v, 6) for v in truth]}")
    axis = [number(row, a) for a in "ijk"]
    if None not in axis and norm(sub(tuple(axis), machine.direction(leg.end))) > TIGHT:
        findings.say(line, f"tool axis {axis}, expected {machine.direction(leg.end)}")


class Told:
    """The findings of a report by rule and line."""

    def __init__(self, report, rows):
        # a finding carries those that follow from it
        self.diagnostics = [one for lead in report["diagnostics"] for one in [lead, *lead.get("also", [])]]
        lines = [row["line"] for row in rows]
        self.repeated = {int(line) for line in lines if lines.count(line) > 1}

    def at(self, rule, line, status=None):
        return [
            d for d in self.diagnostics
            if d["rule"] == rule and self.covers(d, line) and status in (None, d["status"])
        ]

    def excused(self, line):
        """An unknown verdict with its reason is an answer; these are told once for a whole run of blocks, wherever they stand."""
        everywhere = ("position-unknown", "path-deviation")
        return any(d["status"] == "unknown" and (d["line"] == line or d["rule"] in everywhere) for d in self.diagnostics)

    def covers(self, d, line):
        """Whether a finding is of that block; of a run of blocks only its ends are told, and where the program jumps it may be any."""
        many = d.get("count", 1) > 1
        return d["line"] <= line <= max(d.get("last_line") or 0, d["line"]) or many and bool(self.repeated)

    def fails(self, rule, line):
        """Firm findings of a block; none for one that runs several times, of which the finding may be of another pass."""
        told = [d for d in self.at(rule, line, "fail") if d["line"] == line and (d.get("count", 1) == 1 or not self.repeated)]
        return [] if line in self.repeated else told

    def any(self, rule, status="unknown"):
        return [d for d in self.diagnostics if d["rule"] == rule and d["status"] == status]


def between(leg, row, line, machine, findings, told):
    if told.excused(line):
        findings.reasons.setdefault("told as unknown", []).append(line)
        return
    m = leg.motion
    path_limits(leg, line, machine, findings, told)
    deviation = number(row, "tip_deviation_mm")
    if deviation is not None:
        truth = 0.0 if m.tcp and not m.machine_frame else leg.deviation(machine)
        slack = 1e-6 if m.kind in ("rapid", "linear") else 2e-3  # the programmed curve is sampled as chords
        if deviation < truth - slack - 1e-4 * truth:
            findings.say(line, f"deviation {deviation} is below the truth {truth:.6f}")
        if deviation > TOLERANCE and deviation > 1.2 * truth + slack:
            findings.say(line, f"deviation {deviation} is more than 1.2 times the truth {truth:.6f}")
        if m.kind != "rapid" and truth > TOLERANCE * 1.01 and not told.at("path-deviation", line):
            findings.say(line, f"silent pass: the tip strays by {truth:.4f} mm")
        if m.kind != "rapid" and truth < TOLERANCE * 0.8 and told.fails("path-deviation", line):
            findings.say(line, f"false path-deviation: the tip strays by {truth:.6f} mm only")
    elif m.kind != "rapid":
        findings.say(line, "silent pass: no deviation is told, and no finding says why")
    if m.kind == "rapid":
        return
    if m.vector:
        orientation(leg, line, machine, findings, told)
    speeds(leg, row, line, machine, findings, told)


def orientation(leg, line, machine, findings, told):
    """Angle of the tool axis to the plane of both vectors."""
    u0, u1 = machine.direction(leg.start), machine.direction(leg.end)
    if angle(u0, u1) < 1e-6 or angle(u0, u1) > 3.1:
        return
    normal = unit(cross(u0, u1))
    off = max(abs(math.degrees(math.asin(dot(normal, machine.direction(leg.joints(i / 100)))))) for i in range(101))
    if off > 0.101 and not told.at("orientation-deviation", line) and not told.any("orientation-deviation"):
        findings.say(line, f"silent pass: the tool axis leaves its plane by {off:.4f} deg")
    if off < 0.001 and angle(u0, u1) < 1.5 and told.fails("orientation-deviation", line):
        findings.say(line, f"false orientation-deviation: {off:.6f} deg")


def path_limits(leg, line, machine, findings, told):
    """An axis that stands beyond its travel at the start was told where it got there."""
    dogleg = leg.motion.kind == "rapid" and "dogleg" in machine.control.get("rapid", "")
    for a in machine.axes:
        # nobody says that each axis runs for itself while the control leads the tip
        if not a.limits or dogleg and not leg.motion.tcp:
            continue
        over = [max(a.limits[0] - q, q - a.limits[1]) for q in (leg.joints(i / 100)[a.letter] for i in range(101))]
        at = max(range(101), key=over.__getitem__)
        if over[at] > max(0.0, over[0]) + 1e-4 and not told.at("axis-limit", line):
            findings.say(line, f"silent pass: {a.letter} is {over[at]:.4f} beyond its travel at {at} %")
        failed = [d for d in told.fails("axis-limit", line) if d["values"].get("axis") == a.letter and not d.get("last_line")]
        if over[at] < -1e-3 and failed:
            findings.say(line, f"false axis-limit of {a.letter}: at most {over[at]:.4f}")


def speeds(leg, row, line, machine, findings, told):
    m = leg.motion
    took, told_s = minutes(leg, machine), number(row, "duration_s")
    moved = max(abs(leg.end[a] - leg.start[a]) for a in machine.letters) > 1e-6 or m.kind in ("cw", "ccw")
    if took is None or math.isnan(took) or not moved or took == 0:
        return
    need, who = quickest(leg, machine)
    least = max([took] + [abs(leg.end[a.letter] - leg.start[a.letter]) / a.vmax / 60 for a in machine.axes])
    if told_s is not None and not close(least * 60, told_s, 1e-5):
        findings.say(line, f"duration {told_s} s, expected {least * 60:.6f}")
    limit, feed = number(row, "feed_limit_mm_min"), number(row, "feed_mm_min")
    ratio = need / took  # above 1: the axes cannot follow
    if limit is not None and feed:
        says = feed / limit
        # near the pole the nodes miss the fastest moment of a great circle
        above = 2.5 if getattr(leg, "circle", False) else 1.05
        if not 0.98 * ratio - 1e-6 <= says <= above * ratio + 1e-6:
            findings.say(line, f"feed limit {limit:.3f} at F{feed}: ratio {says:.5f}, expected {ratio:.5f} ({who})")
    if ratio > 1.01 and not told.at("axis-overspeed", line) and not told.any("axis-overspeed"):
        findings.say(line, f"silent pass: {who} runs {ratio:.3f} times as fast as it can")
    if ratio < 0.95 and told.fails("axis-overspeed", line):
        findings.say(line, f"false axis-overspeed: {ratio:.3f} ({who})")
    if ratio > 1 / 0.78 and not told.at("feed-drop", line) and not told.any("feed-drop") and not told.any("axis-overspeed"):
        findings.say(line, f"silent pass: feed drops to {1 / ratio:.3f}")
