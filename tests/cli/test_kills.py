"""A command killed at any moment: nothing that was there before is gone, nothing half has its name."""

from __future__ import annotations

import os
import random
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from html.parser import HTMLParser
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

import pytest
from PIL import Image

from linkanim.scenes import load

pytestmark = pytest.mark.skipif(os.name != "posix", reason="kills by POSIX signals")

SIGNALS = ("SIGKILL", "SIGTERM", "SIGHUP", "SIGINT")
FOREIGN = {
    "thesis.docx": b"mine",
    "IMG-20240101.png": b"mine",
    "IMG-99999.png": b"mine",
    "into/thesis.docx": b"mine",
    "into/press.gif": b"mine",
    "kite.toml": b"mine",
    "press-1.svg": b"mine",
}
SMALL = ("--size", "64x36", "--seconds", "0.4", "--fps", "10")
# Small, and so many in a row that every moment of a command is met.
GALLERY = """
import sys
from linkanim import recorder
from linkanim.cli.exits import guarded
from linkanim.recorder import gallery
gallery.SIZE, gallery.RATES = (64, 36), (5.0,)
from pathlib import Path
sys.exit(guarded(lambda: gallery.make_gallery(Path("into"), ["kite", "scotch-yoke"])))
"""
SAVED = """
import sys
from pathlib import Path
from linkanim.cli.exits import guarded
from linkanim.scenes import load
from linkanim.scenes.toml import save
def work():
    scene = load("kite")
    for _ in range(100):
        save(scene, Path())
sys.exit(guarded(work))
"""


class Case(NamedTuple):
    """A command, what it writes by, and whether a file it wrote is whole."""

    words: tuple[str, ...]
    written: str
    is_whole: Callable[[Path], bool]


def is_picture(path: Path) -> bool:
    """Return whether a picture can be read to its end."""
    with Image.open(path) as image:
        for frame in range(getattr(image, "n_frames", 1)):
            image.seek(frame)
            image.load()
    return path.suffix.lower() != ".gif" or path.read_bytes().endswith(b";")


class Ends(HTMLParser):
    """Whether a page goes on to its end."""

    done = False

    def handle_endtag(self, tag: str) -> None:
        self.done = self.done or tag == "html"


def is_page(path: Path) -> bool:
    """Return whether a report's file is whole."""
    match path.suffix:
        case ".svg":
            return ElementTree.parse(path).getroot().tag.endswith("svg")
        case ".html":
            page = Ends()
            page.feed(path.read_text(encoding="utf-8"))
            return page.done
    return path.read_bytes().endswith(b"\n")


def is_scene(path: Path) -> bool:
    return load(path).name == path.stem


CASES = {
    "gif": Case(("-m", "linkanim", "record", "kite", *SMALL, "-o", "kite.gif"), "kite.gif", is_picture),
    "png": Case(("-m", "linkanim", "record", "kite", *SMALL, "-o", "IMG.png"), "IMG-0*.png", is_picture),
    "report": Case(("-m", "linkanim", "report", "scotch-yoke", "-o", "into"), "into/[!tp.]*", is_page),
    "gallery": Case(("-c", GALLERY), "into/[!.p]*.[gp]*", is_picture),
    "Ctrl+S": Case(("-c", SAVED), "kite-*.toml", is_scene),
}


def start(case: Case, here: Path) -> subprocess.Popen[bytes]:
    return subprocess.Popen(
        [sys.executable, "-P", *case.words], cwd=here, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE
    )


def begun(case: Case, here: Path) -> tuple[set[str], float]:
    """Put foreign files into a folder and run the command once; return what it wrote and how long it took."""
    (here / "into").mkdir()
    for name, content in FOREIGN.items():
        (here / name).write_bytes(content)
    before = time.monotonic()
    with start(case, here) as process:
        _, err = process.communicate()
    assert process.returncode == 0, err
    return names(case, here), time.monotonic() - before


def names(case: Case, here: Path) -> set[str]:
    return {str(path.relative_to(here)) for path in here.glob(case.written)}


def killed(case: Case, here: Path, number: signal.Signals, after: float) -> tuple[int, str]:
    """Run the command and send it a signal so many seconds after its start; return its code and stderr."""
    with start(case, here) as process:
        timer = threading.Timer(after, process.send_signal, (number,))
        timer.start()
        _, err = process.communicate()
        timer.cancel()
    return process.returncode, err.decode(errors="replace")


def kill_at_random(what: str, moments: int, here: Path) -> None:
    """Kill a command at so many random moments, by each signal in turn, and check what is left each time."""
    case, chance = CASES[what], random.Random(what)
    written, seconds = begun(case, here)
    assert written
    for moment in range(moments):
        number = signal.Signals[SIGNALS[moment % len(SIGNALS)]]
        code, err = killed(case, here, number, chance.uniform(0.1, 1.1) * seconds)
        assert code in (0, -number, 128 + number), (number, code, err)
        assert "Traceback" not in err or number == signal.SIGINT, err
        for name, content in FOREIGN.items():
            assert (here / name).read_bytes() == content, (number, name)
        left = names(case, here)
        assert written <= left, (number, written - left)
        for name in left:
            assert case.is_whole(here / name), (number, name)
    with start(case, here) as process:
        _, errors = process.communicate()
    assert process.returncode == 0, errors
    assert not list(here.rglob(".linkanim-*.part"))


@pytest.mark.withstands("faults survived", 2)
@pytest.mark.parametrize("what", ["Ctrl+S", pytest.param("gallery", marks=pytest.mark.long)])
@pytest.mark.slow
def test_a_killed_command_takes_nothing_away_and_leaves_nothing_half(what: str, tmp_path: Path) -> None:
    kill_at_random(what, 2, tmp_path)


@pytest.mark.long
@pytest.mark.withstands("faults survived", 200)
@pytest.mark.parametrize("what", CASES)
def test_two_hundred_moments_are_no_worse(what: str, tmp_path: Path) -> None:
    kill_at_random(what, 200, tmp_path)
