"""Random machines and programs from a seed: python3 run.py BINARY [--seed N] [--count N] [--theme NAME]."""

import argparse
import random
import shutil
import sys

import certificates
import conversions
import lines
import macros
import tilted
from compare import Findings, compare, number
from follow import Follower, nearest
from machine import random_machine
from reader import Reader, Unread
from trunnion import Broken, Trunnion

THEMES = {
    "tilted": set(),
    "plain": {"tcp"},
    "offsets": {"tcp", "offsets", "shifts", "g91"},
    "lengths": {"tcp", "lengths", "g91", "offsets"},
    "feeds": {"tcp", "feeds", "inch", "g91"},
    "arcs": {"tcp", "arcs", "inch", "feeds"},
    "vectors": {"tcp", "vectors"},
    "all": {"arcs", "tcp", "offsets", "shifts", "lengths", "g91", "inch", "feeds"},
}
OTHERS = {name: (module.judge, module.case) for name, module in (("convert", conversions), ("macros", macros), ("certify", certificates))}
TCP = '{ path = "tip-linear", orientation = "joint", feed = "tip" }'


def control(rng, dialect):
    out = {"units": '"mm"', "family": f'"{dialect}"', "tcp": TCP, "rapid": rng.choice(['"synchronous"', '"dogleg"'])}
    if dialect == "linuxcnc":
        out["tcp_codes"] = '{ on = ["M428"], off = ["M429"] }'
    return out


def offsets(rng, machine, rotary):
    out = {}
    for name in ("G54", "G55", "G56", "G57"):
        out[name] = {a: round(rng.uniform(-30, 30), 3) for a in "XYZ"}
        if rotary and rng.random() < 0.3:
            out[name][rng.choice(machine.rotaries).letter] = round(rng.uniform(-20, 20), 2)
    return out


def case_run(seed, theme):
    rng = random.Random(f"{theme}-{seed}")
    dialect = rng.choice([name for name in lines.WORDS if theme not in ("vectors", "tilted") or name != "linuxcnc"])
    # a length without tool centre point control is added to the word of the tool's axis: plain only where that axis stands along Z
    machine = random_machine(rng, control(rng, dialect), askew=rng.choice([0.0, 0.5]) if theme == "plain" else 0.0)
    if theme == "vectors":
        machine.control["tcp"] = TCP.replace("joint", rng.choice(["joint", "great-circle"]))
        machine.control["branch"] = '{ rule = "generic" }'
    tools = {n: round(rng.uniform(0, 150), 2) for n in (1, 2, 3)}
    zero = offsets(rng, machine, rotary=theme in ("offsets", "all") and rng.random() < 0.5)
    if theme == "tilted":
        machine.control["branch"] = '{ rule = "generic" }'
        return machine, dialect, tools, zero, tilted.program(rng, machine, dialect, lines.rotary_ranges(machine), lines.WORDS[dialect])
    text = lines.program(rng, machine, dialect, rng.randint(4, 14), THEMES[theme])
    return machine, dialect, tools, zero, text


def legs_of(text, machine, dialect, tools, zero, rows):
    """Which of the postures for a vector the control takes is not judged here: the one is taken that the table comes nearest to."""
    legs = []

    def posture(u, start, motion):
        row = rows[len(legs)] if len(legs) < len(rows) else {}
        told = [number(row, "joint_" + a.letter.lower()) for a in machine.rotaries]
        # a row without a tip tells where the axes stood
        return None if None in told or number(row, "x_mm") is None and motion.swivel else nearest(machine, u, told)

    follower = Follower(machine, posture, "great-circle" in machine.control["tcp"])
    reader = Reader(dialect, tools, zero, follower.position)
    for motion in reader.run(text):
        legs.append(follower.step(motion))
    return legs


def judge_run(trunnion, machine, dialect, tools, zero, text):
    findings = Findings()
    body = "\n".join(text) + "\n"
    trunnion.settings(machine, tools, zero)
    try:
        rows = trunnion.trace(body, dialect)
        legs = legs_of(body, machine, dialect, tools, zero, rows)
        report = trunnion.check(body, dialect)
    except (Unread, ValueError):
        return findings
    except Broken as broken:
        findings.append(str(broken))
        return findings
    compare(legs, rows, report, machine, findings)
    return findings


def shrink(judge, trunnion, machine, dialect, tools, zero, text, *more):
    """Leaves out lines as long as something still differs."""
    step = max(1, len(text) // 2)
    while step:
        at = 0
        while at < len(text):
            shorter = text[:at] + text[at + step:]
            if shorter and judge(trunnion, machine, dialect, tools, zero, shorter, *more):
                text = shorter
            else:
                at += step
        step //= 2
    return text


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("binary")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--theme", action="append", choices=[*THEMES, *OTHERS])
    parser.add_argument("--stop", type=int, default=3, help="stop after so many seeds that differ")
    options = parser.parse_args()
    trunnion = Trunnion(options.binary)
    bad = motions = unknown = 0
    reasons = {}
    for theme in options.theme or [*THEMES, *OTHERS]:
        judge, case = OTHERS.get(theme, (judge_run, case_run))
        for seed in range(options.seed, options.seed + options.count):
            parts = case(seed, theme)
            found = judge(trunnion, *parts)
            motions, unknown = motions + found.motions, unknown + found.unknown
            for reason, count in found.reasons.items():
                reasons[reason] = reasons.get(reason, 0) + (count if isinstance(count, int) else len(count))
            if not found:
                continue
            bad += 1
            text = parts[4] if theme in ("macros", "certify") else shrink(judge, trunnion, *parts)
            found = judge(trunnion, *parts[:4], text, *parts[5:])
            print(f"theme {theme} seed {seed} {parts[1]}", *[x for x in parts[7:]])
            print("\n".join("  " + x for x in found[:6]))
            print("\n".join(f"    {i + 1}: {line}" for i, line in enumerate(text)))
            print("    tools", parts[2], "offsets", parts[3])
            print(parts[0].toml() if options.stop == 1 else "    " + " ".join(parts[0].letters))
            if bad >= options.stop:
                break
        if bad >= options.stop:
            break
    for reason, count in sorted(reasons.items(), key=lambda item: -item[1]):
        print(f"  unknown: {count} {reason}")
    print(f"{bad} programs differ; motions and conversions unknown to trunnion alone: {unknown}; compared: {motions - unknown}")
    shutil.rmtree(trunnion.folder)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
