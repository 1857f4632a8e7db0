"""The program under test: runs the `trunnion` binary on texts in a folder of its own and reads its tables and reports."""

import csv
import io
import json
import os
import subprocess
import tempfile

ENDINGS = {"fanuc-30i": "nc", "sinumerik-840d": "mpf", "linuxcnc": "ngc", "haas-ngc": "nc", "apt": "apt"}


class Trunnion:
    def __init__(self, binary):
        self.binary = os.path.abspath(binary)
        self.folder = tempfile.mkdtemp(prefix="independent-")
        self.runs = 0

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def call(self, *arguments, quiet=True):
        self.runs += 1
        command = [self.binary, *arguments, *(["-q"] if quiet else [])]
        try:
            done = subprocess.run(command, capture_output=True, text=True, cwd=self.folder, timeout=300)
        except subprocess.TimeoutExpired as slow:
            raise Broken(f"no end after 300 s: {' '.join(arguments)}") from slow
        if done.returncode not in (0, 1, 2) or "panicked" in done.stderr:
            raise Broken(f"exit {done.returncode}: {done.stderr[-400:]}")
        return done

    def settings(self, machine, tools, offsets, extra=""):
        self.write("m.toml", machine.toml())
        lines = [extra] if extra else []
        for number, length in tools.items():
            lines += ["[[tool]]", f"number = {number}", f"length = {length!r}"]
        lines.append("[work_offsets]")
        for name, values in offsets.items():
            lines.append(f"{name} = {{ " + ", ".join(f"{a} = {v!r}" for a, v in values.items()) + " }")
        self.write("trunnion.toml", "\n".join(lines) + "\n")

    def trace(self, text, dialect):
        """One dictionary of strings per motion; None where the program cannot be run at all."""
        name = "p." + ENDINGS[dialect]
        self.write(name, text)
        done = self.call("trace", name, "--machine", "m.toml", "--dialect", dialect)
        if done.returncode == 2:
            raise Broken(f"trace: {done.stderr.strip()}")
        return list(csv.DictReader(io.StringIO(done.stdout)))

    def check(self, text, dialect, *more):
        name = "p." + ENDINGS[dialect]
        self.write(name, text)
        done = self.call("check", name, "--machine", "m.toml", "--dialect", dialect, "--format", "json", *more)
        if done.returncode == 2:
            raise Broken(f"check: {done.stderr.strip()}")
        return json.loads(done.stdout)["files"][0]


class Broken(Exception):
    """The binary did not do its job: a panic, or a refusal of what is right."""
