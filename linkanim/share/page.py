"""Write a scene as one HTML file: the picture, its motion, and the script that moves it.

Its rows of numbers and its chart cover one true period, in both directions.
"""

from __future__ import annotations

import base64
import hashlib
import json
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cache
from html import escape
from itertools import count
from math import floor, log10, pi
from pathlib import Path
from string import Template
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.mechanics.linkage import Crank
from linkanim.mechanics.motion import Motion
from linkanim.paper.svg import FACES
from linkanim.picture.chart import ChartPanel, Pen
from linkanim.picture.figure import Figure, figure
from linkanim.picture.hud import measured
from linkanim.picture.items import Caption
from linkanim.picture.look import Look, ThemeName
from linkanim.picture.picture import Picture
from linkanim.picture.quantities import quantity, speed_words, unbounded_places
from linkanim.picture.text import letters
from linkanim.picture.theme import Theme
from linkanim.picture.view import Rect
from linkanim.scenes.editing import closure_name, ghost_of
from linkanim.scenes.scene import Scene
from linkanim.share.forces import forces
from linkanim.share.laws import Law, law_of, parts_of
from linkanim.share.lengths import model
from linkanim.share.movers import (
    Mobile,
    Pairs,
    begin_of,
    centre,
    link_words,
    packed,
    shares_of,
    tracks,
)
from linkanim.share.tables import Tabulated, kind_of, table
from linkanim.words import html_language, said, sentences

# The numbers of a page over one true period, in both directions: rows of values, and the chart.

CHART = (720, 300)
"""The size for which the range of a chart's values is chosen; it is drawn as large as the page has room."""
_TEXT = (26, 22)
"""The heights of its text and of its small text there."""
_LINE = 2.0
_WORDS = 13
"""The height of a chart's titles on the page."""
_OF_A_ROW, _OF_A_CHART = 1 / 16, 2e-6
"""By how much of the last digit shown a row's table may be off; a chart's by this share of its height."""


def input_words(scene: Scene) -> str:
    """Return the name of the input's coordinate: "crank angle"."""
    return scene.info.coordinate_said


def rows(scene: Scene, speed: float) -> Iterator[dict[str, Any]]:
    """Yield the rows of a pose's values: where the input is, its speed, struts, what drives it.

    `values` are tables over a period, forward and backward. Where the two differ at most by a sign, only the
    first are given, and `back` is the sign; else it is 0. `text` does not change.
    """
    drive = scene.linkage.drive.coordinate

    def where(motion: Motion) -> Any:
        return drive.displayed(motion.coordinate)

    turn = 360 if scene.info.full_turn else 0
    unit = drive.display_unit(scene.length_unit)
    body = scene.linkage.driven.body
    driven = link_words(scene).get(body.name) if body else None
    of_input = {"of": [f"l {driven}"] if driven else []}
    yield _row(scene, input_words(scene), unit, 0.1, (where, (speed,))) | {"turn": turn} | of_input
    title = said("input speed") if scene.info.full_turn else said("input rate")
    yield {"label": title, "text": [speed_words(scene, way * speed) for way in (1, -1)]} | of_input
    for _, label, of, step in measured(scene):
        row = _row(scene, label, of.display_unit(scene.length_unit), step, (of.displayed, (speed, -speed)))
        yield row | {"law": law_of(scene, of), "of": parts_of(scene, of)}


_Asked = tuple[Callable[[Motion], Any], tuple[float, ...]]
"""What gives a number of a motion, and the speeds for which it is wanted."""


def _row(scene: Scene, label: str, unit: str, step: float, asked: _Asked) -> dict[str, Any]:
    shown, speeds = asked

    def read(phases: NDArray[np.float64]) -> NDArray[np.float64]:
        motions = (scene.solve(phase=phases, speed=speed) for speed in speeds)
        return np.array([shown(motion) for motion in motions], float)

    values = table(scene, (0.0, scene.period), read, (), _OF_A_ROW * 10.0 ** -_digits(step))
    forth, back = values.values[0], values.values[-1]
    sign = next((sign for sign in (1, -1) if np.array_equal(back, sign * forth)), 0)
    some = values.values if sign == 0 else values.values[:1]
    kind = kind_of(some)
    packs = {"values": [packed(one, kind) for one in some], **_number_type(kind), **values.data}
    return {"label": label, "unit": unit, "digits": _digits(step), **packs, "back": sign}


