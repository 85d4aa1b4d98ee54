"""Everything that is made of a scene file that `check` calls good, each under limits of time and memory."""

from __future__ import annotations

import csv
import json
import shutil
from collections.abc import Callable, Mapping
from contextlib import chdir, redirect_stderr, redirect_stdout
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from random import Random
from unicodedata import category
from xml.etree import ElementTree

import pygame
import tomli_w
from typed_linkages import Document

from linkanim.cli import main
from linkanim.errors import BadInput
from linkanim.player.state.action import Action
from linkanim.player.state.state import begin
from linkanim.player.tape.tape import Tape
from linkanim.player.tape.tape_file import write
from linkanim.player.window import display
from linkanim.player.window.window import Window
from linkanim.scenes import load
from linkanim.scenes.reading.read import scene_from

SECONDS, MEGABYTES = 10.0, 400
"""What each output of a scene may take: processor time, and memory beside what was there before."""
KEYS = "abcdehiklnoprtv0123456789+-=.?sg"
MODS = (0, 0, 0, pygame.KMOD_LSHIFT, pygame.KMOD_LCTRL)
MOVES = (pygame.K_LEFT, pygame.K_RIGHT, pygame.K_UP, pygame.K_DOWN, pygame.K_RETURN, pygame.K_TAB)
FAR = (-1e100, -1e9, 0.0, 1.0, 1e9, 1e16, 1e100)
EVERYTHING = ("--names", "--names", "--vectors", "v,a", "--polygons")
WAYS: tuple[tuple[str, ...], ...] = (
    (),
    ("--names",),
    EVERYTHING,
    ("--poses", "3", "--vectors", "v,a"),
    ("--polygons", "--instant-centres"),
    ("--theme", "dark", "--transparent"),
)


class Failure(Exception):
    """An output that could not be made, with what was said."""


@dataclass(frozen=True)
class Case:
    """A good scene file in a folder of its own, and the chances of what is random in its outputs."""

    path: Path
    rng: Random
    ways: tuple[tuple[str, ...], ...] = WAYS

    @property
    def folder(self) -> Path:
        return self.path.parent

    def command(self, *words: str) -> str:
        """Run a command, and return what it printed; Failure where its exit code is not 0."""
        printed, problems = StringIO(), StringIO()
        with redirect_stdout(printed), redirect_stderr(problems):
            code = main(words)
        if code:
            raise Failure(f"{' '.join(words)}: {code}: {problems.getvalue()}")
        for line in (*printed.getvalue().splitlines(), *problems.getvalue().splitlines()):
            if set(map(category, line)) & {"Cc", "Cs"}:
                raise Failure(f"{' '.join(words)}: printed {line!r}")
        return printed.getvalue()

    def clear(self) -> None:
        """Take the folder away with all that was made."""
        shutil.rmtree(self.folder)

    def made(self, name: str) -> Path:
        """Return the path of a file that is to be made."""
        return self.folder / name


def is_good(document: Document) -> bool:
    """Tell whether the reader takes a document."""
    try:
        scene_from(document, name="my", where="my.toml")
    except BadInput:
        return False
    return True


def written(document: Document, folder: Path, rng: Random) -> Case:
    """Write a document as a scene file into a new folder."""
    folder.mkdir()
    path = folder / "my.toml"
    path.write_text(tomli_w.dumps(document), encoding="utf-8")
    return Case(path, rng)


def checked(case: Case) -> None:
    case.command("check", str(case.path))


def solved(case: Case) -> None:
    phase = f"{case.rng.uniform(-9, 9)} rad"
    json.loads(case.command("solve", str(case.path), "--phase", phase, "--json"))


def classified(case: Case) -> None:
    json.loads(case.command("info", str(case.path), "--json"))
    case.command("info", str(case.path))


def swept(case: Case) -> None:
    case.command(
        "solve", str(case.path), "--sweep", "0:360:45", "--phase", "--csv", str(case.made("out.csv"))
    )
    with case.made("out.csv").open(encoding="utf-8") as file:
        assert len({len(row) for row in csv.reader(file)}) == 1


def _figure(case: Case, name: str) -> Path:
    """Draw a pose in one of the case's ways, small, and return the file's path."""
    size, phase = case.rng.choice(("64x36", "160x90", "36x64")), f"{case.rng.uniform(-9, 9)} rad"
    path = case.made(name)
    more = case.rng.choice(case.ways)
    case.command("draw", str(case.path), "--size", size, "--phase", phase, *more, "-o", str(path))
    return path


def drawn(case: Case) -> None:
    well_formed(_figure(case, "out.svg").read_text(encoding="utf-8"))


def printed(case: Case) -> None:
    assert _figure(case, "out.pdf").read_bytes().startswith(b"%PDF")


def painted(case: Case) -> None:
    _figure(case, "out.png")


