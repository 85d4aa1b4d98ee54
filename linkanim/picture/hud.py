"""The head-up display: what scene it is, and the numbers of this instant, in words."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from math import degrees, floor, inf, log10, pi, tau
from typing import NamedTuple

import pygame

from linkanim.digits import stepped
from linkanim.mechanics.motion import Pose
from linkanim.picture.driven import driven_name, sign_of, speed_in, speed_unit, speed_words
from linkanim.picture.layout import Layout
from linkanim.picture.raster import Colour
from linkanim.picture.text import Type
from linkanim.picture.theme import Theme, mixed
from linkanim.picture.view import Rect
from linkanim.scenes.scene import Scene

_NEAR_LIMIT = 0.06 * pi
"""How near to a limit, in phase, the HUD says so: there the input has 1 % of its swing left."""
_NEAR_CHANGE = pi / 45
_HELD, _EASED = 0.2, 0.5
"""How long a note stands before and after the instant it is about, and how long it comes and goes, in s."""
_READ = 0.36
"""A note is not read where the next follows in this time (s), and well where it does in twice of it."""
_STEP = 1.42
"""From row to row, in heights of their text."""
_TRIED = 24
_SMALLEST = 9


class Line(NamedTuple):
    """A line that stands still: its text, top, size, colour and weight."""

    text: str
    y: float
    size: int
    colour: Colour
    strong: bool


class Row(NamedTuple):
    """A name and its value; the name stays while the value moves."""

    label: str
    value: str


def rows(scene: Scene, pose: Pose) -> tuple[Row, ...]:
    """Return the numbers of a pose: the same names in the same order at every pose of a scene.

    The input's speed is the pose's: of an input that swings, how often it does and its angular velocity
    at this instant. Speeds are in the unit that the scene states its own in; forces appear where they are
    known; lengths are in the scene's unit, forces in newtons, tension positive.
    """
    return (*_input_rows(scene, pose), *_strut_rows(scene, pose))


def _input_rows(scene: Scene, pose: Pose) -> Iterator[Row]:
    info, name = scene.info, f"{driven_name(scene)} angle"
    if info.full_turn:
        yield Row(name, _turned(pose.crank_angle))
        yield Row("input speed", speed_words(scene, pose.input_speed))
    else:
        low, high = info.input_range
        yield Row(name, _deg(pose.crank_angle))
        yield Row("input range", f"{_deg(low)}…{_deg(high)}")
        yield Row("input rate", speed_words(scene, pose.input_speed))
        yield Row("angular velocity", _live(scene, pose))
    if info.true_period != 1:
        yield Row("true period", f"{info.true_period} turns")


def _live(scene: Scene, pose: Pose) -> str:
    """Return the driven bar's angular velocity in words, always with as many decimals."""
    unit = speed_unit(scene)
    largest = abs(speed_in(unit, scene.linkage.drive.speed))
    step = 10.0 ** (floor(log10(largest)) - 2)
    return f"{stepped(speed_in(unit, pose.crank_rate), step)} {sign_of(unit)}"


def _strut_rows(scene: Scene, pose: Pose) -> Iterator[Row]:
    unit = scene.length_unit
    for name, spring in pose.spring.items():
        yield Row(f"spring {name}", f"{stepped(spring.length, 0.1)} {unit}")
        if spring.force is not None:
            yield Row("spring force", f"{stepped(spring.force, 0.1)} N")
    for name, damper in pose.damper.items():
        yield Row(f"damper {name}", f"{stepped(damper.rate or 0.0, 0.1)} {unit}/s")
        if damper.force is not None:
            yield Row("damper force", f"{stepped(damper.force, 0.1)} N")


class Note(NamedTuple):
    """What is special about a pose, and how clearly it is said, in eighths: 0 is not at all."""

    words: str
    eighths: int


def note(scene: Scene, pose: Pose) -> Note:
    """Return what is special here: the nearest limit of the input or change point.

    It is eased in before and out after, in time as in angle, and gives way where another is as near.
    Where they follow each other too fast to be read, none is said.
    """
    known = [(_nearness(pose, away, near), words) for away, near, words in _special(scene, pose)]
    (most, words), (next_most, _), *_ = (*sorted(known, reverse=True), (0.0, ""), (0.0, ""))
    pause = tau / max(len(known), 1) / abs(pose.input_speed) if pose.input_speed else inf
    return Note(words, round(8 * (most - next_most) * eased(pause / _READ - 1.0)))


def _nearness(pose: Pose, away: float, near: float) -> float:
    """Return 1 at a special phase, 0 far `away` (rad of phase), eased between, at the speed it runs by."""
    by_angle = eased(2.0 - 2.0 * away / near)
    seconds = away / abs(pose.input_speed) if pose.input_speed else inf
    return max(by_angle, eased(1.0 + (_HELD - seconds) / _EASED))


def eased(share: float) -> float:
    """Return 0 up to 0, 1 from 1 on, and a smooth step between."""
    share = min(max(share, 0.0), 1.0)
    return share * share * (3.0 - 2.0 * share)


