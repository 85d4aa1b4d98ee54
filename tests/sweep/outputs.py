"""Everything that is made of a scene file that `check` calls good, each under limits of time and memory."""

from __future__ import annotations

import csv
import json
import re
import shutil
from collections.abc import Callable, Mapping
from contextlib import chdir, redirect_stderr, redirect_stdout
from dataclasses import dataclass
from html.parser import HTMLParser
from io import StringIO
from pathlib import Path
from random import Random
from unicodedata import category
from xml.etree import ElementTree
from zipfile import ZipFile

import numpy as np
import pygame
import tomli_w
from typed_linkages import Document

from linkanim.cli import main
from linkanim.errors import BadInput
from linkanim.player.action import Action
from linkanim.player.state import begin
from linkanim.player.tape import Tape
from linkanim.player.tape_file import write
from linkanim.scenes import load
from linkanim.scenes.reading import scene_from
from linkanim.ui import screen
from linkanim.ui.window import Window

SECONDS, MEGABYTES = 10.0, 400
"""What each output of a scene may take: processor time, and memory beside what was there before."""
KEYS = "abcdehiklnoprtv0123456789+-=.?sg"
MODS = (0, 0, 0, pygame.KMOD_LSHIFT, pygame.KMOD_LCTRL)
MOVES = (
    *(pygame.K_LEFT, pygame.K_RIGHT, pygame.K_UP, pygame.K_DOWN, pygame.K_RETURN, pygame.K_TAB),
    *(pygame.K_F2, pygame.K_F4, pygame.K_F6, pygame.K_F7, pygame.K_F10, pygame.K_PERIOD, pygame.K_COMMA),
    *(pygame.K_w, pygame.K_y, pygame.K_k, pygame.K_o, pygame.K_x, pygame.K_ESCAPE, pygame.K_BACKSPACE),
)
FAR = (-1e100, -1e9, 0.0, 1.0, 1e9, 1e16, 1e100)
EVERYTHING = ("--names", "--names", "--vectors", "v,a", "--polygons")
WAYS: tuple[tuple[str, ...], ...] = (
    (),
    ("--names",),
    EVERYTHING,
    ("--poses", "3", "--vectors", "v,a"),
    ("--polygons", "--instant-centres"),
    ("--theme", "dark", "--transparent"),
    ("--chain", "--instant-centres", "--caption"),
    ("--unit", "in"),
    ("--ink",),
    ("--ink", "--theme", "dark", "--chain"),
)
CONSTRUCTIONS = ("", "centres", "dead-centres", "synthesis", "centres:1", "dead-centres:2", "99")
FORMS = ("html", "tex", "md")
_PHASES, _HELD = 48, 1e-9
"""Phases of a drive period at which bars are looked at, and by what share of the size they may be off."""
BOUND = re.compile(r"(is|are) the (most|least)|at the most|(figure|report) holds")
"""What says that something is more than is made, before work begins."""
NOT_OF_ALL = re.compile(
    r"nothing in it moves clearly enough for a question"
    r"|its input is a slider, which has no angle"
    r"|--angles .* cannot be reached; the .* goes from "
)
"""Why some output is not made of every scene."""


_REFUSED = re.compile(r": 2: linkanim: [^\n]+\n\Z")
"""How a failure ends where one sentence refuses what was asked for."""


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

    def asked(self, *words: str) -> str | None:
        """Run a command that cannot be done of every scene, as `command`; None where a sentence says why."""
        try:
            return self.command(*words)
        except Failure as failure:
            if _REFUSED.search(str(failure)):
                return None
            raise

    def command(self, *words: str) -> str | None:
        """Run a command, and return what it printed; None where that is refused for a bound that is said.

        Failure where its exit code is another one than 0.
        """
        printed, problems = StringIO(), StringIO()
        with redirect_stdout(printed), redirect_stderr(problems):
            code = main(words)
        said = problems.getvalue()
        if code:
            whole = f"{' '.join(words)}: {code}: {said}"
            if said.count("\n") == 1 and ((code == 2 and BOUND.search(whole)) or NOT_OF_ALL.search(said)):
                return None
            raise Failure(whole)
        if "Warning" in said or "Traceback" in said:
            raise Failure(f"{' '.join(words)}: warned: {said}")
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
    """Write a document as a scene file into a new folder, and a photograph beside it."""
    folder.mkdir()
    path = folder / "my.toml"
    path.write_text(tomli_w.dumps(document), encoding="utf-8")
    if "photo" in document:
        pygame.image.save(pygame.Surface((8, 6)), folder / "photo.png")
    return Case(path, rng)


