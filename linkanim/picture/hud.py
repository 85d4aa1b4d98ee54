"""Tell about a scene in words: its title, its numbers of this instant, the key to its colours.

`rows_of` has the rows of numbers, `note` what is special about a pose. `Hud` draws them. The legend says how
much an arrow of its length stands for. An arrangement places the words as blocks.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property, partial
from itertools import zip_longest
from math import degrees, floor, inf, log10, pi, tau
from typing import TYPE_CHECKING, NamedTuple

from linkanim.frozen import frozen
from linkanim.mechanics.forces import effort_token
from linkanim.mechanics.motion import Pose
from linkanim.mechanics.quantities import Quantity, register
from linkanim.picture.items import Caption, Group, Item, Target, grouped
from linkanim.picture.layout import Layout
from linkanim.picture.look import Look
from linkanim.picture.motion_marks import Arrows
from linkanim.picture.quantities import (
    driven_name,
    driven_words,
    round_below,
    sign_of,
    speed_in,
    speed_teller,
    speed_unit,
)
from linkanim.picture.raster import Colour, Layer
from linkanim.picture.shapes import arrows, disc
from linkanim.picture.text import Type
from linkanim.picture.theme import Theme
from linkanim.picture.view import Rect, eased
from linkanim.scenes.editing import beyond_title
from linkanim.scenes.scene import Scene
from linkanim.units import stepped, three_digits
from linkanim.words import name_said, said, to_say

if TYPE_CHECKING:
    from linkanim.picture.ink import InkScale

# What the HUD says about a pose: its rows of numbers, and what is special about it.

_NEAR_LIMIT = 0.06 * pi
"""How near to a limit, in phase, the readout notes it: there 1 % of the input's swing is left."""
_NEAR_CHANGE = pi / 45
_HELD, _EASED = 0.2, 0.5
"""How long a note stands before and after its instant, and how long it fades in and out, in s."""
_READ = 0.36
"""A note cannot be read if the next one follows within this time (s); after twice this time it can."""


class Reading(NamedTuple):
    """A name and its value; the name stays the same while the value changes."""

    label: str
    value: str


class Row(NamedTuple):
    """A name, and the function from a pose to its value in words, None where it is not known.

    Rows of the highest ranks are the first to be left out where there is no room.
    """

    rank: int
    label: str
    value: Callable[[Pose], str | None]


def rows(scene: Scene, pose: Pose) -> tuple[Reading, ...]:
    """Return the numbers of a pose: the same names in the same order at every pose of a scene."""
    return tuple(row for _, row in ranked(rows_of(scene), pose))


def ranked(known: Iterable[Row], pose: Pose) -> Iterator[tuple[int, Reading]]:
    """Yield what rows tell of a pose, each with its rank."""
    for rank, label, value in known:
        words = value(pose)
        if words is not None:
            yield rank, Reading(label, words)


def rows_of(scene: Scene) -> tuple[Row, ...]:
    """Return the rows of a scene; parts that are the same at every pose are put into words only once.

    The input's speed is that of the pose; an input that swings has its swings per minute and its angular
    velocity at this instant. Speeds are in the unit in which the scene states its own. Forces appear where
    they are known, in newtons, tension positive. A damper without a coefficient is a cylinder, with its
    length. Lengths are in the scene's unit.
    """
    return *_input_rows(scene), *(one.row(scene.length_unit) for one in measured(scene))


def _input_rows(scene: Scene) -> Iterator[Row]:
    info, name, at_speed = scene.info, driven_name(scene), speed_teller(scene)
    if info.full_turn:
        yield Row(0, name, lambda pose: _turned(pose.coordinate))
        yield Row(1, said("input speed"), lambda pose: at_speed(pose.input_speed))
    else:
        across = "…".join(driven_words(scene, end) for end in info.input_range)
        yield Row(0, name, lambda pose: driven_words(scene, pose.coordinate))
        yield Row(5, said("input range"), lambda _: across)
        if info.kept:
            back = said("same closure")
            if not scene.mechanism.retraced:
                back = said("same closure at {place}", place=driven_words(scene, info.kept[0]))
            yield Row(5, said("returns"), lambda _: back)
        yield Row(1, said("input rate"), lambda pose: at_speed(pose.input_speed))
        yield Row(3, _driven_rate(scene), _live(scene))
    if info.true_period != 1:
        turns = said("{count} turns", count=info.true_period)
        yield Row(6, said("true period"), lambda _: turns)


