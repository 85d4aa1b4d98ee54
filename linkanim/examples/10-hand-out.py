"""10  Everything for a lesson in one folder: a linkage for a drawn curve, a figure, an exercise, its key.

curve.csv is a curve as it was drawn; the linkage that follows it is found, rounded to whole millimetres, and
then handed out in four forms.
"""

from pathlib import Path

import linkanim
from linkanim.cli import main

curve = [tuple(map(float, line.split(","))) for line in Path("curve.csv").read_text().split()[1:]]
best, *_ = linkanim.path(curve, rounding=1.0)
print(f"{best.class_name}, {best.rms:.2f} mm off (root mean square), lengths {best.parameters}")


def run(*words):
    """Run a command of linkanim, and stop where it fails."""
    if code := main(words):
        raise SystemExit(code)


folder = Path("lesson")
folder.mkdir(exist_ok=True)
scene = str(folder / "follower.toml")
run("path", "curve.csv", "--count", "1", "--round", "1 mm", "-o", scene)
run("draw", scene, "--names", "--names", "-o", str(folder / "figure.svg"))
run("record", scene, "--size", "640x360", "-o", str(folder / "follower.gif"))
run("explain", scene, "--angle", "60 deg", "--exercise", "-o", str(folder / "exercise.html"))
run("share", scene, "-o", str(folder / "follower.html"))
print("Open", folder / "exercise.html", "and", folder / "follower.html")