def checked(case: Case) -> None:
    case.command("check", str(case.path))


def solved(case: Case) -> None:
    phase = f"{case.rng.uniform(-9, 9)} rad"
    json.loads(case.command("solve", str(case.path), "--phase", phase, "--json") or "")


def held(case: Case) -> None:
    """Look whether every bar keeps its length over the true period: from the joints' places alone."""
    scene = load(str(case.path))
    places = scene.cycle(_PHASES * scene.mechanism.periods, derivatives=0).position
    size = max(float(np.abs(place).max()) for place in places.values())
    for joint in scene.linkage.joints:
        for start, length in joint.bars:
            away = np.hypot(*(places[joint.name] - places[start]).T)
            miss = float(np.abs(away - abs(length)).max())
            if not miss <= _HELD * size:
                raise Failure(f"bar {start}-{joint.name} is off by {miss / size:.1e} of the size")


def classified(case: Case) -> None:
    json.loads(case.command("info", str(case.path), "--json") or "")
    case.command("info", str(case.path))


def swept(case: Case) -> None:
    case.command(
        "solve", str(case.path), "--sweep", "0:360:45", "--phase", "--csv", str(case.made("out.csv"))
    )
    with case.made("out.csv").open(encoding="utf-8") as file:
        assert len({len(row) for row in csv.reader(file)}) == 1


def printed_rows(case: Case) -> None:
    """Print a sweep to be read, or as JSON."""
    form = case.rng.choice(((), ("--json",)))
    case.command("solve", str(case.path), "--sweep", "0:720:15", "--phase", *form)


def _figure(case: Case, name: str, *more: str) -> Path | None:
    """Draw a pose in one of the case's ways, small, and return the file's path."""
    size, phase = case.rng.choice(("64x36", "160x90", "36x64")), f"{case.rng.uniform(-9, 9)} rad"
    path = case.made(name)
    more = (*case.rng.choice(case.ways), "--size", size, *more)
    done = case.command("draw", str(case.path), "--phase", phase, *more, "-o", str(path))
    return None if done is None else path


def drawn(case: Case) -> None:
    if path := _figure(case, "out.svg"):
        well_formed(path.read_text(encoding="utf-8"))


def printed(case: Case) -> None:
    path = _figure(case, "out.pdf")
    assert path is None or path.read_bytes().startswith(b"%PDF")


def painted(case: Case) -> None:
    _figure(case, "out.png")


def crowded(case: Case) -> None:
    """Draw many poses, or a picture of an extreme shape or size."""
    ways = ("--poses 360", "--poses 40", "--size 16384x16", "--size 16x9000", "--size 16x16")
    more = case.rng.choice((*ways, "--size 1920x1080 --names --names", "--size 16384x16384")).split()
    _figure(case, case.rng.choice(("out.png", "out.png", "out.svg", "out.pdf")), *more)


def latexed(case: Case) -> None:
    """Leave a figure's words to LaTeX."""
    if path := _figure(case, "latex.pdf", "--text", "latex"):
        balanced(path.with_name("latex.pdf_tex").read_text(encoding="utf-8"))


def balanced(text: str) -> None:
    """Hold LaTeX to closing each brace that it opens, and to letters beside what its fonts have."""
    bare = re.sub(r"\\[\\{}%]", "", text)
    assert bare.count("{") == bare.count("}")
    assert [char for char in text if ord(char) >= 0x180 and not char.isalnum()] == []


