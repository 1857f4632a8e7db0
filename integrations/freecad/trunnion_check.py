"""Checks a program that FreeCAD has just posted, with Trunnion.

From a shell: python3 trunnion_check.py PROGRAM [options of `trunnion check`]
In FreeCAD: copy this file into the macro folder; after "Post Process" run the macro, or call
    import trunnion_check; trunnion_check.check("/path/of/program.nc")
from the end of your own post processor. Nothing of FreeCAD is needed for the check itself.
"""

import shutil
import subprocess
import sys


def check(path, *options):
    """Check one program. Returns (status, text): 0 nothing found, 1 something found, 2 not checked."""
    program = shutil.which("trunnion")
    if program is None:
        return 2, "trunnion is not on the PATH: cargo install --path . in its folder"
    done = subprocess.run(
        [program, "check", "--format", "short", *options, "--", str(path)],
        capture_output=True,
        text=True,
        errors="replace",
        check=False,
    )
    return done.returncode, done.stdout + done.stderr


def show(status, text):
    """Show the result in FreeCAD's report view, or print it."""
    try:
        import FreeCAD
    except ImportError:
        print(text, end="")
        return
    write = FreeCAD.Console.PrintMessage if status == 0 else FreeCAD.Console.PrintError
    write(text)


def macro():
    """Ask for the program and check it."""
    from PySide import QtGui

    path, _ = QtGui.QFileDialog.getOpenFileName(None, "Program to check", "", "NC programs (*.nc *.ngc *.mpf *.tap *.gcode);;All files (*)")
    if path:
        show(*check(path))


if __name__ == "__main__":
    # inside FreeCAD the arguments are its own, for example the document that it was started with
    if len(sys.argv) > 1 and "FreeCAD" not in sys.modules:
        result = check(sys.argv[1], *sys.argv[2:])
        show(*result)
        sys.exit(result[0])
    macro()