def _special(scene: Scene, pose: Pose) -> Iterator[tuple[float, float, str]]:
    """Yield the input's limits and change points: how far away, how far is near (rad of phase), in words."""
    info = scene.info
    if not info.full_turn:
        for limit, at in zip(info.input_range, (0.0, pi), strict=True):
            yield _apart(pose.phase, at), _NEAR_LIMIT, f"near the limit {_deg(limit)}"
    for point in info.change_points:
        yield _apart(pose.crank_angle, point), _NEAR_CHANGE, f"near the change point {_turned(point)}"


def _deg(angle: float) -> str:
    return f"{stepped(degrees(angle), 0.1)}°"


def _turned(angle: float) -> str:
    """Return an angle within one turn, rounded first, so that none reads 360°."""
    return f"{stepped(round(degrees(angle) % 360, 1) % 360, 0.1)}°"


def _apart(one: float, other: float) -> float:
    return abs((one - other + pi) % tau - pi)


@dataclass(frozen=True)
class Hud:
    """Where the HUD's lines stand: what keeps still is drawn once, on a sheet, values at every frame."""

    scene: Scene
    layout: Layout
    said: frozenset[str]
    """All that its rows ever say."""
    column: Rect
    lines: tuple[Line, ...]
    """The title's and the class's."""
    first: float
    """The top of the first row."""
    size: int
    type: Type
    theme: Theme

    @cached_property
    def sheet(self) -> pygame.Surface:
        """What stands still, on nothing: title, class and the names of the rows."""
        sheet = pygame.Surface((round(self.column.right), round(self.column.bottom)), pygame.SRCALPHA, 32)
        for line in self.lines:
            at = (self.column.x, line.y)
            self.type.draw(sheet, line.text, at, size=line.size, colour=line.colour, strong=line.strong)
        for n, row in enumerate(rows(self.scene, self.scene.pose(0.0))):
            self.type.draw(sheet, row.label, self._place(n), size=self.size, colour=self.theme.dim)
        return sheet.subsurface(sheet.get_bounding_rect())

    def draw_values(self, surface: pygame.Surface, pose: Pose, *, noted: bool) -> None:
        """Draw the values of a pose, and where it is to be `noted`, what is special there."""
        values, ink = rows(self.scene, pose), self.theme.ink
        for n, row in enumerate(values):
            at = (self.column.right, self._place(n)[1])
            self.type.draw(surface, row.value, at, size=self.size, colour=ink, anchor="right", strong=True)
        words, eighths = note(self.scene, pose) if noted else ("", 0)
        colour = mixed(self.theme.background, self.theme.dim, eighths / 8)
        for n, line in enumerate(self._wrapped(words) if eighths else (), start=len(values)):
            self.type.draw(surface, line, self._place(n + 0.4), size=self.size, colour=colour)

    @property
    def holds(self) -> bool:
        """Whether all that it says is no wider than the column, and the last row and the note stand in it."""
        pose = self.scene.pose(0.0)
        notes = max((len(self._wrapped(words)) for *_, words in _special(self.scene, pose)), default=0)
        last = len(rows(self.scene, pose)) + (notes - 0.6 if notes else -1.0)
        low = self._place(last)[1] + self.size
        wide = max(self.type.width(line, self.size, strong=True) for line in self.said)
        return low <= self.column.bottom and wide <= self.column.width

    def _wrapped(self, words: str) -> list[str]:
        return self.type.wrapped(words, self.size, self.column.width)

    def _place(self, row: float) -> tuple[float, float]:
        return self.column.x, self.first + _STEP * self.size * row


def hud_for(
    scene: Scene, layout: Layout, type_: Type, theme: Theme, *, before: Hud | None = None
) -> Hud | None:
    """Return the HUD of a scene in a window, None where the window has no column for it.

    Its text is as large as lets all that it ever says stand in the column. `before` is the HUD of the
    picture before this one: it stays where nothing that it depends on has changed. Of a scene on the way to
    another it is the other's already.
    """
    if layout.hud is None:
        return None
    scene = scene.towards or scene
    known = before is not None and before.scene is scene
    if before and known and (before.layout, before.theme) == (layout, theme):
        return before
    said = before.said if before and known else _ever_said(scene)
    empty = Hud(scene, layout, said, layout.hud, (), 0.0, layout.text_size, type_, theme)
    sizes = range(layout.text_size, _SMALLEST - 1, -1)
    huds = (_titled(empty, size, size * layout.title_size / layout.text_size) for size in sizes)
    found = empty
    for found in huds:
        if found.holds:
            break
    return found


def _titled(hud: Hud, size: int, title: float) -> Hud:
    """Return the HUD with its rows at one text size, below title and class."""
    lines, y = [], hud.column.y
    scene, big, theme = hud.scene, round(title), hud.theme
    name = scene.title if hud.type.width(scene.title, big) else scene.name
    for text, high, colour, strong in (
        (name, big, theme.ink, True),
        (scene.info.class_name, size, theme.dim, False),
    ):
        for line in hud.type.wrapped(text, high, hud.column.width, strong=strong):
            lines.append(Line(line, y, high, colour, strong))
            y += 1.15 * high
    return replace(hud, lines=tuple(lines), first=y + 0.9 * size, size=size)


def _ever_said(scene: Scene) -> frozenset[str]:
    """Return the rows' texts over the whole cycle."""
    poses = [scene.pose(scene.period * step / _TRIED) for step in range(_TRIED)]
    return frozenset(f"{row.label}  {row.value}" for pose in poses for row in rows(scene, pose))