def explained(case: Case) -> None:
    """Work a pose out, as an exercise or not."""
    form, phase = case.rng.choice(FORMS), f"{case.rng.uniform(-9, 9)} rad"
    path = case.made(f"solution.{form}")
    more = case.rng.choice(((), ("--exercise",), ("--seed", "3")))
    case.command("explain", str(case.path), "--phase", phase, *more, "-o", str(path))
    text = path.read_text(encoding="utf-8")
    match form:
        case "html":
            closed(text)
        case "tex":
            balanced(text)
            assert text.isascii() or max(map(ord, text)) < 0x180 or "% run xelatex or lualatex" in text
        case _:
            assert "<" not in text.replace("\\<", "").replace("\\\\", "")


class _Closing(HTMLParser):
    """Reads a page strictly: what is opened is closed, in its order; no script but one, no handler."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        assert not [name for name, _ in attrs if name.startswith("on")], attrs
        assert tag != "img" or dict(attrs).get("src", "").startswith("data:")  # type: ignore[union-attr]
        if tag not in ("meta", "link", "input", "br", "img", "hr"):
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag, tag


def closed(text: str) -> None:
    """Hold a page to what a strict reader asks of it."""
    reader = _Closing()
    reader.feed(text)
    reader.close()
    assert reader.open == []


def shared(case: Case) -> None:
    """Share a page, with or without a chart and names."""
    tokens = sorted(load(case.path).quantities)
    chart = ("--chart", case.rng.choice(tokens)) if tokens and case.rng.random() < 0.5 else ()
    path = case.made("page.html")
    if case.command("share", str(case.path), *chart, "--names", "-o", str(path)) is not None:
        text = path.read_text(encoding="utf-8")
        closed(text)
        data = re.search(r'id="data">(.*?)</script>', text, re.DOTALL)
        assert data
        json.loads(data[1], parse_constant=lambda name: 1 / 0)


def asked(case: Case) -> None:
    """Ask about it, on a sheet, as a list or in words."""
    count, form = case.rng.choice((("3", "html"), ("10", ""), ("2", "json"), ("60", "html")))
    path = case.made("sheet.html")
    how = {"html": ("-o", str(path)), "json": ("--json",), "": ()}[form]
    done = case.command("quiz", str(case.path), "-n", count, "--seed", str(case.rng.randrange(99)), *how)
    if done is not None and form == "html":
        closed(path.read_text(encoding="utf-8"))
    elif done and form == "json":
        json.loads(done)


def charted(case: Case) -> None:
    scene = load(case.path)
    tokens = case.rng.sample(sorted(scene.quantities), 1)
    suffix = case.rng.choice((".svg", ".png", ".csv", ".pdf"))
    target = case.made(f"chart{suffix}")
    over = case.rng.choice(("time", "phase"))
    words = ("--quantity", ",".join(tokens), "--over", over, "--size", "200x120", "-o", str(target))
    if case.command("chart", str(case.path), *words) is not None and suffix == ".svg":
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


def filmed(case: Case) -> None:
    _clip(case, "clip.mp4", 2)


def framed(case: Case) -> None:
    """Record pictures, numbered."""
    _clip(case, "clip.png", 2)
    assert len(list(case.folder.glob("clip-*.png"))) == 2


def reported(case: Case) -> None:
    more = case.rng.choice(((), (), ("--all",), ("--angles", "0 deg,87 deg"), ("--unit", "cm")))
    if case.command("report", str(case.path), "-o", str(case.made("report")), *more) is None:
        return
    text = case.made("report").joinpath("report.html").read_text(encoding="utf-8")
    assert text.isprintable() or set(text) - {"\n"} == set(text.replace("\n", ""))


def laid(case: Case) -> None:
    """Make it of flat parts, in true size or on a page, or hear in a sentence why not."""
    words = case.rng.choice(((), ("--fit", "A4"), ("--fit", "Letter", "--bridge"), ("--bridge",)))
    found = json.loads(case.asked("make", str(case.path), "--json", *words) or "null")
    assert found is None or (found["refused"] is None) == bool(found["fittings"])


def cut(case: Case) -> None:
    """Write its parts into a folder, with or without a picture of their layers."""
    folder, picture = case.made("parts"), case.made(f"layers{case.rng.choice(('.svg', '.png', '.pdf'))}")
    words = case.rng.choice((("--fit", "A4"), ("--fit", "A4", "--bridge", "--kerf", "0.2"), ()))
    more = case.rng.choice(((), ("--preview", str(picture))))
    way = case.rng.choice(("cardboard", "laser", "print"))
    done = case.asked("make", str(case.path), "-o", str(folder), "--way", way, *words, *more)
    assert (done is None) != folder.exists()
    if done is not None:
        for path in folder.rglob("*.svg"):
            well_formed(path.read_text(encoding="utf-8"))
        for path in folder.rglob("*.html"):
            closed(path.read_text(encoding="utf-8"))


def constructed(case: Case) -> None:
    """Draw or record a construction, whole or its first steps, or hear in a sentence why there is none."""
    kind, alt = case.rng.choice(CONSTRUCTIONS), case.made("told.txt")
    path = case.made(f"steps{case.rng.choice(('.svg', '.svg', '.png', '.pdf', '.gif'))}")
    command = "record" if path.suffix == ".gif" else "draw"
    words = ("--construction", *((kind,) if kind else ()), "--alt", str(alt), "--size", "160x90")
    if case.asked(command, str(case.path), *words, "-o", str(path)) is not None:
        told(alt, case.path)
        if path.suffix == ".svg":
            well_formed(path.read_text(encoding="utf-8"))


def described(case: Case) -> None:
    """Have a figure, a chart, a recording or a page told in words."""
    alt = case.made("told.txt")
    kind = case.rng.choice(("draw", "draw", "chart", "record"))
    tokens = sorted(load(case.path).quantities)
    phases = ((), ("--phase", "1 rad"), ("--phase", "4 rad"), ("--phase", "-3 rad"))
    more: tuple[str, ...] = {
        "draw": (*case.rng.choice(case.ways), *case.rng.choice(phases), "-o", str(case.made("out.svg"))),
        "chart": ("--quantity", case.rng.choice(tokens), "--over", "time", "-o", str(case.made("out.svg"))),
        "record": ("--seconds", "0.08", *case.rng.choice(((), ("--ink",))), "-o", str(case.made("out.gif"))),
    }[kind]
    if case.command(kind, str(case.path), "--size", "64x36", "--alt", str(alt), *more) is not None:
        told(alt, case.path)


def told(path: Path, file: Path) -> None:
    """Hold a text to one paragraph of plain words; the names that the scene's file gives may be any."""
    text = path.read_text(encoding="utf-8")
    linkage = load(file).linkage
    names = [*(joint.name for joint in linkage.joints), *(body.name for body in linkage.bodies)]
    for name in sorted(names, key=len, reverse=True):
        text = text.replace(name, "J")
    assert text.endswith("\n")
    assert not set(map(category, text[:-1])) & {"Cc", "Cs", "Zl", "Zp"}, text
    assert not re.search(r"\b(nan|inf|None)\b", text.replace("None.", "")), text


