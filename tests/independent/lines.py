"""Random programs of lines, arcs, offsets, lengths, units and feed modes, with and without tool centre point control."""

import math

from follow import PLANES

WORDS = {
    "fanuc-30i": dict(start=["G21 G17 G90 G94 G49"], on="G43.4 H{t}", off="G49", length="G43 H{t}", end=["M30"], inch="G20", mm="G21"),
    "sinumerik-840d": dict(start=["G71 G17 G90 G94"], on="TRAORI", off="TRAFOOF", length=None, end=["M30"], inch="G700", mm="G710"),
    "linuxcnc": dict(start=["G21 G17 G90 G94 G49"], on="M428", off="M429", length="G43 H{t}", end=["M2"], inch="G20", mm="G21"),
}


def value(rng, lo, hi, places=3):
    v = round(rng.uniform(lo, hi), rng.choice([0, 1, places]))
    text = f"{v:.{places}f}".rstrip("0")
    return text if text not in ("-0.", "0.") else "0."


def rotary_ranges(machine):
    return {a.letter: a.limits or (-170.0, 170.0) for a in machine.rotaries}


def random_words(rng, machine, state, inch):
    ranges = rotary_ranges(machine)
    k = 1 / 25.4 if inch else 1.0
    small = rng.random() < 0.5
    out = []
    for axis in "XYZ":
        if rng.random() < 0.5:
            lo, hi = ((-5, 5) if not state["absolute"] else (-60, 60)) if not small or state["absolute"] else (-1, 1)
            out.append(axis + value(rng, lo * k, hi * k, 4 if inch else 3))
    for r in (a.letter for a in machine.rotaries):
        if rng.random() < 0.35:
            lo, hi = ranges[r]
            if state["absolute"]:
                centre = state["rotary"].get(r, 0.0)
                step = rng.choice([1.0, 5.0, 20.0, 90.0])
                v = min(hi, max(lo, centre + rng.uniform(-step, step))) if rng.random() < 0.93 else rng.uniform(lo * 1.2, hi * 1.2)
                state["rotary"][r] = v
                out.append(r + value(rng, v, v))
            else:
                out.append(r + value(rng, -8, 8))
    return out


def program(rng, machine, dialect, blocks, themes):
    """`themes`: which of offsets, shifts, lengths, g91, inch, feeds, arcs, tcp occur beside plain lines."""
    w = WORDS[dialect]
    if "vectors" in themes and dialect == "fanuc-30i":
        w = w | {"on": "G43.5 H{t}"}
    state = {"absolute": True, "rotary": {}, "tcp": False, "inch": False, "feed": "G94", "tool": 1}
    n = "N10 " if rng.random() < 0.3 else ""
    lines = (["%", "O1"] if dialect == "fanuc-30i" else []) + list(w["start"]) + ["G54"]
    lines.append("T1 D1 M6" if dialect == "sinumerik-840d" else "T1 M6")
    lines.append(n + "S5000 M3")
    if dialect == "sinumerik-840d":
        lines.append("D1")
    led, long = "tcp" in themes and rng.random() < 0.7, "own-length" in themes or rng.random() < 0.7
    if w["length"] and long and not (led and dialect == "fanuc-30i"):
        lines.append(w["length"].format(t=1))
    if led:
        lines.append(w["on"].format(t=1))
        state["tcp"] = True
    r1, r2 = (a.letter for a in machine.rotaries)
    first = {r: rng.uniform(max(lo, -60), min(hi, 60)) for r, (lo, hi) in rotary_ranges(machine).items()}
    state["rotary"].update(first)
    if "vectors" in themes and rng.random() < 0.5:
        lines.append(rng.choice(["ORIVECT", "ORIAXES"]) if dialect == "sinumerik-840d" else "G90")
    lines.append(f"G0 X{value(rng, -40, 40)} Y{value(rng, -40, 40)} Z{value(rng, 0, 60)} {r1}{value(rng, *[first[r1]] * 2)} {r2}{value(rng, *[first[r2]] * 2)}")
    lines.append(f"F{rng.choice([100, 500, 2000, 8000])}.")
    for _ in range(blocks):
        lines += block(rng, machine, dialect, w, state, themes)
    return lines + w["end"] + (["%"] if dialect == "fanuc-30i" else [])


