#!/usr/bin/python3
"""Runs programs through LinuxCNC's own trajectory planner and writes how long each block takes, in servo cycles.

    run.py PROGRAM.ngc... -o FOLDER [--modes "G61.1,G61,G64 P0.05"] [--axis XYZ] [--samples] [--velocity V,V,V] [--acceleration A,A,A]

LinuxCNC (Debian: linuxcnc-uspace) runs without a display and without a real-time kernel: a small configuration, this file as its DISPLAY, and
HAL's sampler in the servo thread. Motion is held back until the whole program is queued, and times are counted in servo cycles, so the speed of
the computer does not count. LinuxCNC refuses to run as root, so a root user becomes "nobody" first.

Each program runs once for each mode of path control, which takes the place of @MODE@ in it. For each program FOLDER gets NAME.tsv: a line
number and the cycles of that line in each mode; with --samples also NAME-N.samples of the N-th mode: cycle, line, speed (mm/s).
Exit status: 0 done, 2 it could not be done, 77 LinuxCNC is not installed.
"""
import argparse
import fcntl
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

PYTHON = "/usr/bin/python3"
# a program this long is not waited for any longer, s
PATIENCE = 90.0
# a start that hangs, as seen on a busy computer, is repeated
ATTEMPTS = 3

INI = """[EMC]
VERSION = 1.1
MACHINE = witness
[DISPLAY]
DISPLAY = {display}
PROGRAM_PREFIX = {folder}
[RS274NGC]
PARAMETER_FILE = {folder}/parameters
[EMCMOT]
EMCMOT = motmod
COMM_TIMEOUT = 10.0
SERVO_PERIOD = 1000000
[TASK]
TASK = milltask
CYCLE_TIME = 0.001
[HAL]
HALFILE = {folder}/witness.hal
[TRAJ]
COORDINATES = {letters}
LINEAR_UNITS = mm
ANGULAR_UNITS = degree
DEFAULT_LINEAR_VELOCITY = 10
MAX_LINEAR_VELOCITY = 1000
DEFAULT_LINEAR_ACCELERATION = 20000
MAX_LINEAR_ACCELERATION = 20000
NO_FORCE_HOMING = 1
[EMCIO]
EMCIO = io
CYCLE_TIME = 0.1
TOOL_TABLE = {folder}/tools.tbl
[KINS]
KINEMATICS = trivkins coordinates={coordinates}
JOINTS = {count}
"""

AXIS = """[AXIS_{letter}]
MIN_LIMIT = -10000
MAX_LIMIT = 10000
MAX_VELOCITY = {velocity}
MAX_ACCELERATION = {acceleration}
[JOINT_{joint}]
TYPE = {kind}
MIN_LIMIT = -10000
MAX_LIMIT = 10000
MAX_VELOCITY = {velocity}
MAX_ACCELERATION = {acceleration}
FERROR = 1000
MIN_FERROR = 1000
HOME_SEQUENCE = 0
"""

HAL = """loadrt [KINS]KINEMATICS
loadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS
loadrt sampler depth=60000 cfg=sf
addf motion-command-handler servo-thread
addf motion-controller servo-thread
addf sampler.0 servo-thread
net estop iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in
net prepare iocontrol.0.tool-prepare => iocontrol.0.tool-prepared
net change iocontrol.0.tool-change => iocontrol.0.tool-changed
net line motion.program-line => sampler.0.pin.0
net speed motion.current-vel => sampler.0.pin.1
setp motion.feed-inhibit 1
setp sampler.0.enable 0
"""


def configure(folder, letters, velocity, acceleration):
    """Writes the configuration into the folder."""
    text = INI.format(
        display=os.path.join(folder, "run.py"),
        folder=folder,
        letters=" ".join(letters),
        coordinates=letters.lower(),
        count=len(letters),
    )
    hal = HAL
    for joint, letter in enumerate(letters):
        kind = "ANGULAR" if letter in "ABC" else "LINEAR"
        text += AXIS.format(
            letter=letter, joint=joint, kind=kind, velocity=velocity[joint], acceleration=acceleration[joint]
        )
        hal += f"net joint-{joint} joint.{joint}.motor-pos-cmd => joint.{joint}.motor-pos-fb\n"
    for name, content in (("witness.ini", text), ("witness.hal", hal), ("parameters", ""), ("tools.tbl", "")):
        with open(os.path.join(folder, name), "w", encoding="ascii") as file:
            file.write(content)
    # the script must be readable and executable for whoever LinuxCNC runs as
    shutil.copy(os.path.abspath(__file__), os.path.join(folder, "run.py"))
    os.chmod(os.path.join(folder, "run.py"), 0o755)