def _driven_rate(scene: Scene) -> str:
    """Return what the rate of the input's coordinate is called: angular velocity, slider velocity."""
    noun, measure = scene.linkage.drive.actuator.noun, said(scene.linkage.drive.coordinate.velocity)
    return said("{link} {measure}", link=name_said(noun), measure=measure) if noun else measure


def _live(scene: Scene) -> Callable[[Pose], str]:
    """Return what words the driven bar's angular velocity, or the slider's velocity, with fixed decimals."""
    known = register(scene.linkage)
    coordinate = scene.linkage.drive.coordinate
    read = known[coordinate.rate_token].read
    if not coordinate.is_angle:
        return lambda pose: f"{stepped(read(pose), scene.length_step)} {scene.length_unit}/s"
    unit = speed_unit(scene)
    largest = abs(speed_in(unit, scene.linkage.drive.speed))
    step = 10.0 ** (floor(log10(largest)) - 2)
    return lambda pose: f"{stepped(speed_in(unit, read(pose)), step)} {sign_of(unit)}"


class MeasuredRow(NamedTuple):
    """A row that shows a quantity rounded to a step."""

    rank: int
    label: str
    quantity: Quantity
    step: float

    def row(self, length_unit: str) -> Row:
        """Return the row that puts the quantity into words; None where it is not known."""
        unit = self.quantity.display_unit(length_unit)

        def value(pose: Pose) -> str | None:
            value = self.quantity.displayed(pose)
            return None if value is None else f"{stepped(float(value), self.step)} {unit}"

        return Row(self.rank, self.label, value)


def measured(scene: Scene) -> Iterator[MeasuredRow]:
    """Yield the quantities in a scene's rows: those of its struts, and what the input has to deliver."""
    yield from _of_struts(scene)
    usual = scene.info.usual_effort
    if usual is not None:
        step = 10.0 ** (floor(log10(usual)) - 2) if usual > 0 else 0.1
        quantity = register(scene.linkage)[effort_token(scene.linkage)]
        words = said("input {effort}", effort=said(scene.info.effort[0]))
        yield MeasuredRow(2, words, quantity, step)


def _of_struts(scene: Scene) -> Iterator[MeasuredRow]:
    linkage, known = scene.linkage, register(scene.linkage)
    for item in linkage.springs + linkage.dampers:
        word = linkage.strut_word(item)
        part = to_say("rate") if word == "damper" else to_say("length")
        words = said("{strut}, {measure}", strut=linkage.strut_words(item), measure=said(part))
        yield MeasuredRow(4, words, known[f"{item.name}.{part}"], scene.length_step)
        if item.forceful:
            words = said("spring force") if word == "spring" else said("damper force")
            yield MeasuredRow(2, words, known[f"{item.name}.force"], 0.1)
    # where its length is the input, the row of the input says it
    if linkage.drive.actuator.along is not None and linkage.drive.coordinate.is_angle:
        yield MeasuredRow(2, said("driving cylinder"), known["input.length"], scene.length_step)


def charted(scene: Scene) -> dict[str, str]:
    """Return the tokens of rows' quantities by the rows' labels: a click on a row charts its quantity."""
    linkage = scene.linkage
    drive, coordinate = linkage.drive, linkage.drive.coordinate
    cranks = (body for body in linkage.bodies if linkage.crank_of(body) and drive.joint in body.joints)
    sliders = (body for body in linkage.bodies if body.slider == drive.joint)
    driven = next((body.name for body in (cranks if coordinate.is_angle else sliders)), "")
    tokens = {driven_name(scene): f"{driven}.{coordinate.name}", _driven_rate(scene): coordinate.rate_token}
    tokens |= {one.label: one.quantity.token for one in measured(scene)}
    return {label: token for label, token in tokens.items() if token in scene.quantities}


