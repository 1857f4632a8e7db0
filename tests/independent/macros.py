"""Programs with loops, conditions, subprograms and macros whose blocks lead the tip: generated twice, with their control structure for
Trunnion and unrolled for the follower, so that no evaluator is needed here."""

import random

import lines


class Twice:
    """A text and what it comes to: `text` with variables, `unrolled` with numbers, `places` the line in `text` of each line unrolled."""

    def __init__(self):
        self.text, self.unrolled, self.places = [], [], []

    def both(self, line):
        self.text.append(line)
        self.run(line, len(self.text))

    def run(self, line, place):
        self.unrolled.append(line)
        self.places.append(place)


def number(v):
    return f"{v:.9f}"


class Step:
    """A block whose words are linear in the loop's counter: a + b i; `i` is written as an expression."""

    def __init__(self, rng, machine, code):
        self.code, self.words = code, []
        for axis in "XYZ":
            if rng.random() < 0.6:
                self.words.append((axis, round(rng.uniform(-30, 30), 3), round(rng.uniform(-6, 6), 3)))
        for a in machine.rotaries:
            if rng.random() < 0.5:
                lo, hi = a.limits or (-60.0, 60.0)
                self.words.append((a.letter, round(rng.uniform(max(lo, -40), min(hi, 40)) * 0.5, 3), round(rng.uniform(-2, 2), 3)))
        if not self.words:
            self.words.append(("X", 1.0, 0.5))

    def written(self, i):
        return self.code + " " + " ".join(f"{x}[{a}+{b}*{i}]".replace("+-", "-") for x, a, b in self.words)

    def at(self, i):
        return self.code + " " + " ".join(f"{x}{number(a + b * i)}" for x, a, b in self.words)


def loop(rng, out, dialect, steps, count, label):
    """The steps for i = 0 .. count - 1."""
    variable = f"#{100 + label}"
    linuxcnc = dialect == "linuxcnc"
    kind = rng.choice(["while", "repeat", "if"] if linuxcnc else ["while", "if"])
    out.text.append(f"{variable}=0")
    if kind == "while":
        out.text.append(f"o{label} while [{variable} LT {count}]" if linuxcnc else f"WHILE [{variable} LT {count}] DO1")
    elif kind == "repeat":
        out.text.append(f"o{label} repeat [{count}]")
    elif linuxcnc:
        out.text.append(f"o{label} do")
    else:
        out.text.append(f"N{label}")
    first = len(out.text)
    out.text += [s.written(variable) for s in steps]
    out.text.append(f"{variable}=[{variable}+1]")
    if kind == "while":
        out.text.append(f"o{label} endwhile" if linuxcnc else "END1")
    elif kind == "repeat":
        out.text.append(f"o{label} endrepeat")
    else:
        out.text.append(f"o{label} while [{variable} LT {count}]" if linuxcnc else f"IF [{variable} LT {count}] GOTO {label}")
    for i in range(count):
        for k, s in enumerate(steps):
            out.run(s.at(i), first + 1 + k)


def called(rng, out, dialect, steps, label, tail):
    """The steps in a subprogram with its counter as argument, called some times; `tail` takes texts that stand behind the program."""
    arguments = [rng.randint(0, 5) for _ in range(rng.randint(1, 3))]
    if dialect == "linuxcnc":
        out.text[0:0] = [f"o{label} sub", *[s.written("#1") for s in steps], f"o{label} endsub"]
        out.places = [p and p + len(steps) + 2 for p in out.places]
        for a in arguments:
            out.text.append(f"o{label} call [{a}]")
            for s in steps:
                out.run(s.at(a), None)
        return
    macro = rng.random() < 0.6
    tail += [f"O{label}", *[s.written("#1" if macro else "#500") for s in steps], "M99"]
    for a in arguments:
        if macro:
            out.text.append(f"G65 P{label} A{a}.")
        else:
            out.text += [f"#500={a}", f"M98 P{label}"]
        for s in steps:
            out.run(s.at(a), None)


def case(seed, theme):
    import run

    rng = random.Random(f"{theme}-{seed}")
    dialect = rng.choice(["fanuc-30i", "linuxcnc"])
    machine = run.random_machine(rng, run.control(rng, dialect), askew=0.0)
    tools = {n: round(rng.uniform(0, 150), 2) for n in (1, 2, 3)}
    zero = run.offsets(rng, machine, rotary=False)
    out, tail = Twice(), []
    if dialect == "fanuc-30i":
        out.both("O1")
    for line in lines.program(rng, machine, dialect, 0, {"tcp", "own-length"}):
        if line not in ("%", "O1", "M30", "M2"):
            out.both(line)
    for label in range(rng.randint(1, 4)):
        code = rng.choice(["G1", "G1", "G90 G1", "G91 G1"])
        steps = [Step(rng, machine, code) for _ in range(rng.randint(1, 3))]
        if rng.random() < 0.5:
            loop(rng, out, dialect, steps, rng.randint(1, 5), 70 + label)
        else:
            called(rng, out, dialect, steps, 2000 + label, tail)
        out.both("G90")
        if rng.random() < 0.3:
            out.both(rng.choice(["G55", "G54", "G52 X1.5 Z-2.", "G52 X0. Z0."]))
    out.text += ["M2"] if dialect == "linuxcnc" else ["M30", *tail]
    return machine, dialect, tools, zero, out.text, out


def judge(trunnion, machine, dialect, tools, zero, text, out):
    import run

    findings = run.Findings()
    trunnion.settings(machine, tools, zero)
    body = "\n".join(text) + "\n"
    try:
        rows = trunnion.trace(body, dialect)
        legs = run.legs_of("\n".join(out.unrolled) + "\n", machine, dialect, tools, zero, rows)
        report = trunnion.check(body, dialect)
    except (run.Unread, ValueError):
        return findings
    except run.Broken as broken:
        findings.append(str(broken))
        return findings
    places = [out.places[leg.motion.line - 1] for leg in legs]
    run.compare(legs, rows, report, machine, findings, places)
    return findings
