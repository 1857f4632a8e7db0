"""Checks NC programs against the machine that will run them.

    import trunnion
    report = trunnion.check("part.nc", machine="mill-3axis")
    report["files"][0]["verdict"]          # "pass", "fail" or "unknown"
    rows = trunnion.trace("part.mpf", machine="mikron-ucp710")
    numpy.nanmax(rows["tip_deviation_mm"])   # a NumPy structured array, one row per motion; unknown is nan

The functions run the program `trunnion` that came with this package, or the one on the PATH.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

__all__ = ["TrunnionError", "check", "program", "trace"]

StrPath = Union[str, "os.PathLike[str]"]

#: Columns of `trace` that hold text.
_TEXT = {"block", "motion", "limiting_axis", "open_posture", "limited_by"}


class TrunnionError(RuntimeError):
    """The job could not be done; the message is that of the program."""


def program() -> str:
    """The path of the program `trunnion`.

    Raises TrunnionError if there is none.
    """
    name = "trunnion.exe" if sys.platform == "win32" else "trunnion"
    own = Path(sysconfig.get_path("scripts")) / name
    found = str(own) if own.is_file() else shutil.which(name)
    if found is None:
        raise TrunnionError("trunnion is neither beside this Python nor on the PATH")
    return found


def _run(arguments: Sequence[str]) -> "subprocess.CompletedProcess[bytes]":
    done = subprocess.run([program(), *arguments], stdin=subprocess.DEVNULL, capture_output=True, check=False)
    if done.returncode not in (0, 1):
        raise TrunnionError(done.stderr.decode("utf-8", "replace").strip())
    return done


def _options(machine: Optional[str], dialect: Optional[str], options: Sequence[str]) -> List[str]:
    words: List[str] = []
    if machine is not None:
        words += ["--machine", machine]
    if dialect is not None:
        words += ["--dialect", dialect]
    return words + list(options)


def check(
    *paths: StrPath, machine: Optional[str] = None, dialect: Optional[str] = None, options: Sequence[str] = ()
) -> Dict[str, Any]:
    """The document of `trunnion check --format json` (`trunnion schema check`).

    paths: files and folders. options: more options of the command, for example ["--assume", "work-offset"].
    Raises TrunnionError if a file could not be checked.
    """
    words = ["check", "--format", "json", *_options(machine, dialect, options), "--"]
    document: Dict[str, Any] = json.loads(_run(words + [os.fspath(path) for path in paths]).stdout)
    return document


def trace(
    path: StrPath, *, machine: Optional[str] = None, dialect: Optional[str] = None, options: Sequence[str] = ()
) -> npt.NDArray[np.void]:
    """What the machine does, one row per motion, as a structured array.

    Columns as `trunnion trace` names them, with their units: line (int), block and motion (text), tcp (bool), x_mm ..., joint_*
    (float; not a number where a value has no meaning).
    Raises TrunnionError if the program cannot be read or no machine is named.
    """
    words = ["trace", "--format", "json", *_options(machine, dialect, options), "--", os.fspath(path)]
    rows: List[Dict[str, Any]] = json.loads(_run(words).stdout)["rows"]
    names = list(rows[0]) if rows else ["line", "block", "motion", "tcp"]
    kinds = {"line": np.dtype("i8"), "tcp": np.dtype("?")}
    columns = []
    for name in names:
        if name in _TEXT:
            longest = max([len(row[name] or "") for row in rows], default=1)
            columns.append((name, np.dtype(f"U{max(longest, 1)}")))
        else:
            columns.append((name, kinds.get(name, np.dtype("f8"))))
    out = np.zeros(len(rows), dtype=columns)
    for name, kind in columns:
        none: Any = "" if kind.kind == "U" else float("nan")
        out[name] = [none if row[name] is None else row[name] for row in rows]
    return out
