#!/usr/bin/env python3
"""Parses every program of a folder (default: ../shared/data beside the repository) with the tree-sitter grammars, and reports those with
ERROR or MISSING nodes.

    python3 grammar/tree-sitter-programs.py [FOLDER]

Files listed in tree-sitter-exceptions.tsv must have errors, all others none. TREE_SITTER names the command line of tree-sitter.
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)
FOUND = re.compile(r"^(?P<file>/.*?)\s*\tParse: .*\((?P<kind>ERROR|MISSING) ?.*\[(?P<line>\d+), (?P<column>\d+)\] - ")


def extensions(language):
    """Those of a language; a test of the extension compares them with the dialect tables."""
    with open(os.path.join(ROOT, "vscode-extension", "package.json"), encoding="utf-8") as manifest:
        languages = json.load(manifest)["contributes"]["languages"]
    return tuple(next(one["extensions"] for one in languages if one["id"] == language))


def programs(folder, endings):
    for place, folders, names in os.walk(folder):
        folders.sort()
        for name in sorted(names):
            if name.lower().endswith(endings):
                yield os.path.join(place, name)


def exceptions():
    with open(os.path.join(HERE, "tree-sitter-exceptions.tsv"), encoding="utf-8") as rows:
        return dict(row.rstrip("\n").split("\t") for row in rows if row.strip() and not row.startswith("#"))


def parse(command, grammar, files):
    """The files with errors, and where their first one is."""
    with tempfile.NamedTemporaryFile("w", suffix=".paths", encoding="utf-8") as paths:
        paths.write("\n".join(files) + "\n")
        paths.flush()
        run = subprocess.run([command, "parse", "--quiet", "--paths", paths.name], cwd=grammar, capture_output=True, text=True, errors="replace")
    matches = [match for match in map(FOUND.match, run.stdout.splitlines()) if match]
    # an error in a file makes the command fail; a failure that names no file is one of the command itself
    if run.returncode != 0 and not matches:
        sys.exit(f"tree-sitter parse: {run.stdout}{run.stderr}")
    return {match["file"]: f"{int(match['line']) + 1}:{int(match['column']) + 1}: {match['kind']}" for match in matches}


def main():
    command = os.environ.get("TREE_SITTER", "tree-sitter")
    folder = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "..", "shared", "data"))
    if not shutil.which(command):
        print(f"skipped: there is no {command} (cargo install tree-sitter-cli --locked --version 0.27.1)")
        return 0
    if not os.path.isdir(folder):
        print(f"skipped: {folder} is absent")
        return 0
    known = exceptions()
    wrong, all_files = {}, []
    for language in ("gcode", "klartext"):
        grammar = os.path.join(HERE, f"tree-sitter-{language}")
        subprocess.run([command, "generate"], cwd=grammar, check=True)
        files = list(programs(folder, extensions(language)))
        if not files:
            print(f"not ok - there is no program of {language} in {folder}")
            return 1
        found = {os.path.relpath(file, folder): place for file, place in parse(command, grammar, files).items()}
        print(f"{language}: {len(files)} programs, {len(found)} with errors")
        wrong.update(found)
        all_files += [os.path.relpath(file, folder) for file in files]
    unexpected = sorted(set(wrong) - set(known))
    healed = sorted((set(known) & set(all_files)) - set(wrong))
    for name in unexpected:
        print(f"not ok - {name}:{wrong[name]}")
    for name in healed:
        print(f"not ok - {name} is in tree-sitter-exceptions.tsv ({known[name]}) and has no error: remove it there")
    failed = len(unexpected) + len(healed)
    print(f"{len(all_files) - failed} passed, {failed} failed")
    return 1 if failed else 0


sys.exit(main())
