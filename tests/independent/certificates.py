"""`certify` and `diff`: what is proved or told to be the same tool path must be the same here, and what is the same must not be refuted."""

import math
import random
import re

import lines
from compare import Findings
from reader import Unread
from space import angle, norm, sub
from trunnion import ENDINGS, Broken

MM, DEGREES = 0.001, 0.001  # what `certify` allows by default


def change(rng, text):
    """One number of a block that moves, written otherwise, hardly changed, or changed."""
    moving = [i for i, line in enumerate(text) if re.search(r"[XYZABC]-?[\d.]", line) and "G92" not in line]
    at = rng.choice(moving)
    words = list(re.finditer(r"([XYZABCIJKF])(-?\d*\.\d*)", text[at]))
    if not words:
        return text
    word = rng.choice(words)
    by = rng.choice([0.0, 0.0, 1e-5, 0.0007, 0.002, 0.05, 1.0, 360.0 if word[1] in "ABC" else 5.0]) * rng.choice([1, -1])
    new = f"{word[1]}{float(word[2]) + by:.7f}"
    return [*text[:at], text[at][: word.start()] + new + text[at][word.end() :], *text[at + 1 :]]


def case(seed, theme):
    import run

    rng = random.Random(f"{theme}-{seed}")
    dialect = rng.choice(list(lines.WORDS))
    machine = run.random_machine(rng, run.control(rng, dialect), askew=rng.choice([0.0, 0.5]))
    tools = {n: round(rng.uniform(0, 150), 2) for n in (1, 2, 3)}
    zero = run.offsets(rng, machine, rotary=False)
    themes = rng.choice([{"tcp"}, {"tcp", "arcs"}, {"tcp", "offsets", "shifts", "g91", "feeds"}]) | {"own-length"}
    text = lines.program(rng, machine, dialect, rng.randint(3, 8), themes)
    return machine, dialect, tools, zero, text, change(rng, text)


def apart(before, after, machine):
    """Largest distance of tips and angle of tool axes at the same moments, or None where something is not known."""
    mm = turn = 0.0
    for old, new in zip(before, after):
        if old.end is None or new.end is None:
            return None
        if old.joints is None or new.joints is None:
            pairs = [(old.end, new.end)]
        else:
            pairs = [(old.joints(k / 50), new.joints(k / 50)) for k in range(51)]
        if old.motion.kind == "rapid":
            pairs = [(old.end, new.end)]
        for p, q in pairs:
            shift = sub(machine.tip(p, old.motion.length), machine.tip(q, new.motion.length))
            zero = sub(tuple(old.motion.shift[a] for a in "XYZ"), tuple(new.motion.shift[a] for a in "XYZ"))
            mm = max(mm, norm(sub(shift, zero)))
            turn = max(turn, math.degrees(angle(machine.direction(p), machine.direction(q))))
    return mm, turn


def judge(trunnion, machine, dialect, tools, zero, text, other):
    import run

    findings = Findings()
    bodies = ["\n".join(t) + "\n" for t in (text, other)]
    try:
        before, after = (run.legs_of(body, machine, dialect, tools, zero, []) for body in bodies)
    except (Unread, ValueError):
        return findings
    trunnion.settings(machine, tools, zero)
    names = [trunnion.write(f"{name}.{ENDINGS[dialect]}", body) for name, body in zip("pq", bodies)]
    try:
        done = trunnion.call("certify", *names, "--machine", "m.toml", "--dialect", dialect)
    except Broken as broken:
        findings.append(str(broken))
        return findings
    off = apart(before, after, machine) if len(before) == len(after) else (math.inf, math.inf)
    compared = trunnion.call("diff", *names, "--machine", "m.toml", "--dialect", dialect)
    # ends and centres within the tolerance: a way may be a few times that off
    if compared.stdout.splitlines()[-1].startswith("SAME") and off and (off[0] > 5 * MM or off[1] > 5 * DEGREES):
        findings.append(f"diff: {compared.stdout.strip()[:200]}: {off[0]:.6f} mm, {off[1]:.6f} deg apart")
    findings.motions += 1
    said = done.stdout.split(" ")[0]
    if said not in ("PROVED", "REFUTED") or off is None:
        findings.unknown += 1
        if said == "PROVED" and bodies[0] != bodies[1] and off is None:
            findings.reasons["proved, not known here"] = 1
        return findings
    if said == "PROVED" and (off[0] > MM * 1.001 or off[1] > DEGREES * 1.001):
        findings.append(f"{done.stdout.strip()[:200]}: {off[0]:.6f} mm, {off[1]:.6f} deg apart")
    if any(abs(old.end[a] - new.end[a]) > 1e-9 for old, new in zip(before, after) if old.motion.kind == "rapid" and old.end and new.end for a in old.end):
        return findings  # the way of a rapid counts too
    if said == "REFUTED" and off[0] < 1e-9 and off[1] < 1e-9 and not re.search("feed|time|long|takes", done.stdout):
        findings.append(f"refuted though the same: {done.stdout.strip()[:300]}")
    if findings:
        findings.append("    " + " | ".join(f"{a} -> {b}" for a, b in zip(text, other) if a != b))
    return findings