def _number_type(kind: str) -> dict[str, str]:
    """Return the entry that tells a page the type of numbers; none for the usual one."""
    return {} if kind == "<f4" else {"kind": kind[1:]}


def _digits(step: float) -> int:
    """Return the decimals that a step between neighbours needs."""
    return min(max(-floor(log10(step) + 1e-9), 0), 6)


def charts(figure: Figure, themes: tuple[Theme, Theme], shown: tuple[str, float], pairs: Pairs) -> list[Any]:
    """Return the chart of a quantity at a speed for both directions, each with its frame in SVG.

    `BadInput`, with the nearest names and the list, where the scene has no such quantity.
    """
    token, speed = shown
    of = quantity(figure.scene, token)
    text, small = _TEXT
    pens = (Pen(letters(), theme, small, text, _LINE) for theme in themes)
    one, other = (ChartPanel(figure, of, Rect(0, 0, *CHART), pen, speed) for pen in pens)
    known = figure.scene.quantities
    laws = [law_of(figure.scene, known[".".join(filter(None, (of.token, name)))]) for name in of.columns]
    forth, back = (_chart(one.at(way * speed), other.at(way * speed), pairs, laws) for way in (1, -1))
    forth["of"] = parts_of(figure.scene, of)
    del back["titles"]  # they are those of the way forth
    return [forth, back]


def _table(panel: ChartPanel, least: float) -> Tabulated:
    """Return the table of a chart's curves, from its left end to its right."""
    scene, series, course = panel.figure.scene, panel.series, panel.course
    unbounded = (unbounded_places(series.phases, column) for column in series.values.T)

    def read(phases: NDArray[np.float64]) -> NDArray[np.float64]:
        values = np.asarray(panel.quantity.displayed(scene.solve(phase=phases, speed=panel.speed)), float)
        columns: NDArray[np.float64] = values.T if values.ndim == 2 else values[None]
        if series.unit != "°":
            return columns
        x, drawn = panel.curves  # an angle is in the turn in which it is drawn
        near = np.array([np.interp(course.x_of(phases), x, column) for column in drawn.T])
        turned: NDArray[np.float64] = columns + 360.0 * np.nan_to_num(np.rint((near - columns) / 360.0))
        return turned

    begin, end = course.phase_of([0.0, course.span]).tolist()
    return table(scene, (begin, end), read, [place for some in unbounded for place in some.tolist()], least)


def _chart(light: ChartPanel, dark: ChartPanel, pairs: Pairs, laws: Sequence[Law | None]) -> dict[str, Any]:
    course, scene = light.course, light.figure.scene
    span = light.plot.y.high - light.plot.y.low
    values = _table(light, _OF_A_CHART * span)
    kind = kind_of(values.values)
    curves = [
        {
            "label": light.series.labels[n],
            "colour": pairs.variable(light.colour(n), dark.colour(n)),
            "values": packed(column, kind),
            "law": laws[n],
            **_number_type(kind),
            **values.data,
        }
        for n, column in enumerate(values.values)
    ]
    words, themes = light.quantity.title(scene.length_unit), (light.pen.theme, dark.pen.theme)
    titles = (words, words.removeprefix(f"{light.quantity.words} "), course.title, said("time (s)"))
    lines = ([Caption(title, (0.0, 0.0), _WORDS, theme.ink) for theme in themes] for title in titles)
    return {
        "words": words,
        "titles": [pairs.elements(*([line] for line in both)) for both in lines],
        "y": [light.plot.y.low, light.plot.y.high],
        "course": [course.origin, course.scale, course.span],
        "across": course.unit,
        "marks": list(course.marks),
        "unit": light.series.unit,
        "digits": _digits(span / 500),
        "rule": pairs.variable(*(theme.rule for theme in themes)),
        "curves": curves,
    }


# The page itself: one HTML file with the picture, its motion, and the script that moves it.

_POLICY = (
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src '{script}'; base-uri 'none'; "
    "form-action 'none'"
)
"""What a page may load: nothing but its own style and the one script that it comes with."""
LARGEST = 200_000
"""The most bytes of a page."""
_WIDTH, _HEIGHTS = 960, (480, 900)


