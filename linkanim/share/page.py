"""The page itself: one HTML file with the picture, its motion, and the script that moves it."""

from __future__ import annotations

import base64
import hashlib
import json
from dataclasses import dataclass, replace
from functools import cache
from html import escape
from importlib.resources import files
from itertools import count
from string import Template
from typing import Any

from linkanim.errors import BadInput
from linkanim.mechanics.linkage.pins import Crank
from linkanim.paper.svg import FACES
from linkanim.picture.figure import figure
from linkanim.picture.look import ACCELERATION, VELOCITY, Look, ThemeName
from linkanim.picture.picture import Picture
from linkanim.scenes.editing.closures import closure_name, ghost_of
from linkanim.scenes.scene import Scene
from linkanim.share.figures import CHART, charts, input_words, parts_of, rows
from linkanim.share.movers import Mobile
from linkanim.share.pairs import Pairs
from linkanim.share.tracks import packed_tracks, tracks

_POLICY = (
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src '{script}'; base-uri 'none'; "
    "form-action 'none'"
)
"""What a page may load: nothing but its own style and the one script that it comes with."""
LARGEST = 200_000
"""Bytes of a page at the most."""
_SHARED = 200
"""Bytes from which on shapes that come again are used again."""
_TALL = 0.8
"""How high for its width a picture is that has its chart beside it."""
_WIDTH, _HEIGHTS = 960, (480, 900)


@dataclass(frozen=True)
class Shared:
    """What a page is asked to show: a scene at a speed (rad/s; its own), a quantity's chart, names 0 to 2.

    Without a theme it goes by its reader's setting.
    """

    scene: Scene
    speed: float | None = None
    theme: ThemeName | None = None
    chart: str | None = None
    names: int = 0

    @property
    def themes(self) -> tuple[ThemeName, ThemeName]:
        """The themes of a page by its reader's setting, light and dark; twice the one that is stated."""
        return (self.theme, self.theme) if self.theme else ("light", "dark")


def document(shared: Shared) -> str:
    """Return the page as HTML, which loads nothing; one closure alone where there is no room for both.

    BadInput for a chart of no quantity of the scene, for a speed of zero, and where the page would be larger
    than `LARGEST`: its gears take very many turns to be back, or it has very many joints and bodies.
    """
    scene = shared.scene
    if shared.speed == 0:
        raise BadInput("--speed: at 0 nothing moves; give a speed such as 20 rpm, clockwise negative")
    both = tuple(one for one in (scene, ghost_of(scene)) if one)
    page = _whole(shared, both)
    if len(both) > 1 and len(page.encode()) > LARGEST:
        page = _whole(shared, both[:1])
    if len(page.encode()) > LARGEST:
        size = len(page.encode()) / 1000
        raise BadInput(
            f"{scene.name}: a page of it would take {size:.0f} kB, and {LARGEST / 1000:.0f} kB is the most; "
            f"{_why_large(scene)}"
        )
    return page


def _why_large(scene: Scene) -> str:
    """Return what makes a page of a scene large, and what would make it smaller."""
    linkage, turns = scene.linkage, scene.info.true_period
    if turns > 1 and any(isinstance(joint, Crank) and joint.gear for joint in linkage.joints):
        return f"it is back after {turns} turns: a gear ratio of smaller numbers makes them fewer"
    count = f"{len(linkage.joints)} joints and {len(linkage.bodies)} bodies"
    return f"it has {count}: share a scene of fewer, or record it"