def note(special: Sequence[Special], pose: Pose) -> str:
    """Return what is special at a pose: the nearest limit of the input, or change point; else "".

    It gives way where another place is as near. Where notes would follow each other too fast to be read,
    there is none.
    """
    if not special:
        return ""
    known = [
        (_nearness(pose, _apart(pose.phase if by_phase else pose.coordinate, at), near), words)
        for by_phase, at, near, words in special
    ]
    (most, words), (next_most, _), *_ = (*sorted(known, reverse=True), (0.0, ""))
    pause = tau / len(known) / abs(pose.input_speed) if pose.input_speed else inf
    return words if most - next_most >= 0.5 and pause >= 1.5 * _READ else ""


def _nearness(pose: Pose, away: float, near: float) -> float:
    """Return 1 at a special phase, 0 far `away` from it (rad), smooth in between, for the pose's speed."""
    by_angle = eased(2.0 - 2.0 * away / near)
    seconds = away / abs(pose.input_speed) if pose.input_speed else inf
    return max(by_angle, eased(1.0 + (_HELD - seconds) / _EASED))


Special = tuple[bool, float, float, str]
"""A special place: whether a phase (rad), else the input's coordinate; from how far it is near; its words."""


def special_places(scene: Scene) -> Iterator[Special]:
    """Yield the input's limits and change points."""
    info = scene.info
    if not info.full_turn:
        for limit, at in zip(info.ends, (0.0, pi), strict=True):
            yield True, at, _NEAR_LIMIT, said("near the limit {place}", place=driven_words(scene, limit))
    for point in info.change_points if scene.linkage.drive.coordinate.is_angle else ():
        yield False, point, _NEAR_CHANGE, said("near the change point {place}", place=_turned(point))


def _turned(angle: float) -> str:
    """Return an angle within one turn in words; it is rounded first, so that none reads 360°."""
    return f"{stepped(round(degrees(angle) % 360, 1) % 360, 0.1)}°"


def _apart(one: float, other: float) -> float:
    return abs((one - other + pi) % tau - pi)


# The head-up display: the scene's title, and the numbers of this instant, in words.

STEP = 1.4
"""The step from row to row, in heights of their text."""


@frozen
class WordBlock:
    """The column of words; all places are measured from its top left corner."""

    size: int
    """The height of the readout's text."""
    title_size: int = 0
    title: tuple[str, ...] = ()
    """The lines of the title."""
    classes: tuple[str, ...] = ()
    """The lines of the class, below it."""
    rows: frozenset[str] = frozenset()
    """The names of the rows that are shown."""
    first: float = 0.0
    """The top of the first row."""
    note: float = 0.0
    """The top of the note on what is special."""
    key: float = 0.0
    """The top of the legend: the key to the colours, and below it what is listed."""
    width: float = 0.0
    height: float = 0.0

    @property
    def lines(self) -> Iterator[tuple[str, float]]:
        """The lines of title and class, each with its top; at last "" with their foot."""
        y = 0.0
        for text in self.title:
            yield text, y
            y += 1.12 * self.title_size
        y += 0.1 * self.size if self.title else 0.0
        for text in self.classes:
            yield text, y
            y += 1.2 * self.size
        yield "", y


