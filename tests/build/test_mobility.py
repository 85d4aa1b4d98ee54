"""Stated mobilities against the rank of the constraints, exactly: residuals of dual numbers modulo a prime.

Nothing is taken from the product but what the draft's tables say. Joints stand at random places, so that the
pose is not special; fixed pins stand where they are, and directions keep their angles to each other.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from fractions import Fraction
from random import Random
from typing import Any, NamedTuple

import pytest
from hand import drawn, gesture, gestures
from test_any_gestures import any_gesture
from test_sessions import SESSIONS, Session

from linkanim.build.building import Building
from linkanim.build.draft import Draft
from linkanim.build.freedom import mobility

STEPS = 360 * 10**6
"""Directions are whole millionths of a degree."""
PRIME = 3202559739 * STEPS - 1
"""Modulo it there are turns by so many steps, as its successor has them as a divisor, and i is no number."""
STATED = re.compile(r"Mobility (-?\d+)(?:: (.*) cannot move)?")


class Dual(NamedTuple):
    """A complex number modulo the prime, with its derivative."""

    x: int
    y: int = 0
    dx: int = 0
    dy: int = 0

    def __sub__(self, other: Dual) -> Dual:
        return Dual(*((a - b) % PRIME for a, b in zip(self, other, strict=True)))

    def __matmul__(self, other: Dual) -> Dual:
        """Return the product."""
        (a, b, da, db), (c, d, dc, dd) = self, other
        x, y = a * c - b * d, a * d + b * c
        dx, dy = da * c - db * d + a * dc - b * dd, da * d + db * c + a * dd + b * dc
        return Dual(x % PRIME, y % PRIME, dx % PRIME, dy % PRIME)

    def __pow__(self, times: int) -> Dual:
        value, square = Dual(1), self
        while times:
            value, square, times = value @ square if times % 2 else value, square @ square, times // 2
        return value

    @property
    def turned_back(self) -> Dual:
        return Dual(self.x, -self.y % PRIME, self.dx, -self.dy % PRIME)


def whole(number: float | str) -> int:
    """Return a length in millimetres modulo the prime."""
    text, _, unit = str(number).partition(" ")
    share = Fraction(text) * Fraction({"cm": "10", "m": "1000", "in": "25.4"}.get(unit, "1"))
    return share.numerator * pow(share.denominator, -1, PRIME) % PRIME


def step() -> Dual:
    """Return the turn by a millionth of a degree: a number of size 1 of that order."""
    for n in range(1, 100):
        one = Dual(n, 1) @ Dual(n, 1) @ Dual((n * n + 1) % PRIME) ** (PRIME - 2)
        turn = one ** ((PRIME + 1) // STEPS)
        if all(turn ** (STEPS // factor) != Dual(1) for factor in (2, 3, 5)):
            return turn
    raise AssertionError


TURN = step()


def direction(angle: str) -> Dual:
    return TURN ** (round(Fraction(angle.removesuffix(" deg")) * 10**6) % STEPS)


Places = Mapping[str, Dual]


def pivot(draft: Draft, joint: str) -> str:
    bars = (table["joints"] for table in draft.of("bars").values())
    ends: list[str] = [one if other == joint else other for one, other in bars if joint in (one, other)]
    return next((end for end in ends if end in draft.of("pins")), ends[0])


def axis(draft: Draft, guide: Mapping[str, Any], at: Places) -> Dual:
    way = direction(guide.get("angle", "0 deg"))
    return way @ (at[guide["on"][1]] - at[guide["on"][0]]) if "on" in guide else way


def residuals(draft: Draft, at: Places, shapes: Mapping[str, Dual]) -> Iterator[tuple[set[str], Dual, bool]]:
    """Yield what must not change: the joints, a number, and whether it is its imaginary part alone."""
    for table in draft.of("bars").values():
        one, other = table["joints"]
        way = at[one] - at[other]
        yield {one, other}, Dual(0, 1) @ way @ way.turned_back, True
    for name, table in draft.of("points").items():
        one, other = table["on"]
        yield {name, one, other}, at[name] - at[one] - shapes[name] @ (at[other] - at[one]), False
    for name, table in draft.of("sliders").items():
        guide = draft.of("guides")[table["guide"]]
        joints = {name, guide["through"], *guide.get("on", ())}
        way = axis(draft, guide, at)
        yield joints, (at[name] - at[guide["through"]]) @ way.turned_back, True
        if yoke := draft.of("yokes").get(name):
            way @= direction(yoke["slot"])
            yield joints | {yoke["pin"]}, (at[yoke["pin"]] - at[name]) @ way.turned_back, True
    for table in draft.of("slots").values():
        one, other = draft.of("bars")[table["bar"]]["joints"]
        way = (at[table["through"]] - at[one]) @ (at[other] - at[one]).turned_back
        yield {one, other, table["through"]}, way, True
    for name, table in draft.of("gears").items():
        ratio, centre, other = Fraction(table["ratio"]), pivot(draft, name), pivot(draft, table["with"])
        arm, mate = at[name] - at[centre], at[table["with"]] - at[other]
        mate = mate.turned_back if ratio > 0 else mate
        turned = arm**ratio.denominator @ mate ** abs(ratio.numerator)
        start = Dual(turned.x, turned.y).turned_back
        yield {name, centre, table["with"], other}, turned @ start, True


def freedom(draft: Draft, joints: set[str]) -> int:
    """Return the degrees of freedom of joints, with nothing but the ground beside them."""
    random, pins, points = Random(0), draft.of("pins"), draft.of("points")
    shapes = {
        name: Dual(*map(whole, table["at"])) @ Dual(random.randrange(1, PRIME))
        for name, table in points.items()
    }
    at = {}
    for name, place in draft.places.items():
        at[name] = Dual(
            *(whole(round(part, 9)) if name in pins else random.randrange(PRIME) for part in place)
        )
        if name in points:
            one, other = points[name]["on"]
            way = shapes[name] @ (at[other] - at[one])
            at[name] = Dual(0) - (Dual(0) - at[one] - way)
    there, rows = joints | pins.keys(), list[list[int]]()
    for joint in joints - pins.keys():
        for dx, dy in ((1, 0), (0, 1)):
            moved = {**at, joint: at[joint]._replace(dx=dx, dy=dy)}
            changes = (
                (value.dy,) if one else (value.dx, value.dy)
                for named, value, one in residuals(draft, moved, shapes)
                if named <= there
            )
            rows.append([part for change in changes for part in change])
    return len(rows) - rank(rows)


def rank(rows: list[list[int]]) -> int:
    count = 0
    for column in range(len(rows[0]) if rows else 0):
        lead = next((n for n in range(count, len(rows)) if rows[n][column]), None)
        if lead is None:
            continue
        rows[count], rows[lead] = rows[lead], rows[count]
        first = rows[count]
        inverse = pow(first[column], -1, PRIME)
        for n in range(count + 1, len(rows)):
            if times := rows[n][column] * inverse % PRIME:
                rows[n] = [(a - times * b) % PRIME for a, b in zip(rows[n], first, strict=True)]
        count += 1
    return count


def after(seed: int, steps: int = 25) -> int:
    """Make so many gestures, compare every mobility that is stated after one, and return how many were."""
    random, stated = Random(seed), 0
    session = gestures(random.choice(SESSIONS).lines) if seed % 2 else []
    building = drawn(session[: random.randint(0, len(session))])
    for _ in range(steps):
        building = gesture(building, any_gesture(random, building))
        draft, sentence = building.draft, building.made.missing
        if words := STATED.match(sentence):
            stated += 1
            whole_draft = freedom(draft, {*draft.places})
            assert int(words[1]) == mobility(draft) == whole_draft, (seed, sentence)
            other = any(word in sentence for word in ("triad", "dyad", "motors"))
            assert whole_draft > 1 or words[2] or other, (seed, sentence)
    if building.made.scene:
        assert freedom(draft, {*draft.places}) == mobility(draft), seed
    return stated


@pytest.mark.parametrize("session", SESSIONS, ids=lambda session: session.scene)
def test_the_mobility_after_each_gesture_of_a_session(session: Session) -> None:
    building = Building()
    for line in gestures(session.lines):
        building = gesture(building, line)
        assert mobility(building.draft) == freedom(building.draft, {*building.draft.places}), line


@pytest.mark.parametrize("part", range(2))
def test_a_stated_mobility_is_that_of_the_constraints(part: int) -> None:
    assert sum(after(seed) for seed in range(10 * part, 10 * part + 10)) > 10


@pytest.mark.long  # 12 s each
@pytest.mark.parametrize("part", range(8))
def test_of_two_thousand_drafts(part: int) -> None:
    assert sum(after(5000 + 250 * part + seed) for seed in range(250)) > 250
