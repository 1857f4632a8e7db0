"""The installed wheel says what the command line says, on all samples. Run by .ci/wheel.sh in a clean environment and an empty folder:

    python check_wheel.py REPOSITORY BINARY
"""

import json
import math
import subprocess
import sys
from pathlib import Path
from typing import Any, Dict, List, Optional

import numpy as np
import trunnion

repository, binary = Path(sys.argv[1]), sys.argv[2]
MACHINES: List[Optional[str]] = [None, "mikron-ucp710", "mill-3axis"]


def command_line(*words: str) -> Any:
    done = subprocess.run([binary, *words], stdin=subprocess.DEVNULL, capture_output=True, check=False)
    assert done.returncode in (0, 1, 2), done.stderr
    return json.loads(done.stdout) if done.returncode != 2 else None


def same_rows(rows: "np.ndarray[Any, Any]", wanted: List[Dict[str, Any]]) -> None:
    assert len(rows) == len(wanted), (len(rows), len(wanted))
    for row, expected in zip(rows, wanted):
        assert list(row.dtype.names) == list(expected)
        for name, value in expected.items():
            got = row[name].item()
            if value is None:
                assert got == "" or math.isnan(got), (name, got)
            else:
                assert got == value, (name, got, value)


def main() -> int:
    own = trunnion.program()
    assert Path(own).is_file() and Path(own).parent == Path(sys.executable).parent, own
    assert Path(trunnion.__file__).with_name("py.typed").is_file()
    # what is no program: settings, machines, dialect tables and the page about them
    programs = sorted(path for path in (repository / "samples").rglob("*") if path.is_file() and path.suffix not in (".toml", ".md"))
    assert len(programs) > 30, len(programs)
    verdicts: Dict[str, int] = {}
    traced = 0
    for path in programs:
        for machine in MACHINES:
            options = ["--machine", machine] if machine else []
            wanted = command_line("check", "--format", "json", *options, str(path))
            report = trunnion.check(path, machine=machine)
            assert report == wanted, path
            verdict = report["files"][0]["verdict"]
            verdicts[verdict] = verdicts.get(verdict, 0) + 1
            if machine is None:
                continue
            trace = command_line("trace", "--format", "json", *options, str(path))
            if trace is None:
                try:
                    trunnion.trace(path, machine=machine)
                    raise AssertionError(f"{path}: traced, but the command line refuses it")
                except trunnion.TrunnionError:
                    continue
            rows = trunnion.trace(path, machine=machine)
            same_rows(rows, trace["rows"])
            traced += len(rows)
    assert set(verdicts) == {"pass", "fail", "unknown"} and traced > 1000, (verdicts, traced)
    print(f"{len(programs)} programs, verdicts {verdicts}, {traced} rows of traces: as the command line")
    return 0


if __name__ == "__main__":
    sys.exit(main())