@frozen
class Hud:
    """The words about a scene in their place: still words are drawn once, values at every frame."""

    scene: Scene
    block: WordBlock
    place: Rect
    type: Type
    theme: Theme

    @cached_property
    def still(self) -> Group:
        """The words that stand still; a click is for a row by its label, or for the class by ""."""
        captions, targets, place, size = list[Caption](), list[Target](), self.place, self.block.size
        for n, (text, down) in enumerate(self.block.lines):
            at = place.x, place.y + down
            if n < len(self.block.title):
                captions.append(Caption(text, at, self.block.title_size, self.theme.ink, strong=True))
            elif text:
                captions.append(Caption(text, at, size, self.theme.dim))
                targets.append(Target("reading", place._replace(y=at[1], height=1.2 * size), ""))
        for n, (_, row) in enumerate(ranked(self._rows, self.scene.pose(0.0))):
            captions.append(Caption(row.label, (place.x, self._top(n)), size, self.theme.dim))
            around = place._replace(y=self._top(n) - 0.1 * STEP * size, height=STEP * size)
            targets.append(Target("reading", around, row.label))
        return Group("words", (), captions, targets=tuple(targets))

    def values(self, pose: Pose) -> list[Caption]:
        """Return the numbers of a pose beside them."""
        size, right = self.block.size, self.place.right
        return [
            Caption(row.value, (right, self._top(n)), size, self.theme.ink, "right", strong=True)
            for n, (_, row) in enumerate(ranked(self._rows, pose))
        ]

    @cached_property
    def _rows(self) -> tuple[Row, ...]:
        """The rows that are shown."""
        return tuple(row for row in rows_of(self.scene) if row.label in self.block.rows)

    @cached_property
    def _special(self) -> tuple[Special, ...]:
        return tuple(special_places(self.scene))

    def notes(self, pose: Pose) -> Iterator[Caption]:
        """Yield the note on what is special at a pose."""
        size, words = self.block.size, note(self._special, pose)
        for n, line in enumerate(self.type.wrapped(words, size, self.place.width) if words else ()):
            at = (self.place.x, self.place.y + self.block.note + 1.2 * size * n)
            yield Caption(line, at, size, self.theme.dim)

    def _top(self, row: int) -> float:
        return self.place.y + self.block.first + STEP * self.block.size * row


# The key to the colours: of arrows, with the value of the sample arrow; of the ink; of the causal chain.

INK_LINES = 2
"""The lines of the key to the ink: one for its colours, one for its dots."""
KEY_STEP = 1.5
"""The step from line to line of the key to the arrows, in heights of its text."""
_DISC_STEP = 1.2
"""The step from one disc of colour to the next, in heights of the text."""


@frozen
class Legend:
    """A line for each kind of arrow at the foot of the HUD's column, then those of ink and chain."""

    kinds: tuple[Arrows, ...]
    column: Rect
    size: int
    """The height of its text."""
    type: Type
    theme: Theme
    chain: tuple[Colour, ...] = ()
    ink: InkScale | None = None
    listed: tuple[str, ...] = ()
    """Rows of words below the key."""

    def group(self, speed: float) -> Group:
        """Return the key at this input speed (rad/s), and what is listed."""
        inked = self._inked(self.ink, len(self.kinds), speed) if self.ink else ()
        line = len(self.kinds) + (INK_LINES if self.ink else 0)
        chained = self._chained(self._top(line)) if self.chain else ()
        items = [*self._arrows(speed), *inked, *chained, *self._rows(line + bool(self.chain))]
        return grouped("key", items, still=True)

    def _rows(self, line: int) -> Iterator[Caption]:
        """Yield what is listed, below so many lines of the key."""
        top = self._top(line) + (0.4 * self.size if line else 0.0)
        for n, row in enumerate(self.listed):
            at = self.column.x, top + LISTED_STEP * self.size * n
            yield Caption(row, at, self.size, self.theme.dim)

    def _inked(self, scale: InkScale, line: int, speed: float) -> Iterator[Item]:
        """Yield the key to the ink: its colours up to the greatest speed, and the time between its dots."""
        size, dim, left = self.size, self.theme.dim, self.column.x
        words = (
            (said("speed"), scale.greatest_words(speed)),
            (said("dots every"), scale.interval_words(speed)),
        )
        for n, (name, meaning) in enumerate(words):
            top = self._top(line + n)
            sample = complex(left, top + 0.5 * size)
            yield from (
                scale.wedge(sample, self._reach, size, self.theme)
                if n == 0
                else scale.row_of_dots(sample, self._reach, size, self.theme)
            )
            yield Caption(name, (left + self._reach + 0.6 * size, top), size, dim)
            yield Caption(meaning, (self.column.right, top), size, dim, "right")

    def _arrows(self, speed: float) -> Iterator[Item]:
        """Yield the sample arrows, their names, and how much each stands for."""
        size, dim = self.size, self.theme.dim
        for n, kind in enumerate(self.kinds):
            top = self._top(n)
            foot = complex(self.column.x, top + 0.5 * size)
            yield Layer(kind.colour, arrows([foot], [self._sample(kind, speed)[0]], 1.6 * kind.gauge.line))
            yield Caption(said(kind.words), (self.column.x + self._reach + 0.6 * size, top), size, dim)
            yield Caption(self.meaning(kind, speed), (self.column.right, top), size, dim, "right")

    def _chained(self, top: float) -> Iterator[Item]:
        """Yield the colours of the steps in which joints are solved, between input and output."""
        size, begin, end = self.size, said("input"), said("output")
        first = self.column.x + self.type.width(begin, size) + 0.5 * size
        room = self.column.right - self.type.width(end, size) - 0.5 * size - first
        step = min(_DISC_STEP * size, room / len(self.chain))
        yield Caption(begin, (self.column.x, top), size, self.theme.dim)
        for n, colour in enumerate(self.chain):
            middle, radius = complex(first + (n + 0.5) * step, top + 0.5 * size), 0.42 * step
            yield Layer(self.theme.outline, [middle + disc(radius)])
            yield Layer(colour, [middle + disc(radius - max(0.1 * size, 1.0))])
        yield Caption(end, (first + len(self.chain) * step + 0.5 * size, top), size, self.theme.dim)

    def meaning(self, kind: Arrows, speed: float) -> str:
        """Return in words how much the arrow of the key stands for; a dash where nothing moves."""
        _, value = self._sample(kind, speed)
        number = f"{value:g}" if 1e-3 <= value < 1e6 else three_digits(value)
        return f"{number} {kind.unit}" if value > 0 else "–"

    def _sample(self, kind: Arrows, speed: float) -> tuple[float, float]:
        """Return the length of the key's arrow, and the round number it stands for: 0 where nothing moves."""
        scale = kind.scale(speed)
        if not scale > 0:
            return self._reach, 0.0
        value = round_below(self._reach / scale)
        return value * scale, value

    @property
    def _reach(self) -> float:
        """The length of the key's arrows in pixels."""
        return 2.6 * self.size

    def _top(self, line: int) -> float:
        return self.column.y + KEY_STEP * self.size * line


