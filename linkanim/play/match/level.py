"""The levels of Match: a dotted curve, where the joints begin, what full score takes; files, or seeds."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache
from importlib.resources import files
from pathlib import Path
from random import Random
from typing import TypeVar

import numpy as np

from linkanim.bounds import LONGEST_TEXT
from linkanim.document import Section, refuse_controls
from linkanim.errors import BadInput
from linkanim.intake import Intake, control_in
from linkanim.play.match.worth import Worth, trace, worth
from linkanim.scenes.editing.toml import parse
from linkanim.synthesis.curves.drawn import DrawnCurve, drawn
from linkanim.synthesis.kinds import FOUR_BAR, Complex, Linkage4
from linkanim.units import angle, shown

Made = TypeVar("Made")
FOLDER = files("linkanim.play.match") / "levels"
_FILE = Intake("a level", most_bytes=100_000, most_values=5_000)
_KEYS = frozenset({"title", "about", "closed", "points", "fixed", "start", "full", "answer"})
_JOINTS = Linkage4._fields
_LONGEST_SEED = 18
_BEGINNING = Linkage4(-60 - 60j, -40 - 40j, 40 + 20j, 60 - 60j, 0 + 0j)
"""Where the joints of a level that is made begin, about a curve of size 100."""


@dataclass(frozen=True, eq=False)
class Level:
    """A curve to follow, the joints as they begin and those that stay there, and the worth of full score.

    `answer` is what is shown to who gives up, as a rule the path solver's.
    """

    name: str
    title: str
    about: str
    curve: DrawnCurve
    start: Linkage4
    fixed: frozenset[str]
    full: Worth
    answer: Linkage4 | None

    @cached_property
    def worth_of_answer(self) -> Worth:
        """What the answer is worth; nothing where there is none."""
        return worth(self.answer, self.curve) if self.answer else Worth(math.inf, math.inf, 0.0)


@lru_cache(maxsize=1)
def level_names() -> tuple[str, ...]:
    """Return the levels of the package, the first ones first."""
    found = sorted(entry.name for entry in FOLDER.iterdir() if entry.name.endswith(".toml"))
    return tuple(name.removesuffix(".toml").split("-", 1)[1] for name in found)


@lru_cache(maxsize=4)
def level_of(name: str) -> Level:
    """Return a level by its name, by the path of its file, or made from `seed-N`.

    BadInput with file, key and way out where there is none, or where it makes no sense.
    """
    if len(name) > LONGEST_TEXT or control_in(name):
        raise BadInput(f"match: {shown(name)} cannot be a level's name; rename the file")
    if name.endswith(".toml"):
        return _read(_FILE.read(Path(name), name), name, Path(name).stem)
    seed = name.removeprefix("seed-")
    if name.startswith("seed-") and seed.isdecimal() and len(seed) <= _LONGEST_SEED:
        return made(int(seed))
    for number, known in enumerate(level_names(), start=1):
        if known == name:
            file = f"{number:02}-{name}.toml"
            return _read((FOLDER / file).read_text(encoding="utf-8"), file, name)
    raise BadInput(
        f"match: there is no level {shown(name)}; there are {', '.join(level_names())}, seed-1, seed-2, … "
        "and files of your own, such as levels/mine.toml"
    )


def _read(text: str, where: str, name: str) -> Level:
    _FILE.refuse_heavy(text, where)
    document = Section(where, parse(text, where))
    refuse_controls(document)
    for key in document.values:
        if key not in _KEYS:
            raise document.error(key, f"is no key of a level; there are {', '.join(sorted(_KEYS))}")
    full = document.table("full")
    closed, points = document.flag("closed"), _points(document)
    curve = _said_of(document, "points", lambda: drawn(points, closed=closed))
    fixed = document.texts("fixed")
    for joint in fixed:
        if joint not in _JOINTS:
            raise document.error("fixed", f"{shown(joint)} is no joint; there are {', '.join(_JOINTS)}")
    return Level(
        name,
        document.text("title"),
        document.text("about", ""),
        curve,
        _joints(document.table("start")),
        frozenset(fixed),
        Worth(_positive(full, "off"), _positive(full, "links"), _least_angle(full)),
        _joints(document.table("answer")) if "answer" in document else None,
    )


def _said_of(section: Section, key: str, make: Callable[[], Made]) -> Made:
    """Return what is made of a key's value; what is wrong with that is said of the key."""
    try:
        return make()
    except BadInput as error:
        raise section.at(f"{section.key(key)}: {error}", key) from None


def _least_angle(full: Section) -> float:
    found = _said_of(full, "angle", lambda: angle(full.text("angle")))
    if not 0.0 < found <= math.pi / 2:
        raise full.error("angle", 'must be a transmission angle, such as "40 deg"')
    return found


def _positive(section: Section, key: str) -> float:
    value = section.number(key)
    if value <= 0:
        raise section.error(key, "must be above zero")
    return value


def _points(document: Section) -> Complex:
    listed = document.listed("points")
    return np.array([_point(listed, key) for key in listed.values], np.complex128)


def _point(section: Section, key: str) -> complex:
    pair = section.listed(key, 2)
    x, y = (pair.number(item) for item in pair.values)
    return complex(x, y)


def _joints(section: Section) -> Linkage4:
    return Linkage4(*(_point(section, name) for name in _JOINTS))


def made(seed: int) -> Level:
    """Return a level made from a seed: the curve of a crank-rocker or drag-link, itself the answer."""
    random = np.random.default_rng(seed)
    while True:
        rows = FOUR_BAR.random_rows(random, 64)
        good = np.flatnonzero((FOUR_BAR.slack(rows, math.radians(30)) > 0).all(axis=1))
        if len(good):
            break
    joints = Linkage4.of(rows[good[0]], Random(seed).uniform(0, 2 * math.pi))
    curve = trace(joints)[:-1:4]
    size = math.hypot(np.ptp(curve.real), np.ptp(curve.imag))
    middle = complex(curve.mean())
    answer = Linkage4(*(100 * (place - middle) / size for place in joints))
    target = drawn(100 * (curve - middle) / size, closed=True)
    best = worth(answer, target)
    full = Worth(1.5, 1.1 * best.links, best.angle - math.radians(3))
    return Level(
        f"seed-{seed}",
        f"Curve {seed}",
        "",
        target,
        _BEGINNING,
        frozenset(),
        full,
        answer,
    )