def _whole(shared: Shared, closures: tuple[Scene, ...]) -> str:
    scene, pairs, size = shared.scene, Pairs(), _size(shared.scene)
    sides = [_Side(shared, one, size, pairs) for one in closures]
    known: dict[str, str] = {}
    shapes = "\n".join(side.markup(n, known) for n, side in enumerate(sides))
    found = {
        "period": scene.period,
        "retraced": scene.mechanism.retraced,
        "parts": parts_of(scene),
        "speed": shared.speed or scene.linkage.drive.speed,
        "unit": scene.length_unit,
        "input": input_words(scene),
        "theme": shared.theme,
        "sides": [side.data() for side in sides],
    }
    sheet = pairs.styles(shared.themes, shared.theme)
    script, kind = packaged("page.js"), scene.info.class_name
    digest = "sha256-" + base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    return Template(packaged("page.html")).substitute(
        policy=_POLICY.format(script=digest),
        title=escape(scene.title),
        about=escape(f"{kind[:1].upper()}{kind[1:]}. {scene.look_at}".strip()),
        styles="\n".join((sheet, packaged("page.css"))),
        faces=FACES,
        view=f"0 0 {size[0]} {size[1]}",
        shape="tall" if size[1] > _TALL * size[0] else "wide",
        chart=f"0 0 {CHART[0]} {CHART[1]}",
        shapes=shapes,
        data=json.dumps(_short(found), ensure_ascii=False, separators=(",", ":")).replace("<", "\\u003c"),
        script=script,
    )


def _size(scene: Scene) -> tuple[int, int]:
    """Return a picture's size in pixels, as high as the scene is for its width, within bounds."""
    box = figure(scene).box
    wide, high = box.right - box.left, box.high - box.low
    low, tall = _HEIGHTS
    return _WIDTH, round(min(max(_WIDTH * high / wide, low), tall)) if wide > 0 else tall


class _Side:
    """One of a scene's closures on a page."""

    def __init__(self, shared: Shared, scene: Scene, size: tuple[int, int], pairs: Pairs) -> None:
        look = Look(names=shared.names, hud=False, vectors=frozenset((VELOCITY, ACCELERATION)))
        light, dark = (replace(look, theme=name) for name in shared.themes)
        self._shared, self._scene, self._pairs = shared, scene, pairs
        self._picture = Picture(scene, size, light, apart=True)
        other = Picture(scene, size, dark, self._picture, apart=True)
        self._dark, self._movables = other, tuple(Mobile(self._picture, other, pairs).movables())

    def markup(self, number: int, known: dict[str, str]) -> str:
        """Return its groups, those that move numbered; hidden but for the first.

        Shapes that are `known`, by the name of the group that has them, are used again.
        """
        moving, groups = count(), ""
        for one in self._movables:
            placed = f' transform="{one.transform}"' if one.transform else ""
            numbered = f' data-m="{next(moving)}"' if one.mover else ""
            groups += f"<g{placed}{numbered}>{_once(one.shapes, known)}</g>"
        return f"<g id='side{number}'{' hidden' if number else ''}>{groups}</g>"

    def data(self) -> dict[str, Any]:
        """Return what its script knows of it."""
        scene, view, shared = self._scene, self._picture.view, self._shared
        speed = shared.speed or scene.linkage.drive.speed
        themes, token = (self._picture.theme, self._dark.theme), shared.chart
        return {
            "name": closure_name(scene),
            "view": [view.scale, view.x, view.y],
            "drive": scene.linkage.drive.joint,
            "joints": list(self._picture.figure.shown),
            "tracks": packed_tracks(tracks(scene, view)),
            "movers": [one.mover for one in self._movables if one.mover],
            "rows": list(rows(scene, speed)),
            "charts": charts(self._picture.figure, themes, (token, speed), self._pairs) if token else [],
        }


def _once(shapes: str, known: dict[str, str]) -> str:
    """Return shapes, or what uses the same ones again."""
    if shapes in known:
        return f'<use href="#{known[shapes]}"/>'
    if len(shapes) < _SHARED:
        return shapes
    known[shapes] = f"s{len(known)}"
    return f'<g id="{known[shapes]}">{shapes}</g>'


def _short(value: Any) -> Any:
    """Return a document with its numbers to nine digits."""
    match value:
        case float():
            return float(f"{value:.9g}")
        case dict():
            return {key: _short(one) for key, one in value.items()}
        case list() | tuple():
            return [_short(one) for one in value]
    return value


@cache
def packaged(name: str) -> str:
    """Return the text of a file of this room."""
    return files("linkanim.share").joinpath(name).read_text(encoding="utf-8")