def key_lines(look: Look) -> int:
    """Return how many lines the key to a look's colours has."""
    return len(look.vectors) + look.chain + INK_LINES * look.ink


def legend_for(
    kinds: tuple[Arrows, ...],
    layout: Layout,
    type_: Type,
    theme: Theme,
    chain: tuple[Colour, ...] = (),
    ink: InkScale | None = None,
    listed: tuple[str, ...] = (),
) -> Legend | None:
    """Return the key to arrows, ink and chain, and what is listed; None without content or room."""
    column = layout.legend
    if column is None or not (kinds or chain or ink or listed):
        return None
    return Legend(kinds, column, layout.small_size, type_, theme, chain, ink, listed)


# The column of words about a scene: its title and class, rows of numbers, the legend.

_CLASS_RANK = 4
"""The class is left out after the rows of higher ranks."""
_NARROWEST = 13.0
"""The least width of the column where there are rows, in heights of their text."""
_GAP = 0.9
"""The gap between the name and the value of a row, in heights of the text."""
_TRIED = 24
_MEASURED = 21
"""The size at which widths of values are compared; the widest value is the widest at any size."""
_FASTEST = -10.0
"""The fastest that a scene is run at, backwards for the minus sign."""
LISTED_STEP = 1.3
"""The step from row to row of what is listed, in heights of its text."""


Ranked = tuple[int, Reading]
"""A row's rank, and the row with the value that needs the most room."""


def widest_rows(scenes: Sequence[Scene], type_: Type) -> tuple[Ranked, ...]:
    """Return the rows of a scene, and of those beside it, each with the widest value that it ever has."""
    widest: dict[str, tuple[int, Ranked]] = {}
    for rank, row in (one for scene in scenes for one in _over_a_cycle(scene)):
        width = type_.width(row.value, _MEASURED)
        if row.label not in widest or width > widest[row.label][0]:
            widest[row.label] = width, (rank, row)
    return tuple(one for _, one in widest.values())


