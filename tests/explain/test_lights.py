"""A symbol of a solution lights its part of the figure, and a part its symbols: by mouse, touch and keys."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from browser import PROGRAM, browser

from linkanim.cli import main
from linkanim.explain.formula import Formula, Symbol
from linkanim.explain.solution import PoseRequest, Solution, solution
from linkanim.explain.steps import Given, ValueLine
from linkanim.paper.vectors import vectors_svg
from linkanim.scenes import load, names

NONE = re.compile(r"^(?:[bkψβℓπλ]|a\d)")
"""Symbols of one step alone: entries of a matrix, angles of a triangle at a limit."""
OF_NO_PART = {"half", "R", "min", "max", "back", "front", "m", "b"}
"""Indices of what belongs to a step, or to the motion as a whole."""


def _kind(letter: str) -> str:
    kinds = {"r": "rR", "w": "θωαhmPI", "s": "sfgtST"}
    return next((kind for kind, letters in kinds.items() if letter in letters), "j")


def _leaves(found: Solution) -> Iterator[Formula]:
    for item in (item for chapter in found.chapters for item in chapter.items):
        if isinstance(item, ValueLine):
            yield from (*item.formula.leaves, item.value)
        elif isinstance(item, Given):
            yield item.value


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_every_symbol_has_its_part_of_the_figure(name: str) -> None:
    scene = load(name)
    found = solution(PoseRequest(scene, "phase", 1.0, scene.linkage.drive.speed))
    if not found.arrows:
        return
    indices = set(" ".join(re.findall(r'data-i="([^"]*)"', vectors_svg(found))).split())
    # springs, dampers, loads and their pins are not in the figure of the loops
    bodies = {joint for body in scene.linkage.bodies for joint in body.joints}
    linkage = scene.linkage
    others = {one.name for one in linkage.springs} | {one.name for one in linkage.dampers}
    others |= {one.name for one in linkage.loads}
    others |= {pin.name for pin in linkage.pins if pin.name not in bodies}
    missing: set[Symbol] = set()
    for leaf in _leaves(found):
        symbol = leaf.symbol
        if symbol is None or not symbol.sub or NONE.match(symbol.letter + symbol.sub):
            continue
        # its own index, that of a turning link's power, of a spring's free length, of a load's component
        own = {
            symbol.sub,
            symbol.sub.removesuffix("turn"),
            symbol.sub.removesuffix("0"),
            symbol.sub.split(",")[0],
        }
        known = {f"{_kind(symbol.letter)}{index}" for index in own} & indices
        if not (known or own & (OF_NO_PART | others)):
            missing.add(symbol)
    # of the excavator only the cylinder's triangle is a loop
    assert missing == set() or name == "excavator"


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Any:
    with browser(tmp_path_factory.mktemp("browser")) as opened:
        yield opened


LIT = "[...document.querySelectorAll('svg .lit')].map(e => e.dataset.i.split(' ')[0])"
OF = "[...document.querySelectorAll('math [data-y]')].find(e => e.textContent === '{}')"


@pytest.mark.slow
@pytest.mark.skipif(not PROGRAM, reason="needs Chromium")
def test_mouse_touch_and_keys_light_the_part_and_its_symbols(page: Any, tmp_path: Path) -> None:
    target = tmp_path / "solution.html"
    assert main(["explain", "crank-rocker", "--angle", "60 deg", "-o", str(target)]) == 0
    page.go(target.as_uri())
    for symbol, part in {"ω3": "w3", "r2": "r2", "vB": "jB"}.items():
        box = page.value(f"(() => {{ const e = {OF.format(symbol)}; e.scrollIntoView({{block: 'center'}});"
                         "return e.getBoundingClientRect().toJSON(); })()")  # fmt: skip
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        page.mouse("mouseMoved", x, y)
        assert part in page.value(LIT), symbol
        page.mouse("mouseMoved", 1, 1)
        page.value("document.dispatchEvent(new PointerEvent('pointerover', {bubbles: true}))")
    # a part lights its symbols
    page.value("document.querySelector('svg [data-i~=\"jB\"]').focus()")
    lit = page.value("[...document.querySelectorAll('math .lit')].map(e => e.textContent)")
    assert {"xB", "vB", "γB"} <= set(lit)
    # by keys: the figure's parts and each symbol once are reached by Tab
    page.value("document.activeElement.blur(); window.scrollTo(0, 0)")
    seen = set()
    for _ in range(60):
        page.key("Tab", code="Tab", windowsVirtualKeyCode=9)
        seen.add(page.value("document.activeElement.dataset.y ?? document.activeElement.dataset.i ?? ''"))
    assert {"w3", "r2"} <= {one for text in seen for one in text.split()}