def charted(case: Case) -> None:
    scene = load(case.path)
    tokens = case.rng.sample(sorted(scene.quantities), 1)
    suffix = case.rng.choice((".svg", ".png", ".csv", ".pdf"))
    target = case.made(f"chart{suffix}")
    over = case.rng.choice(("time", "phase"))
    words = ("--quantity", ",".join(tokens), "--over", over, "--size", "200x120", "-o", str(target))
    case.command("chart", str(case.path), *words)
    if suffix == ".svg":
        well_formed(target.read_text(encoding="utf-8"))


def well_formed(text: str) -> None:
    """Hold a picture to being well-formed, with nothing in it that is not a number."""
    for element in ElementTree.fromstring(text).iter():
        numbers = " ".join(element.get(key, "") for key in ("d", "x", "y", "font-size", "stroke-width"))
        assert "nan" not in numbers, numbers
        assert "inf" not in numbers, numbers


def _clip(case: Case, name: str, frames: int) -> None:
    more = case.rng.choice(((), EVERYTHING))
    words = ("--size", "64x36", "--seconds", f"{frames / 25}", "-o", str(case.made(name)))
    case.command("record", str(case.path), *words, *more)


def recorded(case: Case) -> None:
    _clip(case, "clip.gif", 2)


def framed(case: Case) -> None:
    """Record pictures, numbered."""
    _clip(case, "clip.png", 2)
    assert len(list(case.folder.glob("clip-*.png"))) == 2


def reported(case: Case) -> None:
    case.command("report", str(case.path), "-o", str(case.made("report")))
    text = case.made("report").joinpath("report.html").read_text(encoding="utf-8")
    assert text.isprintable() or set(text) - {"\n"} == set(text.replace("\n", ""))


def laid(case: Case) -> None:
    """Make it of flat parts, in true size or on a page, or hear in a sentence why not."""
    words = case.rng.choice(((), ("--fit", "A4"), ("--fit", "Letter", "--bridge"), ("--bridge",)))
    try:
        found = json.loads(case.command("make", str(case.path), "--json", *words))
    except Failure as failure:
        if ": 2: linkanim: " not in str(failure):
            raise
    else:
        assert (found["refused"] is None) == bool(found["fittings"])


def taped(case: Case) -> None:
    """Record a tape that goes far, with names and vectors."""
    actions = [
        Action("names"),
        Action("scrub", case.rng.choice(FAR)),
        Action("vectors", "a"),
        Action("chart", 1),
    ]
    tape = Tape(begin(load(case.path)), 3, tuple((1, action) for action in actions), (64, 36))
    path = case.made("my.tape.json")
    path.unlink(missing_ok=True)
    write(tape, path)
    case.command("record", str(path), "--size", "64x36", "-o", str(case.made("tape.gif")))


def played(case: Case) -> None:
    """Open the window and press keys at random, several within one frame."""
    with chdir(case.folder), display.opened((160, 90)):
        window = Window(begin(load(case.path)))
        try:
            _play(window, case.rng)
        finally:
            window.close()
    faults = [path.read_text(encoding="utf-8") for path in case.folder.glob("recordings/*fault*")]
    shutil.rmtree(case.folder / "recordings", ignore_errors=True)
    if faults:
        raise Failure(faults[0])


def _play(window: Window, rng: Random) -> None:
    window.tick()
    for _ in range(5):
        for _ in range(rng.choice((1, 1, 2, 4))):
            _press(rng)
        window.tick(rng.choice((1, 1, 5, 60)))


def _press(rng: Random) -> None:
    at = rng.randrange(160), rng.randrange(90)
    match rng.randrange(6):
        case 0:
            for kind in (pygame.MOUSEBUTTONDOWN, pygame.MOUSEMOTION, pygame.MOUSEBUTTONUP):
                at = rng.randrange(160), rng.randrange(90)
                more = {"rel": (0, 0), "buttons": (1, 0, 0)} if kind == pygame.MOUSEMOTION else {"button": 1}
                pygame.event.post(pygame.event.Event(kind, pos=at, **more))
        case 1:
            key = rng.choice(MOVES)
            pygame.event.post(pygame.event.Event(pygame.KEYDOWN, key=key, mod=rng.choice(MODS), unicode=""))
        case _:
            letter = rng.choice(KEYS)
            mod = rng.choice(MODS)
            pygame.event.post(pygame.event.Event(pygame.KEYDOWN, key=ord(letter), mod=mod, unicode=letter))


Output = Callable[[Case], None]
OUTPUTS: Mapping[str, Output] = {
    output.__name__: output
    for output in (
        checked,
        solved,
        swept,
        classified,
        charted,
        drawn,
        printed,
        painted,
        framed,
        recorded,
        reported,
        laid,
        taped,
        played,
    )
}