def _over_a_cycle(scene: Scene) -> Iterator[Ranked]:
    """Yield the rows with their values over a cycle, at the fastest speed."""
    known, speed = rows_of(scene), _FASTEST * scene.linkage.drive.speed
    for step in range(_TRIED):
        yield from ranked(known, scene.pose(scene.period * step / _TRIED, speed=speed))


def columns(
    scenes: Sequence[Scene],
    rows: tuple[Ranked, ...],
    layout: Layout,
    type_: Type,
    *,
    keys: int = 0,
    listed: tuple[str, ...] = (),
) -> Iterator[WordBlock]:
    """Yield the column of words, whole first, then shorter and shorter, at last with nothing in it.

    Its legend has so many lines of a key to the colours, and what is `listed`.

    The rows go first, those of the highest rank before others, and the class with those of its rank; then
    the key, then the title; what is listed stays as long as it fits at all. The words are the first scene's,
    with room for those of the others in their place. Without scenes there is the legend alone.
    """
    titled = bool(scenes)
    column = partial(_column, layout, type_, listed)
    for rank in sorted({_CLASS_RANK, *(rank for rank, _ in rows)}, reverse=True) if titled else ():
        kept = tuple(row for own, row in rows if own <= rank)
        yield column(scenes, kept, keys, classed=rank >= _CLASS_RANK)
    for fewer in (keys, 0):
        yield column(scenes, (), fewer)
    yield column((), (), 0)
    yield WordBlock(layout.text_size)


def _column(
    layout: Layout,
    type_: Type,
    listed: tuple[str, ...],
    scenes: Sequence[Scene],
    rows: tuple[Reading, ...],
    keys: int,
    *,
    classed: bool = False,
) -> WordBlock:
    size, small, big = layout.text_size, layout.small_size, layout.title_size
    wide = [
        type_.width(row.label, size) + type_.width(row.value, size, strong=True) + _GAP * size for row in rows
    ]
    if keys:
        wide.append(_key_width(layout, type_))
    wide += [type_.width(row, small) for row in listed]
    least = max(max(wide, default=0.0), _NARROWEST * size if scenes else 0.0)
    room = layout.size[0] - 2 * layout.margin
    block = WordBlock(size, big)
    if scenes:
        title = said(scenes[0].title)
        title = title if type_.shows(title) else scenes[0].name
        across = min(max(least, type_.narrowest(title, big, 2)), room)
        lines = tuple(type_.wrapped(title, big, across, strong=True) or ("",))
        classes = _classes(scenes, title, size, min(max(across, least), room), type_) if classed else ()
        block = replace(
            block, title=lines, classes=tuple(each[0] for each in zip_longest(*classes, fillvalue=""))
        )
    width = max(
        [
            least,
            *(type_.width(text, big, strong=True) for text in block.title),
            *(type_.width(text, size) for text in block.classes),
        ]
    )
    *_, (_, y) = block.lines
    first = y + 0.5 * size if rows else y
    note = first + STEP * size * len(rows) + (0.3 * size if rows else 0.0)
    key = note
    if rows:
        words = [words for scene in scenes for *_, words in special_places(scene)]
        key += 1.2 * size * max((len(type_.wrapped(one, size, width)) for one in words), default=0)
    high = KEY_STEP * small * keys + LISTED_STEP * small * len(listed)
    high += 0.4 * small if keys and listed else 0.0
    names = frozenset(row.label for row in rows)
    return replace(block, rows=names, first=first, note=note, key=key, width=float(width), height=key + high)


def _classes(
    scenes: Sequence[Scene], title: str, size: int, width: float, type_: Type
) -> Iterator[list[str]]:
    """Yield the lines of the scenes' classes, the first scene's first."""
    for scene in scenes:
        yield type_.wrapped(beyond_title(title, scene.info.class_said), size, width)


def _key_width(layout: Layout, type_: Type) -> float:
    size = layout.small_size
    return 3.2 * size + type_.width(f"{said('acceleration')}  00000 mm/s²", size)


def caption_lines(layout: Layout, text: str, type_: Type) -> list[str]:
    """Return a sentence in lines, as it stands below a linkage."""
    slot = layout.caption or layout.stage
    return type_.wrapped(text, layout.small_size, slot.width - 2 * layout.margin) if text else []
