"""In the made-up language: pictures and the window say nothing that is not from the catalogue, and fit.

Its sentences are two fifths longer than the English ones.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pygame
import pytest
from pseudo import plain_words, spoken_pseudo

import linkanim
from linkanim.picture.frame_words import labelled
from linkanim.picture.look import Look
from linkanim.picture.text import Type
from linkanim.player.action import Action
from linkanim.player.actions import carried
from linkanim.player.state import begin
from linkanim.ui import screen
from linkanim.ui.window import Window

KEYS = frozenset(
    {
        *("Space", "Enter", "Tab", "Shift", "Ctrl", "Alt", "Esc", "PgUp", "PgDn", "Del"),
        *("rpm", "rad", "deg", "GIF", "MP4", "REC", "SVG", "English"),
    }
)
SIZES = ((320, 180), (640, 360), (1280, 720), (360, 640))
SHOWN: dict[str, tuple[str, tuple[Action, ...]]] = {
    "names, arrows, a chart": (
        "press",
        (Action("names"), Action("names"), *(Action("vectors", one) for one in "vaf"), Action("chart", 1)),
    ),
    "polygons and instant centres": ("crank-rocker", (Action("polygons"), Action("centres"))),
    "ink and chain": ("slider-crank", (Action("ink"), Action("chain"), Action("dead_centres"))),
    "dimensions": ("press", (Action("edit"),)),
    "quantities": ("crank-rocker", (Action("list"),)),
    "commands": ("crank-rocker", (Action("menu"),)),
    "commands of a link": ("crank-rocker", (Action("menu", "link coupler"),)),
    "all things": ("press", (Action("menu", "things"),)),
    "find": ("press", (Action("find"),)),
    "the help": ("press", (Action("help"),)),
    "the help of a list": ("press", (Action("edit"), Action("help"))),
    "the shelf": ("press", (Action("shelf"),)),
    "a recording": ("press", (Action("record_dialog"),)),
    "a construction": ("crank-rocker", (Action("pause"), Action("construct", 1), Action("construct", 3))),
    "a sheet": ("press", (Action("sheet"),)),
    "a linkage on a sheet": ("crank-rocker", (Action("build_on"),)),
    "tolerances": ("crank-rocker", (Action("tolerance"),)),
    "the pencil": ("press", (Action("pencil"),)),
    "poses": ("press", (Action("poses"),)),
    "a slider that swings": ("driven-piston", (Action("pause"), Action("names"))),
}


_NAMED = re.compile(r"\S*[/\\.]\S+|_\{[^}]*\}")
"""A file, and what a symbol is of."""


@contextmanager
def lines_drawn(patch: pytest.MonkeyPatch) -> Iterator[dict[str, bool]]:
    """Collect the lines of text that are drawn, each with whether all of it was on its surface."""
    lines: dict[str, bool] = {}
    draw = Type.draw

    def noted(self: Type, surface: pygame.Surface, text: str, at: tuple[float, float], **how: Any) -> int:
        wide = draw(self, surface, text, at, **how)
        left = at[0] - {"left": 0.0, "centre": wide / 2, "right": wide}[how.get("anchor", "left")]
        fits = left >= -1 and left + wide <= surface.get_width() + 1
        lines[text] = lines.get(text, True) and fits
        return wide

    with patch.context() as within:
        within.setattr(Type, "draw", noted)
        yield lines


def unsaid(lines: Iterator[str], own: frozenset[str]) -> set[str]:
    """Return the words of lines that no catalogue gave; but for typed files and addresses."""
    return set().union(*(plain_words(_NAMED.sub("", line), KEYS | own) for line in lines))


@pytest.mark.slow
@pytest.mark.parametrize("case", SHOWN)
def test_the_window_says_all_in_the_reader_s_language_and_it_fits(
    case: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    name, actions = SHOWN[case]
    for size in SIZES:
        with spoken_pseudo(monkeypatch), lines_drawn(monkeypatch) as lines, screen.opened(size):
            window = Window(begin(name))
            for action in actions:
                window.state = carried(window.state, action)
                window.tick()
            for _ in range(20):
                window.tick()
            own = frozenset(window.state.scene.linkage.by_name)
        assert lines
        assert unsaid(iter(lines), own) == set(), size
        assert [line for line, fits in lines.items() if not fits] == [], size


@pytest.mark.sampled
@pytest.mark.parametrize("name", linkanim.names())
def test_a_picture_says_all_in_the_reader_s_language(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    scene = linkanim.load(name)
    look = Look(
        names=2, vectors=frozenset("va"), polygons=True, centres=1, caption=True, chain=True, ink=True
    )
    with spoken_pseudo(monkeypatch):
        lines = [line.text for line in labelled(scene, 1.0, look, (1280, 720))]
    assert unsaid(iter(lines), frozenset(scene.linkage.by_name)) == set()
