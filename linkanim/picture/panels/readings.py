"""What the HUD tells of a pose: its rows of numbers, and what is special about it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from math import degrees, floor, inf, log10, pi, tau
from typing import NamedTuple

from linkanim.digits import stepped
from linkanim.mechanics.facts.effort import effort_token
from linkanim.mechanics.facts.register import Quantity, register
from linkanim.mechanics.motion.motion import Pose
from linkanim.picture.parts.driven import driven_words, sign_of, speed_in, speed_unit, speed_words
from linkanim.picture.view import eased
from linkanim.scenes.scene import Scene

_NEAR_LIMIT = 0.06 * pi
"""How near to a limit, in phase, the HUD says so: there the input has 1 % of its swing left."""
_NEAR_CHANGE = pi / 45
_HELD, _EASED = 0.2, 0.5
"""How long a note stands before and after the instant it is about, and how long it comes and goes, in s."""
_READ = 0.36
"""A note is not read where the next follows in this time (s), and well where it does in twice of it."""


class Reading(NamedTuple):
    """A name and its value; the name stays while the value moves."""

    label: str
    value: str


class Row(NamedTuple):
    """A name and what tells its value at a pose, None where it is not known there.

    Rows of the highest ranks are the first to go where there is no room.
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
    """Return the rows of a scene; what of them is the same at every pose is put into words here, once.

    The input's speed is the pose's: of an input that swings, how often it does and its angular velocity
    at this instant. Speeds are in the unit that the scene states its own in; forces appear where they are
    known; a damper without a coefficient is a cylinder, told by its length; lengths are in the scene's
    unit, forces in newtons, tension positive.
    """
    return *_input_rows(scene), *(_row(one, scene.length_unit) for one in measured(scene))


def _input_rows(scene: Scene) -> Iterator[Row]:
    info, drive = scene.info, scene.linkage.drive
    name = f"{scene.info.input_name} {drive.coordinate.name}"
    if info.full_turn:
        yield Row(0, name, lambda pose: _turned(pose.coordinate))
        yield Row(1, "input speed", lambda pose: speed_words(scene, pose.input_speed))
    else:
        across = "…".join(driven_words(scene, end) for end in info.input_range)
        yield Row(0, name, lambda pose: driven_words(scene, pose.coordinate))
        yield Row(5, "input range", lambda _: across)
        if scene.mechanism.retraced:
            yield Row(5, "returns", lambda _: "same closure")
        yield Row(1, "input rate", lambda pose: speed_words(scene, pose.input_speed))
        yield Row(3, " ".join(filter(None, (drive.actuator.noun, drive.coordinate.velocity))), _live(scene))
    if info.true_period != 1:
        turns = f"{info.true_period} turns"
        yield Row(6, "true period", lambda _: turns)


def _live(scene: Scene) -> Callable[[Pose], str]:
    """Return what tells the driven bar's angular velocity, or the slider's, always with as many decimals."""
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
    """A row that tells a quantity to a step."""

    rank: int
    label: str
    quantity: Quantity
    step: float


def measured(scene: Scene) -> Iterator[MeasuredRow]:
    """Yield the quantities that a scene's rows tell: of its struts, and what the input has to deliver."""
    yield from _of_struts(scene)
    usual = scene.info.usual_effort
    if usual is not None:
        step = 10.0 ** (floor(log10(usual)) - 2) if usual > 0 else 0.1
        quantity = register(scene.linkage)[effort_token(scene.linkage)]
        yield MeasuredRow(2, f"input {scene.info.effort[0]}", quantity, step)


def _of_struts(scene: Scene) -> Iterator[MeasuredRow]:
    linkage, known = scene.linkage, register(scene.linkage)
    for item in linkage.springs + linkage.dampers:
        word = linkage.strut_word(item)
        kind = "spring" if word == "spring" else "damper"
        part = "rate" if word == "damper" else "length"
        yield MeasuredRow(
            4, f"{linkage.strut_words(item)}, {part}", known[f"{item.name}.{part}"], scene.length_step
        )
        if item.forceful:
            yield MeasuredRow(2, f"{kind} force", known[f"{item.name}.force"], 0.1)
    if linkage.drive.actuator.along is not None:
        yield MeasuredRow(2, "driving cylinder", known["input.length"], scene.length_step)


def _row(one: MeasuredRow, length_unit: str) -> Row:
    """Return the row that puts a quantity into words; None where it is not known."""
    quantity, unit = one.quantity, one.quantity.shown_unit(length_unit)

    def value(pose: Pose) -> str | None:
        found = quantity.shown(pose)
        return None if found is None else f"{stepped(float(found), one.step)} {unit}"

    return Row(one.rank, one.label, value)


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


def notes(scene: Scene) -> tuple[str, ...]:
    """Return all that `note` ever says of a scene."""
    return tuple(words for *_, words in _special(scene, scene.pose(0.0)))


def _special(scene: Scene, pose: Pose) -> Iterator[tuple[float, float, str]]:
    """Yield the input's limits and change points: how far away, how far is near (rad of phase), in words."""
    info = scene.info
    if not info.full_turn:
        for limit, at in zip(info.ends, (0.0, pi), strict=True):
            yield _apart(pose.phase, at), _NEAR_LIMIT, f"near the limit {driven_words(scene, limit)}"
    for point in info.change_points if scene.linkage.drive.coordinate.is_angle else ():
        yield _apart(pose.coordinate, point), _NEAR_CHANGE, f"near the change point {_turned(point)}"


def _turned(angle: float) -> str:
    """Return an angle within one turn, rounded first, so that none reads 360°."""
    return f"{stepped(round(degrees(angle) % 360, 1) % 360, 0.1)}°"


def _apart(one: float, other: float) -> float:
    return abs((one - other + pi) % tau - pi)