@frozen
class Shared:
    """What a page is asked to show: a scene, its speed (rad/s), a quantity to chart, names 0 to 2.

    Without a speed it is the scene's own; without a theme the page follows its reader's setting.
    """

    scene: Scene
    speed: float | None = None
    theme: ThemeName | None = None
    chart: str | None = None
    names: int = 0

    @property
    def themes(self) -> tuple[ThemeName, ThemeName]:
        """The themes of a page for its reader's settings, light and dark; a stated one twice."""
        return (self.theme, self.theme) if self.theme else ("light", "dark")


def document(shared: Shared, tell: Callable[[str], None] | None = None) -> str:
    """Return the page as HTML, which loads nothing.

    Where there is no room for both closures it has one, says so, and `tell` hears of it. BadInput for
    a chart of no quantity of the scene, for a speed of zero, and where the page would be larger than
    `LARGEST`: its gears take very many turns to be back, or it has very many joints and bodies.
    """
    scene = shared.scene
    if shared.speed == 0:
        raise BadInput("--speed: at 0 nothing moves; give a speed such as 20 rpm, clockwise negative")
    size = _size(scene)
    both = [_drawn(shared, one, size) for one in (scene, ghost_of(scene)) if one]
    page = _whole(shared, size, both)
    if len(both) > 1 and len(page.encode()) > LARGEST:
        left_out = said(
            "The other closure is not on this page: both would take {size} kB, and {most} kB is the most.",
            size=f"{len(page.encode()) / 1000:.0f}",
            most=f"{LARGEST / 1000:.0f}",
        )
        page = _whole(shared, size, both[:1], left_out)
        if tell:
            tell(f"{scene.name}: {left_out}")
    if len(page.encode()) > LARGEST:
        kilobytes = len(page.encode()) / 1000
        raise BadInput(
            f"{scene.name}: a page of it would take {kilobytes:.0f} kB, "
            f"and {LARGEST / 1000:.0f} kB is the most; {_why_large(scene)}"
        )
    return page


def _why_large(scene: Scene) -> str:
    """Return what makes a page of a scene large, and what would make it smaller."""
    linkage, turns = scene.linkage, scene.info.true_period
    if turns > 1 and any(isinstance(joint, Crank) and joint.gear for joint in linkage.joints):
        return f"it is back after {turns} turns: a gear ratio of smaller numbers makes them fewer"
    count = f"{len(linkage.joints)} joints and {len(linkage.bodies)} bodies"
    return f"it has {count}: share a scene of fewer, or record it"


def _drawn(shared: Shared, scene: Scene, size: tuple[int, int]) -> tuple[Picture, Picture]:
    """Return the pictures of a closure, light and dark."""
    look = Look(names=shared.names, hud=False)
    light, dark = (replace(look, theme=name) for name in shared.themes)
    picture = Picture(scene, size, light, apart=True)
    return picture, Picture(scene, size, dark, apart=True)


def _whole(
    shared: Shared, size: tuple[int, int], closures: Sequence[tuple[Picture, Picture]], left_out: str = ""
) -> str:
    scene, pairs = shared.scene, Pairs()
    sides = [_Side(shared, *drawn, pairs) for drawn in closures]
    known: dict[str, str] = {}
    shapes = "\n".join(side.markup(n, known) for n, side in enumerate(sides))
    page = {
        "period": scene.period,
        "retraced": scene.mechanism.retraced,
        "way": None if scene.mechanism.way is None else round(begin_of(scene) / pi),
        "speed": shared.speed or scene.linkage.drive.speed,
        "unit": scene.length_unit,
        "input": input_words(scene),
        "theme": shared.theme,
        "links": {name: word for name, word in link_words(scene).items() if name != word},
        "called": dict(_centres_called(scene)),
        "sides": [side.data() for side in sides],
    }
    script = "\n".join(map(_bare, map(packaged, ("shapes.js", "solver.js", "lengths.js", "page.js"))))
    page["said"] = {text: said(text) for text in script_words(script) if said(text) != text}
    page = _short(page)
    if lengths := sides[0].model():
        page["model"] = lengths  # in all its digits: it is solved, not only drawn
    sheet = pairs.styles(shared.themes, shared.theme)
    kind = scene.info.class_said
    digest = "sha256-" + base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    about = sentences(said("{found}.", found=f"{kind[:1].upper()}{kind[1:]}"), said(scene.look_at), left_out)
    return in_language(packaged("page.html")).substitute(
        lang=html_language(),
        policy=_POLICY.format(script=digest),
        title=escape(said(scene.title)),
        about=escape(about),
        styles="\n".join((sheet, packaged("page.css"))),
        faces=FACES,
        view=f"0 0 {size[0]} {size[1]}",
        shapes=shapes,
        data=json.dumps(page, ensure_ascii=False, separators=(",", ":")).replace("<", "\\u003c"),
        script=script,
    )


