#!/usr/bin/env python3
"""Parses every ISO program of a folder (default: ../shared/data beside the repository) and reports those with ERROR or MISSING nodes.

    python3 grammar/tree-sitter-gcode/test/programs.py [FOLDER]

Files listed in exceptions.tsv must have errors, all others none. TREE_SITTER names the command line of tree-sitter; the parser must have
been made by `tree-sitter generate`, which this script runs.
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
GRAMMAR = os.path.dirname(HERE)
ROOT = os.path.dirname(os.path.dirname(GRAMMAR))
FOUND = re.compile(r"^(?P<file>/.*?)\s*\tParse: .*\((?P<kind>ERROR|MISSING) ?.*\[(?P<line>\d+), (?P<column>\d+)\] - ")


def extensions():
    """Those of the language G-code; a test of the extension compares them with the dialect tables."""
    with open(os.path.join(ROOT, "vscode-extension", "package.json"), encoding="utf-8") as manifest:
        languages = json.load(manifest)["contributes"]["languages"]
    return tuple(next(language["extensions"] for language in languages if language["id"] == "gcode"))


def programs(folder, endings):
    for place, folders, names in os.walk(folder):
        folders.sort()
        for name in sorted(names):
            if name.lower().endswith(endings):
                yield os.path.join(place, name)


def exceptions():
    with open(os.path.join(HERE, "exceptions.tsv"), encoding="utf-8") as rows:
        pairs = (row.rstrip("\n").split("\t") for row in rows if row.strip() and not row.startswith("#"))
        return {name: reason for name, reason in pairs}


def main():
    command = os.environ.get("TREE_SITTER", "tree-sitter")
    folder = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "..", "shared", "data"))
    if not shutil.which(command):
        print(f"skipped: there is no {command} (cargo install tree-sitter-cli --locked --version 0.27.1)")
        return 0
    if not os.path.isdir(folder):
        print(f"skipped: {folder} is absent")
        return 0
    subprocess.run([command, "generate"], cwd=GRAMMAR, check=True)
    all_files = list(programs(folder, extensions()))
    with tempfile.NamedTemporaryFile("w", suffix=".paths", encoding="utf-8") as paths:
        paths.write("\n".join(all_files) + "\n")
        paths.flush()
        run = subprocess.run([command, "parse", "--quiet", "--paths", paths.name], cwd=GRAMMAR, capture_output=True, text=True, errors="replace")
    wrong = {}
    for line in run.stdout.splitlines():
        if match := FOUND.match(line):
            wrong[os.path.relpath(match["file"], folder)] = f"{int(match['line']) + 1}:{int(match['column']) + 1}: {match['kind']}"
    # every file with an error makes the command fail; a failure that names no file is one of the command itself
    if run.returncode != 0 and not wrong:
        print(run.stdout, run.stderr)
        return 1
    known = exceptions()
    present = {os.path.relpath(file, folder) for file in all_files}
    unexpected = sorted(set(wrong) - set(known))
    healed = sorted((set(known) & present) - set(wrong))
    for name in unexpected:
        print(f"not ok - {name}:{wrong[name]}")
    for name in healed:
        print(f"not ok - {name} is in exceptions.tsv ({known[name]}) and has no error: remove it there")
    print(f"{len(all_files)} programs, {len(set(wrong) & set(known))} known exceptions")
    print(f"{len(all_files) - len(unexpected) - len(healed)} passed, {len(unexpected) + len(healed)} failed")
    return 1 if unexpected or healed or not all_files else 0


sys.exit(main())