def block(rng, machine, dialect, w, state, themes):
    r = rng.random()
    if "offsets" in themes and r < 0.08:
        return [rng.choice(["G54", "G55", "G56", "G57"])]
    if "shifts" in themes and r < 0.16:
        return shift(rng, machine, dialect, state)
    if "tcp" in themes and r < 0.20:
        state["tcp"] = not state["tcp"]
        switch = [w["on" if state["tcp"] else "off"].format(t=rng.choice([1, 2]))]
        if state.get("motion") == "arc":
            switch.append("G1 Z10.")
            state["motion"] = "G1"
        return switch + [f"G0 X{value(rng, -40, 40)} Y{value(rng, -40, 40)} Z{value(rng, 0, 60)}"] if rng.random() < 0.8 else switch
    if "lengths" in themes and r < 0.25 and w["length"]:
        code = "G43.4" if state["tcp"] and dialect == "fanuc-30i" else "G43"
        if state["tcp"] and dialect == "linuxcnc":
            return [f"{code} H{rng.choice([1, 2, 3])} X{value(rng, -40, 40)} Y{value(rng, -40, 40)} Z{value(rng, 0, 60)}"]
        if state.get("motion") == "arc":
            return []
        return [f"{code} H{rng.choice([1, 2, 3])}" + rng.choice(["", f" Z{value(rng, 0, 50)}"])]
    if "g91" in themes and r < 0.32:
        state["absolute"] = not state["absolute"]
        return ["G90" if state["absolute"] else "G91"]
    if "inch" in themes and r < 0.36:
        state["inch"] = not state["inch"]
        return [w["inch" if state["inch"] else "mm"], f"F{rng.choice([5, 20, 100])}."]
    if "feeds" in themes and r < 0.42:
        state["feed"] = rng.choice(["G93", "G94", "G95"])
        f = {"G93": rng.choice(["20.", "2.", "0.5"]), "G94": rng.choice(["300.", "1500."]), "G95": rng.choice(["0.1", "0.02"])}[state["feed"]]
        return [f"{state['feed']} G1 F{f} " + " ".join(random_words(rng, machine, state, state["inch"]))]
    if "arcs" in themes and r < 0.75:
        return arc(rng, machine, dialect, state)
    if "vectors" in themes and state["tcp"] and r < 0.9:
        return vector(rng, machine, dialect, state)
    words = random_words(rng, machine, state, state["inch"])
    if not words:
        words = [f"X{value(rng, -1, 1)}"]
    code = rng.choices(["" if state.get("motion") != "arc" else "G1", "G1", "G0"], [4, 4, 1])[0]
    if code == "G0" or state.get("motion") == "G0" and code == "":
        code = code or "G1"
    state["motion"] = code or state.get("motion")
    if code != "G0" and state["feed"] == "G93":
        words.append(f"F{rng.choice(['20.', '2.', '0.5'])}")
    return [" ".join([code] + words).strip()]


def shift(rng, machine, dialect, state):
    r = [a.letter for a in machine.rotaries]
    axis = rng.choice(["X", "Y", "Z"] * 3 + r)
    v = value(rng, -20, 20)
    if dialect == "sinumerik-840d":
        return [rng.choice([f"TRANS {axis}{v}", f"ATRANS {axis}{v}", "TRANS"])]
    return [rng.choice([f"G52 {axis}{v}", f"G52 {axis}0.", f"G52 X0. Y0. Z0. {r[0]}0. {r[1]}0.", f"G92 {axis}{v}"])]


def arc(rng, machine, dialect, state):
    """A line to a point of a circle and the arc or helix from there; told by centre or radius, with rotary words or without."""
    plane = rng.choice(["G17", "G17", "G18", "G19"])
    a, b, c, i, j = PLANES[plane]
    k = 1 / 25.4 if state["inch"] else 1.0
    radius, w0 = rng.uniform(2, 30) * k, rng.uniform(0, 2 * math.pi)
    sweep = rng.choice([-1, 1]) * rng.uniform(0.2, 6.1)
    if rng.random() < 0.15:
        sweep = math.copysign(2 * math.pi, sweep)
    centre = rng.uniform(-20, 20) * k, rng.uniform(-20, 20) * k
    places = 5 if state["inch"] else 4

    def point(w):
        return round(centre[0] + radius * math.cos(w), places), round(centre[1] + radius * math.sin(w), places)

    (x0, y0), (x1, y1) = point(w0), point(w0 + sweep)
    full = abs(sweep) > 6.2
    lines = [f"{'G90 ' if not state['absolute'] else ''}{plane} G1 {a}{x0:.{places}f} {b}{y0:.{places}f}"]
    words = [] if full else [f"{a}{x1:.{places}f}", f"{b}{y1:.{places}f}"]
    if rng.random() < 0.4:
        words.append(c + value(rng, -20 * k, 20 * k, places))
    for r in (x.letter for x in machine.rotaries):
        if rng.random() < 0.4:
            lo, hi = rotary_ranges(machine)[r]
            v = min(hi, max(lo, state["rotary"].get(r, 0.0) + rng.uniform(-30, 30)))
            state["rotary"][r] = v
            words.append(r + value(rng, v, v))
    state["absolute"], state["motion"] = True, "arc"
    if full or rng.random() < 0.7 or math.hypot(x1 - x0, y1 - y0) < 0.3 * radius or abs(abs(sweep) - math.pi) < 0.2:
        words += [f"{i}{centre[0] - x0:.{places + 1}f}", f"{j}{centre[1] - y0:.{places + 1}f}"]
    else:
        name = "CR=" if dialect == "sinumerik-840d" else "R"
        words.append(f"{name}{math.copysign(radius, math.pi - abs(sweep)):.{places}f}")
    if state["feed"] == "G93":
        words.append("F" + rng.choice(["20.", "2."]))
        lines[0] += " F2."
    return lines + [f"{'G3' if sweep > 0 else 'G2'} {' '.join(words)}"]


def vector(rng, machine, dialect, state):
    """A line, now and then a rapid, to a tool vector that the machine can reach: near the last one, or anywhere."""
    rotary = [a.letter for a in machine.rotaries]
    ranges = rotary_ranges(machine)
    far = rng.choice([2.0, 10.0, 40.0, 120.0])
    for r in rotary:
        lo, hi = ranges[r]
        state["rotary"][r] = min(hi, max(lo, state["rotary"].get(r, 0.0) + rng.uniform(-far, far)))
    u = machine.direction({a: 0.0 for a in machine.letters} | state["rotary"])
    names = ("A3=", "B3=", "C3=") if dialect == "sinumerik-840d" else ("I", "J", "K")
    words = [a + value(rng, -60, 60) for a in "XYZ" if rng.random() < 0.6] + [f"{n}{x:.6f}" for n, x in zip(names, u)]
    return [" ".join([rng.choices(["G1", "G0"], [6, 1])[0], *words])]