def _centres_called(scene: Scene) -> Iterator[tuple[str, str]]:
    """Yield the name of each centre of mass that is another one in the language that is spoken."""
    for name, word in link_words(scene).items():
        if word != scene.info.link_names[name]:
            yield centre(name), said("{part}, centre of mass", part=word)


_IN_SCRIPT, _IN_PAGE = re.compile(r'\bsaid\("([^"]+)"'), re.compile(r"\{\{(.+?)\}\}")


def script_words(script: str) -> list[str]:
    """Return the sentences that a script says, which it looks up in its page."""
    return list(dict.fromkeys(_IN_SCRIPT.findall(script)))


def page_words(page: str) -> list[str]:
    """Return the sentences of a page's template: they stand in two braces."""
    return _IN_PAGE.findall(page)


def in_language(page: str) -> Template:
    """Return a page's template with its sentences in the language that is spoken."""
    return Template(_IN_PAGE.sub(lambda found: escape(said(found[1])), page))


def _bare(script: str) -> str:
    """Return a script without its comments and indents, which would take a twentieth of the largest page."""
    lines = (line.partition("  // ")[0].strip() for line in script.splitlines())
    return "\n".join(line for line in lines if line and not line.startswith("//"))


def _size(scene: Scene) -> tuple[int, int]:
    """Return a picture's size in pixels, in the shape of the scene, within bounds."""
    box = figure(scene).box
    wide, high = box.right - box.left, box.high - box.low
    low, tall = _HEIGHTS
    return _WIDTH, round(min(max(_WIDTH * high / wide, low), tall)) if wide > 0 else tall


class _Side:
    """One of a scene's closures on a page."""

    def __init__(self, shared: Shared, light: Picture, dark: Picture, pairs: Pairs) -> None:
        self._shared, self._scene, self._pairs = shared, light.scene, pairs
        self._picture, self._dark = light, dark
        pulled = forces(light, dark, shared.speed or self._scene.linkage.drive.speed, pairs)
        self._movables = tuple(Mobile(light, dark, pairs, pulled).movables())

    def markup(self, number: int, known: dict[str, str]) -> str:
        """Return its groups, hidden unless it is the first; shapes that are `known` are used again."""
        moving = count()
        groups = "".join(one.markup(moving, known) for one in self._movables)
        return f"<g id='side{number}'{' hidden' if number else ''}>{groups}</g>"

    def model(self) -> dict[str, Any] | None:
        """Return the linkage for the page's solver, for other lengths; None where that cannot solve it."""
        own_model = model(self._scene)
        if own_model is None:
            return None
        return {**own_model, "unit": self._scene.length_unit, "masses": self._masses()}

    def _masses(self) -> dict[str, Any]:
        """Return each centre of mass as shares of the way between two joints, along it and to its right.

        It keeps them where lengths are changed. One on a single joint is so many pixels off it.
        """
        places = self._scene.pose(0.0, 0).com_position
        return {centre(body): shares_of(self._picture, body, at) for body, at in places.items()}

    def data(self) -> dict[str, Any]:
        """Return the closure's data for the page's script."""
        scene, view, shared = self._scene, self._picture.view, self._shared
        speed = shared.speed or scene.linkage.drive.speed
        themes, token = (self._picture.theme, self._dark.theme), shared.chart
        return {
            "name": closure_name(scene),
            "view": [view.scale, view.x, view.y],
            "drive": scene.linkage.drive.joint,
            "joints": list(self._picture.figure.in_view),
            "tracks": {name: track.packed for name, track in tracks(scene, view).items()},
            "movers": [one.mover for one in self._movables if one.mover],
            "rows": list(rows(scene, speed)),
            "charts": charts(self._picture.figure, themes, (token, speed), self._pairs) if token else [],
        }


def _short(value: Any) -> Any:
    """Return a document with its numbers to seven digits."""
    match value:
        case float():
            return float(f"{value:.7g}")
        case dict():
            return {key: _short(one) for key, one in value.items()}
        case list() | tuple():
            return [_short(one) for one in value]
    return value


@cache
def packaged(name: str) -> str:
    """Return the text of a file of this room."""
    return Path(__file__).with_name(name).read_text(encoding="utf-8")