def launch(options):
    """Starts LinuxCNC, which starts this file again as its display."""
    if not shutil.which("linuxcnc") or not os.path.exists(PYTHON):
        print("LinuxCNC is not installed (Debian: linuxcnc-uspace)", file=sys.stderr)
        return 77
    os.makedirs(options.output, exist_ok=True)
    letters = options.axis
    # held until this process ends
    alone()
    with tempfile.TemporaryDirectory(prefix="trunnion-linuxcnc-") as folder:
        configure(folder, letters, options.velocity.split(","), options.acceleration.split(","))
        modes = options.modes.split(",")
        names = []
        for program in options.programs:
            with open(program, encoding="utf-8") as file:
                text = file.read()
            for mode in modes:
                name = os.path.join(folder, f"{len(names):03}.ngc")
                with open(name, "w", encoding="utf-8") as file:
                    file.write(text.replace("@MODE@", mode))
                names.append(name)
        environment = {
            **os.environ,
            "HOME": folder,
            "RTAPI_FIFO_PATH": os.path.join(folder, "fifo"),
            "WITNESS": folder,
            "PATH": "/usr/bin:/bin",
        }
        for unwanted in ("DISPLAY", "PYTHONPATH", "VIRTUAL_ENV"):
            environment.pop(unwanted, None)
        command = ["linuxcnc", "-r", os.path.join(folder, "witness.ini")]
        if os.geteuid() == 0:
            for root, _, files in os.walk(folder):
                for path in [root, *(os.path.join(root, name) for name in files)]:
                    os.chown(path, 65534, 65534)
            # other programs of LinuxCNC may hold its shared memory: this run gets its own
            command = ["unshare", "--ipc", "setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", *command]
        with open(os.path.join(folder, "log"), "wb") as log:
            for _ in range(ATTEMPTS):
                left = [name for name in names if not os.path.exists(name + ".tsv")]
                if not left:
                    break
                with open(os.path.join(folder, "jobs"), "w", encoding="utf-8") as file:
                    file.write("\n".join(left) + "\n")
                finish(
                    subprocess.Popen(
                        command,
                        env=environment,
                        cwd=folder,
                        stdin=subprocess.DEVNULL,
                        stdout=log,
                        stderr=log,
                        start_new_session=True,
                    ),
                    60.0 + PATIENCE * len(left),
                )
        good = True
        for number, program in enumerate(options.programs):
            own = names[number * len(modes) : (number + 1) * len(modes)]
            stem = os.path.join(options.output, os.path.splitext(os.path.basename(program))[0])
            if all(os.path.exists(name + ".tsv") for name in own):
                table(modes, [name + ".tsv" for name in own], stem + ".tsv")
            else:
                good = False
                print(f"{program}: LinuxCNC gave no times", file=sys.stderr)
            if options.samples:
                for index, name in enumerate(own):
                    shutil.copy(name + ".samples", f"{stem}-{index}.samples")
        if not good:
            with open(os.path.join(folder, "log"), encoding="utf-8", errors="replace") as log:
                sys.stderr.write(log.read()[-6000:])
        return 0 if good else 2


def finish(process, seconds):
    """Waits for the end of LinuxCNC; after that time it is asked to clean up, and then stopped with all that it started."""
    for limit, stop in ((seconds, signal.SIGTERM), (20.0, signal.SIGKILL)):
        try:
            process.wait(timeout=limit)
            return
        except subprocess.TimeoutExpired:
            print("LinuxCNC did not end", file=sys.stderr)
            os.killpg(process.pid, stop)
    process.wait()


def alone():
    """One LinuxCNC at a time: it has one lock for the whole computer."""
    name = os.path.join(tempfile.gettempdir(), "trunnion-linuxcnc.lock")
    lock = os.open(name, os.O_RDONLY | os.O_CREAT, 0o666)
    fcntl.flock(lock, fcntl.LOCK_EX)
    return lock


