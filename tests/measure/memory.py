"""The most memory that commands and a window take: of each scene, and of the largest that is allowed.

Some ten minutes of processor time; of the scenes alone that are named, less.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from statistics import median

from linkanim import child
from linkanim.bench.result import this_machine
from linkanim.bounds import MOST_NAMES
from linkanim.errors import WorkFailed
from linkanim.scenes import load, names

COMMANDS = {
    "solve": ("solve", "{scene}", "--sweep", "0:360:1", "--phase", "--json"),
    "draw": ("draw", "{scene}", "-o", "out.svg", "--names", "--names"),
    "chart": ("chart", "{scene}", "--quantity", "{joint}.velocity", "-o", "out.png"),
    "record": ("record", "{scene}", "-o", "out.gif", "--size", "1280x720", "--seconds", "1"),
    "report": ("report", "{scene}", "-o", "out"),
    "share": ("share", "{scene}", "-o", "out.html"),
}
"""One of each kind, with what makes it large; of a recording a second, for more frames take no more.

Its encoder and what else draws are left out.
"""
WINDOW = """
import sys
from linkanim.picture.look import Look
from linkanim.ui import screen as display
from linkanim.player.actions import advance
from linkanim.ui.screen import Screen
from linkanim.player.state import begin
from linkanim.scenes import load

state = begin(load(sys.argv[1]), look=Look(names=2, vectors=frozenset("va")))
with display.opened((1280, 720)):
    screen = Screen(state)
    for _ in range(60):
        screen.show(state)
        state = advance(state)
"""
"""A second of a window with its names, dimensions and arrows."""


def largest(folder: Path) -> Path:
    """Return a file of as many joints as are allowed: four-bars in series, each rocker the next crank."""
    dyads = MOST_NAMES - 1
    pins = [f"G{n} = [{100 * n}, 0]" for n in range(1, dyads)]
    joints = ["[joints.B0]", 'crank = "O"', "length = 30"]
    for n in range(1, dyads):
        coupler = 90 if n == 1 else 100
        joints += [f"[joints.B{n}]", f'from = ["B{n - 1}", "G{n}"]']
        joints += [f"length = [{coupler}, 80]", 'side = "left"']
    file = folder / "largest.toml"
    file.write_text("\n".join(['length_unit = "mm"', "[ground]", "O = [0, 0]", *pins, *joints]))
    return file


def rows(folder: Path, scenes: Sequence[str]) -> Iterator[tuple[str, ...]]:
    """Yield a scene's name and what each command, then its window, takes at most, in MB."""
    for scene in (*scenes, str(largest(folder))):
        joint = next(joint.name for joint in load(scene).linkage.joints if not joint.fixed)
        filled = ([part.format(scene=scene, joint=joint) for part in words] for words in COMMANDS.values())
        commands = [child.module("linkanim", *words) for words in filled]
        found = [_peak(command, folder) for command in (*commands, [sys.executable, "-c", WINDOW, scene])]
        yield (Path(scene).stem, *(f"{peak:.0f}" for peak in found))


def _peak(command: list[str], folder: Path) -> float:
    """Return the most memory (MB) that a process of ours took, what it started left out."""
    env = {**child.env(), "SDL_VIDEODRIVER": "dummy"}
    with tempfile.TemporaryFile() as said:
        process = subprocess.Popen(command, cwd=folder, env=env, stdout=subprocess.DEVNULL, stderr=said)
        _, code, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(code)
        if code:
            said.seek(0)
            raise WorkFailed(f"{' '.join(command[3:])}: {said.read().decode(errors='replace').strip()}")
    return used.ru_maxrss / 1024.0


def main() -> None:
    """Print a row for each scene as it is found, then each column's median, and its most with the scene."""
    print(this_machine().line)
    print(_row(("MB at most", *COMMANDS, "window")), flush=True)
    found = []
    with tempfile.TemporaryDirectory() as room:
        for row in rows(Path(room), sys.argv[1:] or names()):
            found.append(row)
            print(_row(row), flush=True)
    columns = [[(float(row[n]), row[0]) for row in found] for n in range(1, len(COMMANDS) + 2)]
    print(_row(("median", *(f"{median(peak for peak, _ in column):.0f}" for column in columns))))
    for command, column in zip((*COMMANDS, "window"), columns, strict=True):
        peak, scene = max(column)
        print(f"{command}: at most {peak:.0f} MB, of {scene}")


def _row(cells: tuple[str, ...]) -> str:
    """Return a line of the table."""
    return f"{cells[0]:<24}" + "".join(f"{cell:>8}" for cell in cells[1:])


if __name__ == "__main__":
    main()