def examined(case: Case) -> None:
    """Write it as an exercise, of any level, in versions."""
    path, count = case.made(f"exam.{case.rng.choice(FORMS)}"), case.rng.choice(("1", "1", "1", "2", "3"))
    level = case.rng.choice(("formulas", "hints", "drawing"))
    words = ("--exercise", "--level", level, "--versions", count, "--seed", "2")
    if case.asked("explain", str(case.path), *words, "-o", str(path)) is not None and path.suffix == ".html":
        closed(path.read_text(encoding="utf-8"))


def platformed(case: Case) -> None:
    """Write questions for learning platforms: strict XML, and a package of it."""
    moodle, qti = case.made("q.xml"), case.made("q.zip")
    words = ("-n", case.rng.choice(("2", "6")), "--moodle", str(moodle), "--qti", str(qti))
    if case.command("quiz", str(case.path), *words) is not None:
        ElementTree.parse(moodle)
        with ZipFile(qti) as package:
            assert package.testzip() is None
            for name in package.namelist():
                assert not name.startswith(("/", "..")), name
                if name.endswith(".xml"):
                    ElementTree.fromstring(package.read(name))


def measured(case: Case) -> None:
    """Lay a table of its own values beside a report or a chart."""
    scene, table = load(case.path), case.made("measured.csv")
    token = case.rng.choice(sorted(scene.quantities))
    chart = ("chart", str(case.path), "--quantity", token, "--over", "time")
    if case.command(*chart, "-o", str(table)) is None:
        return
    rows = table.read_text(encoding="utf-8").splitlines()
    table.write_text("\n".join((f"time,{token}", *rows[1::40])) + "\n", encoding="utf-8")
    if case.rng.random() < 0.5:
        case.asked("report", str(case.path), "--data", str(table), "-o", str(case.made("measured")))
    else:
        case.asked(*chart, "--data", str(table), "--size", "200x120", "-o", str(case.made("laid.svg")))


