"""What every test needs: no window, no sound, no clock, and what was withstood is counted."""

from __future__ import annotations

import atexit
import gc
import os
import shutil
import signal
import tempfile
from collections import Counter
from functools import cache

import pytest
from hypothesis import settings
from withstood import MARK, table

from linkanim import scenes
from linkanim.picture.text import Type
from linkanim.scenes import Scene, files
from linkanim.ui import screen
from linkanim.ui.command_icons import window_icon

os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
os.environ.setdefault("SDL_AUDIODRIVER", "dummy")
# its greeting would follow the closing line, when the processes that run the tests end
os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")

# What is said is English, whatever the machine speaks.
os.environ["LANGUAGE"] = "en"

# A warning is an error in processes that tests start, too, but for those that Python does not show by itself.
os.environ["PYTHONWARNINGS"] = "error,ignore::ResourceWarning"

# What is kept of games goes to no user's own folder, by processes that tests start neither.
os.environ["XDG_DATA_HOME"] = os.environ["LOCALAPPDATA"] = tempfile.mkdtemp(prefix="linkanim-tests-")
atexit.register(shutil.rmtree, os.environ["XDG_DATA_HOME"], ignore_errors=True)

# A run in the background has Ctrl-C switched off, and so would be all that tests start and send it to.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

settings.register_profile("linkanim", deadline=None, derandomize=True, database=None)
settings.load_profile("linkanim")


@cache
def _scene(name: str) -> Scene:
    return files.load(name)


def _read_once(name_or_path: str | os.PathLike[str]) -> Scene:
    """Return a scene as `load` does, the catalogue's always the same: tests ask thousands of times.

    A scene is frozen; one that is to be read anew comes from `linkanim.scenes.files.load`.
    """
    known = isinstance(name_or_path, str) and scenes.chapter_of(name_or_path) is not None
    return _scene(str(name_or_path)) if known else files.load(name_or_path)


# before any test, or any module under test, has taken its name from there
scenes.load = _read_once


def _written_once() -> None:
    """Have all painters share the glyphs that one of them has drawn, and windows one icon.

    Both hang on nothing but what they are asked for; the tests open hundreds of windows.
    """
    begin, drawn = Type.__init__, Type()

    def shared(self: Type) -> None:
        begin(self)
        self._fonts, self._steps, self._glyphs = drawn._fonts, drawn._steps, drawn._glyphs

    Type.__init__ = shared  # type: ignore[method-assign]
    setattr(screen, "window_icon", cache(window_icon))  # noqa: B010


_written_once()

SAMPLE = {
    "crank-rocker",
    "kite",
    "double-rocker",
    "driven-piston",
    "inverted-slider-crank",
    "scotch-yoke",
    "oscillating-cylinder",
    "press",
    "excavator",
    "epicyclic-hypocycloid",
}
"""Scenes of every drive, dyad and kind of limit: what tests marked `sampled` look at."""

SOLVED_TOGETHER = {"double-butterfly", "knee-cylinder", "steering", "stephenson-3-link6"}
"""Scenes that take several times as long as others; two more like them are quick."""

BESIDE_LIMITS = {"bar_that_limits_the_input", "slot_that_limits_the_input", "at_a_change_point"}
"""What makes random linkages that are looked for long, to stand where they do."""


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Skip what needs a real window where there is no display; have each test carry what it withstands."""
    _leave_to_long_runs(items)
    _mark_quick(items)
    no_display = pytest.mark.skip(reason="needs a display; .ci/run starts one")
    for item in items:
        if item.get_closest_marker("window") and not os.environ.get("DISPLAY"):
            item.add_marker(no_display)
        item.user_properties += [(*mark.args, 1)[:2] for mark in item.iter_markers(MARK)]


def _leave_to_long_runs(items: list[pytest.Item]) -> None:
    """Mark as long what sampled tests have about other scenes, then what thinned ones leave out."""
    seen = Counter[str]()
    for item in items:
        about = item.callspec.params if hasattr(item, "callspec") else {}
        named = {
            value if isinstance(value, str) else getattr(value, "__name__", "") for value in about.values()
        }
        if not named.isdisjoint(SOLVED_TOGETHER | BESIDE_LIMITS):
            item.add_marker(pytest.mark.slow)
        if item.get_closest_marker("sampled") and about.get("name", about.get("scene")) not in SAMPLE:
            item.add_marker(pytest.mark.long)
        thinned = item.get_closest_marker("thinned")
        if thinned and not item.get_closest_marker("long"):
            test = item.nodeid.split("[")[0]
            if seen[test] % thinned.args[0]:
                item.add_marker(pytest.mark.long)
            seen[test] += 1


def _mark_quick(items: list[pytest.Item]) -> None:
    """Mark the first case of every test that is neither slow nor about the benchmarks."""
    seen: set[str] = set()
    for item in items:
        test = item.nodeid.split("[")[0]
        marks = {mark.name for mark in item.iter_markers()}
        if test not in seen and not {"slow", "long", "window"} & marks and "/bench/" not in test:
            item.add_marker(pytest.mark.quick)
        seen.add(test)


@pytest.hookimpl(trylast=True)
def pytest_collection_finish() -> None:
    """Have what has been collected left out of all later searches for garbage, and search less often."""
    gc.freeze()
    gc.set_threshold(10_000)


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Print what the tests that passed have withstood, before the closing line."""
    passed = terminalreporter.stats.get("passed", [])
    for line in table(found for report in passed for found in report.user_properties):
        terminalreporter.write_line(line)
