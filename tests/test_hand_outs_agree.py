"""A number is the same wherever a hand-out shows it: figure, text, results, key and the report's tables."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

import pytest

from linkanim.explain.documents import MARKDOWN
from linkanim.explain.exercise import exercise
from linkanim.explain.formula import LATEX, Symbol
from linkanim.explain.solution import PoseRequest, Solution, solution
from linkanim.mechanics.quantities import called
from linkanim.paper.curves import Pace
from linkanim.paper.figure import Figured, dimensioned
from linkanim.paper.findings import Instant, Values, value_tables
from linkanim.paper.svg import flat
from linkanim.picture.items import Caption
from linkanim.picture.stills import still_phase
from linkanim.scenes import load, names

DIGITS = 4
"""Of the report's tables."""
LOCAL = {"b1", "b2", "θhalf", "dmin", "dmax"}
"""Symbols of one step alone: right sides of two equations, reaches of two bars."""

Shown = tuple[str, str, str]
"""A symbol, the number that is shown for it, and where."""

_ROW = re.compile(r"\$([^$=&]+) = (?:.* = )?(-?\d[\d.]*)(\^\{\\circ\}|\\,\\mathrm[^$]*)?\$")
_GREEK = {"theta": "θ", "beta": "β", "alpha": "α", "omega": "ω", "varphi": "φ", "psi": "ψ", "ell": "ℓ"}


def _plain(latex: str) -> str:
    """Return a symbol in LaTeX as a figure has it, without its index's braces: θ2."""
    for name, letter in _GREEK.items():
        latex = latex.replace(f"\\{name}", letter)
    latex = latex.replace("\\dot", "˙").replace("\\ddot", "¨").replace("\\mathrm", "")
    return re.sub(r"[\\_{} ]", "", latex)


def _symbol(symbol: Symbol) -> str:
    return _plain(LATEX.symbol(symbol))


def _of_text(text: str, where: str) -> Iterator[Shown]:
    for symbol, number, _ in _ROW.findall(text):
        yield _plain(symbol), number, where


def _of_figure(figured: Figured) -> Iterator[Shown]:
    for item in flat(figured.groups()):
        if isinstance(item, Caption) and (stated := re.match(r"([^=]+) = (−?[\d.]+)(?: |°|$)", item.text)):
            yield re.sub(r"[_{}]", "", stated[1]), stated[2].replace("−", "-"), "figure"


def _of_tables(found: Solution) -> Iterator[Shown]:
    request = found.request
    scene, tokens = request.scene, {one.token: one.value.symbol for one in found.results}
    parts = {called(body, scene.info.link_names): body.name for body in scene.linkage.bodies}
    instant, pace = Instant(found.phase), Pace(request.speed, "")
    for table in value_tables(Values(scene), (instant,), (pace,), DIGITS):
        for _, rows in table.groups:
            for label, cells in rows:
                owner = table.title if table.head == "at" else label
                for column, cell in zip(table.columns, cells, strict=True):
                    symbol = tokens.get(f"{parts.get(owner, owner)}.{column.measure}")
                    if symbol is not None and "×" not in cell and re.match("[−\\d]", cell):
                        yield _symbol(symbol), cell.replace("−", "-"), f"table of {table.title}"


def _shown(found: Solution, figured: Figured) -> Iterator[Shown]:
    text, _, results = MARKDOWN.document(found).partition("## All results")
    yield from _of_figure(figured)
    yield from _of_text(text, "text")
    yield from _of_text(results, "results")
    yield from _of_text(exercise([found], MARKDOWN).partition("# Key")[2], "key")
    yield from _of_tables(found)


def _grain(number: str) -> float:
    """Return the value of a number's last digit."""
    if "." not in number and len(number.strip("-0")) == DIGITS and len(number.strip("-")) > DIGITS:
        return 10.0 ** (len(number.strip("-")) - DIGITS)
    return 10.0 ** -len(number.partition(".")[2])


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_every_number_is_the_same_in_figure_text_results_key_and_tables(name: str) -> None:
    scene = load(name)
    phase = still_phase(scene)
    found = solution(PoseRequest(scene, "phase", phase, scene.linkage.drive.speed))
    places: dict[str, list[tuple[str, str]]] = {}
    for symbol, number, where in _shown(found, dimensioned(scene, phase)):
        if symbol not in LOCAL:
            places.setdefault(symbol, []).append((number, where))
    wrong, compared = [], 0
    for symbol, said in places.items():
        finest, first = min(said, key=lambda one: _grain(one[0]))
        for number, where in said:
            off = float(number) - float(finest)
            if symbol[0] in "θψφ":
                off = math.remainder(off, 360)
            compared += where != first
            # a line that is worked out from shown digits may miss its last one
            if abs(off) > 0.5 * _grain(number) + _grain(finest):
                wrong.append(f"{symbol} = {number} ({where}), {finest} ({first})")
    assert not wrong
    assert compared > 2 * len(scene.linkage.joints)