def found_again(case: Case) -> None:
    """Seek a linkage for a motion of this one, and make of what is found a figure, a solution and a page."""
    target, table = case.made("found.toml"), case.made("given.csv")
    cycle = load(case.path).cycle(40)
    joint = case.rng.choice(sorted(cycle.position))
    kind = case.rng.choice(("guide", "guide", "function", "quick-return", "path"))
    words: tuple[str, ...]
    if kind == "quick-return":
        ratio, size = f"{case.rng.uniform(0.9, 4)}", f"{case.rng.choice((1e-9, 1, 80, 1e9, 170))}"
        words = case.rng.choice((("--stroke", size), ("--swing", f"{size} deg")))
        words = ("--ratio", ratio, *words)
    elif kind == "function":
        turned = sorted(cycle.angle) or [""]
        values = cycle.angle.get(case.rng.choice(turned), cycle.position[joint][:, 0])
        rows = [f"{x},{y}" for x, y in list(enumerate(values))[: case.rng.choice((5, 12, 40))]]
        table.write_text("\n".join(rows) + "\n", encoding="utf-8")
        words = (str(table), *case.rng.choice(((), ("--points", "3"), ("--kind", "slider-crank"))))
    else:
        step = case.rng.choice((1, 3, 9))
        places = cycle.position[joint][:: step if kind == "guide" else 1]
        turn = [10.0 * n for n in range(len(places))]
        most = case.rng.randint(2, 5) if kind == "guide" else 40
        rows = [f"{x},{y},{angle}" for (x, y), angle in zip(places, turn, strict=True)][:most]
        table.write_text("\n".join(rows) + "\n", encoding="utf-8")
        words = (str(table), "--count", "2")
    if case.asked(kind, *words, "-o", str(target)) is None:
        assert not target.exists()
        return
    case.command("check", str(target))
    found = Case(target, case.rng, case.ways)
    for output in (constructed, drawn, explained):
        output(found)


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
    with chdir(case.folder), screen.opened((160, 90)):
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
            button = rng.choice((1, 1, 1, 3))
            for kind in (pygame.MOUSEBUTTONDOWN, pygame.MOUSEMOTION, pygame.MOUSEBUTTONUP):
                at = rng.randrange(160), rng.randrange(90)
                more = (
                    {"rel": (0, 0), "buttons": (1, 0, 0)}
                    if kind == pygame.MOUSEMOTION
                    else {"button": button}
                )
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
        held,
        swept,
        printed_rows,
        classified,
        charted,
        drawn,
        printed,
        painted,
        crowded,
        latexed,
        explained,
        shared,
        asked,
        framed,
        filmed,
        recorded,
        reported,
        laid,
        cut,
        constructed,
        described,
        examined,
        platformed,
        measured,
        found_again,
        taped,
        played,
    )
}
