"""Random programs in tilted working planes."""

import math

from follow import PLANES


def v(rng, lo, hi, places=3):
    text = f"{rng.uniform(lo, hi):.{places}f}"
    return text


def direction(rng, machine, ranges):
    """A tool axis that the machine can reach."""
    joints = {a: 0.0 for a in machine.letters}
    for letter, (lo, hi) in ranges.items():
        joints[letter] = rng.uniform(max(lo, -120), min(hi, 120))
    return machine.direction(joints)


def opening(rng, machine, dialect, ranges, more):
    """The lines that begin a plane; `more`: one in the coordinates of the plane in force."""
    u = direction(rng, machine, ranges) if rng.random() < 0.8 and not more else None
    shift = [v(rng, -20, 20) for _ in range(3)]
    if dialect == "fanuc-30i":
        i, j, k = (rng.uniform(-20, 20) for _ in range(3))
        if u:
            i, j, k = math.degrees(math.atan2(u[0], -u[1])), math.degrees(math.acos(max(-1.0, min(1.0, u[2])))), rng.uniform(-90, 90)
        code = "G68.4" if more else "G68.2"
        words = " ".join(f"{n}{x}" for n, x in zip("XYZ", shift)) + f" I{i:.4f} J{j:.4f} K{k:.4f}"
        return [f"{code} {words}", "G53.1"]
    mode = rng.choice([57, 27, 39, 45, 30, 54])
    angles = [rng.uniform(-25, 25) for _ in range(3)]
    if u and mode == 57:
        angles = [math.degrees(math.atan2(-u[1], u[2])), math.degrees(math.asin(u[0])), rng.uniform(-60, 60)]
    if u and mode == 27:
        angles = [math.degrees(math.atan2(u[1], u[0])), math.degrees(math.acos(max(-1.0, min(1.0, u[2])))), 0.0]
    later = [v(rng, -5, 5) if rng.random() < 0.5 else "0" for _ in range(3)]
    told = ",".join([*shift, *(f"{a:.4f}" for a in angles), *later])
    return [f'CYCLE800(0,"TC",0,{mode},{told},{rng.choice([-1, 1])})']


def work(rng, dialect):
    """Motions in a plane: the first names all three coordinates."""
    lines = [f"G0 X{v(rng, -30, 30)} Y{v(rng, -30, 30)} Z{v(rng, 20, 60)}"]
    for _ in range(rng.randint(2, 6)):
        kind = rng.random()
        if kind < 0.3:
            lines += arc(rng, dialect)
        else:
            words = [a + v(rng, -30, 30) for a in "XYZ" if rng.random() < 0.6] or ["Z" + v(rng, 0, 9)]
            lines.append(rng.choice(["G1 ", "G1 ", "G0 "]) + " ".join(words))
        if rng.random() < 0.15:
            lines += ["G91 G1 " + rng.choice("XYZ") + v(rng, -4, 4), "G90"]
    return lines


def arc(rng, dialect):
    name = rng.choice(list(PLANES))
    a, b, c, i, j = PLANES[name]
    radius, w0, sweep = rng.uniform(3, 20), rng.uniform(0, 6.28), rng.uniform(0.3, 5.9)
    centre = rng.uniform(-10, 10), rng.uniform(-10, 10)
    (x0, y0), (x1, y1) = ((centre[0] + radius * math.cos(w), centre[1] + radius * math.sin(w)) for w in (w0, w0 + sweep))
    rise = f" {c}{v(rng, 0, 20)}" if rng.random() < 0.3 else ""
    return [
        f"{name} G1 {a}{x0:.4f} {b}{y0:.4f}",
        f"G3 {a}{x1:.4f} {b}{y1:.4f}{rise} {i}{centre[0] - x0:.5f} {j}{centre[1] - y0:.5f}",
        "G17",
    ]


def program(rng, machine, dialect, ranges, words):
    """Planes and motions between them, without tool centre point control."""
    sinumerik = dialect == "sinumerik-840d"
    lines = list(words["start"]) + ["G54", "T1 D1 M6" if sinumerik else "T1 M6", "S5000 M3"] + (["D1"] if sinumerik else [])
    r1, r2 = ranges
    lines.append(f"G0 X{v(rng, -40, 40)} Y{v(rng, -40, 40)} Z{v(rng, 50, 90)} {r1}{v(rng, -20, 20, 2)} {r2}{v(rng, -20, 20, 2)}")
    lines.append("F800.")
    for _ in range(rng.randint(1, 3)):
        lines += opening(rng, machine, dialect, ranges, False)
        if not sinumerik and rng.random() < 0.8:
            lines.append(f"G43 H{rng.choice([1, 2])}")
        lines += work(rng, dialect)
        if not sinumerik and rng.random() < 0.3:
            lines += opening(rng, machine, dialect, ranges, True) + work(rng, dialect)
        lines.append("CYCLE800()" if sinumerik else "G69")
        if not sinumerik:
            lines.append(rng.choice(["G49", "G43 H1"]))
        ends = [f"{a}{v(rng, -30, 60)}" for a in "XYZ"]
        lines.append(f"G0 {' '.join(ends)}" + (f" {r1}{v(rng, -20, 20, 2)}" if rng.random() < 0.5 else ""))
        if rng.random() < 0.5:
            lines.append(f"G1 X{v(rng, -30, 30)} {r2}{v(rng, -20, 20, 2)}")
    return lines + words["end"]