def table(modes, parts, out):
    """One table of all modes of a program."""
    columns = []
    for part in parts:
        cycles = {}
        with open(part, encoding="ascii") as file:
            for row in file:
                line, count = map(int, row.split())
                cycles[line] = cycles.get(line, 0) + count
        columns.append(cycles)
    with open(out, "w", encoding="ascii") as file:
        file.write("\t".join(["line", *modes]) + "\n")
        for line in sorted(set().union(*columns)):
            file.write("\t".join(str(value) for value in [line, *(column.get(line, 0) for column in columns)]) + "\n")


def wait(condition, what, seconds=60.0):
    """Until the condition holds."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise RuntimeError(f"waited {seconds} s until {what}")
        time.sleep(0.02)


def pin(name, value):
    subprocess.run(["halcmd", "setp", name, str(value)], check=True)


def queued(status):
    """Until no more segments come."""
    last, same = -1, 0
    end = time.monotonic() + 60.0
    while same < 25:
        status.poll()
        same = same + 1 if status.queue == last and status.queue > 0 else 0
        last = status.queue
        if time.monotonic() > end:
            raise RuntimeError("the program is not queued")
        time.sleep(0.02)


def display(folder):
    """Inside LinuxCNC: runs the programs one after the other."""
    import linuxcnc

    command, status, errors = linuxcnc.command(), linuxcnc.stat(), linuxcnc.error_channel()

    def poll():
        status.poll()
        message = errors.poll()
        if message:
            print("LinuxCNC says:", message[1], flush=True)
            # 1, 11: operator and NML errors
            if message[0] in (linuxcnc.OPERATOR_ERROR, linuxcnc.NML_ERROR):
                raise RuntimeError(message[1])
        return status

    with open(os.path.join(folder, "jobs"), encoding="utf-8") as file:
        jobs = file.read().split()
    for job in jobs:
        command.state(linuxcnc.STATE_ESTOP_RESET)
        command.wait_complete()
        command.state(linuxcnc.STATE_ON)
        command.wait_complete()
        wait(lambda: poll().task_state == linuxcnc.STATE_ON, "the machine is on")
        command.mode(linuxcnc.MODE_AUTO)
        command.wait_complete()
        pin("motion.feed-inhibit", 1)
        command.program_open(job)
        command.wait_complete()
        samples = job + ".samples"
        with open(samples, "wb") as out:
            sampler = subprocess.Popen(["halsampler", "-t"], stdout=out)
            command.auto(linuxcnc.AUTO_RUN, 0)
            queued(status)
            pin("sampler.0.enable", 1)
            pin("motion.feed-inhibit", 0)
            wait(
                lambda: poll().interp_state == linuxcnc.INTERP_IDLE and status.inpos and status.queue == 0,
                "the program is done",
                PATIENCE,
            )
            pin("sampler.0.enable", 0)
            # what the sampler still holds
            time.sleep(0.3)
            sampler.terminate()
            sampler.wait()
        condense(samples, job + ".tsv")


def condense(samples, rows):
    """From samples to one row per block, in the order of the run."""
    blocks, before = [], None
    with open(samples, encoding="ascii") as file:
        for text in file:
            fields = text.split()
            # halsampler also says "overrun" where it begins with a number that is not 0: the numbers tell
            if len(fields) != 3:
                continue
            number, line, speed = int(fields[0]), int(fields[1]), float(fields[2])
            if before is not None and number != before + 1:
                raise RuntimeError(f"cycles {before} to {number} are lost")
            before = number
            if not blocks or blocks[-1][0] != line:
                blocks.append([line, 0, False])
            block = blocks[-1]
            # while motion is held back, nothing moves
            block[2] |= speed > 0.0
            if block[2]:
                block[1] += 1
    with open(rows + ".part", "w", encoding="ascii") as file:
        for line, cycles, moves in blocks:
            if moves and line > 0:
                file.write(f"{line}\t{cycles}\n")
    os.rename(rows + ".part", rows)


def main():
    if "WITNESS" in os.environ:
        try:
            display(os.environ["WITNESS"])
        except Exception as problem:  # what LinuxCNC raises is of many kinds
            print(f"{type(problem).__name__}: {problem}", flush=True)
            return 2
        return 0
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", nargs="+")
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("--modes", default="G61.1,G61,G64 P0.01,G64 P0.05,G64 P0.2")
    parser.add_argument("--samples", action="store_true", help="also write the samples")
    parser.add_argument("--axis", default="XYZ")
    parser.add_argument("--velocity", default="200,200,100")
    parser.add_argument("--acceleration", default="1000,1000,600")
    return launch(parser.parse_args())


if __name__ == "__main__":
    sys.exit(main())
