"""What speeds up, and by what: the acceleration, its Coriolis term, its curve, what a doubled speed does."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from math import hypot, isfinite

import numpy as np

from linkanim.mechanics.formulas.program import Array
from linkanim.mechanics.linkage.joint import Slide
from linkanim.mechanics.motion.measures import between as way_between
from linkanim.mechanics.motion.measures import growth, output_body
from linkanim.mechanics.motion.settled import said
from linkanim.picture.look import ACCELERATION, VELOCITY, Look
from linkanim.play.kinds.wording import number
from linkanim.play.question import CLEAR, PLAIN, Puzzle, QuizAnswer, QuizQuestion, either

_BOTH = Look(names=1, vectors=frozenset({VELOCITY, ACCELERATION}))
_SAMPLES = 72
"""Values of a curve."""
_APART = 0.3
"""Curves that differ by less, of their greatest value, could be taken for one."""
_FACTORS = {1: "as large as before", 2: "twice as large", 4: "four times as large", 8: "eight times as large"}
_GOES_WITH = {
    1: "a spring's force",
    2: "a velocity or a damper's force",
    4: "an acceleration",
    8: "the power that accelerates a mass",
}
"""What becomes so large when the speed doubles."""


def speeding(puzzle: Puzzle) -> QuizQuestion | None:
    """Return whether a joint becomes faster; taken wrongly, whether it is accelerated to the right, or up."""
    names = puzzle.clear("velocity")
    puzzle.random.shuffle(names)
    for name in names:
        along = puzzle.value(f"{name}.tangential_acceleration")
        ax, ay = puzzle.pose.acceleration[name]
        gains = isfinite(along) and abs(along) > PLAIN * hypot(ax, ay)
        if gains and puzzle.share(f"{name}.acceleration") > CLEAR:
            way = "the way it moves" if along > 0 else "against its velocity"
            why = (
                f"The part of its acceleration along its velocity, {number(along)} "
                f"{puzzle.scene.length_unit}/s², points {way}."
            )
            larger = ax if abs(ax) > abs(ay) else ay
            slip = "the sign of the acceleration alone, whichever way the point moves"
            return puzzle.question(
                name,
                f"Does {name} speed up or slow down?",
                *either(
                    ("it speeds up", "it slows down"), along > 0, slip if (larger > 0) != (along > 0) else ""
                ),
                why,
                shows=_BOTH,
                arrows=[name],
            )
    return None


def doubled(puzzle: Puzzle) -> QuizQuestion | None:
    """Return what becomes of a joint's velocity or acceleration as the speed doubles."""
    kind, factor = puzzle.random.choice((("velocity", 2), ("acceleration", 4)))
    names = puzzle.clear(kind)
    if not names:
        return None
    name = puzzle.random.choice(names)
    value = puzzle.value(f"{name}.{kind}")
    unit = f"{puzzle.scene.length_unit}/s{'²' if kind == 'acceleration' else ''}"
    power = "the square of the speed" if factor == 4 else "the speed itself"
    return _growing(
        puzzle,
        f"{name}.{kind}",
        f"How large is the {kind} of {name} in the same place?",
        factor,
        f"It goes with {power}: {number(value)} becomes {number(factor * value)} {unit}.",
    )


def force(puzzle: Puzzle) -> QuizQuestion | None:
    """Return what becomes of a force as the speed doubles: a spring's, a damper's, or that on a mass."""
    known = puzzle.scene.linkage
    clear = []
    for items, factor in ((known.springs, 1), (known.dampers, 2)):
        for item in items:
            if item.forceful and abs(puzzle.share(f"{item.name}.force")) > PLAIN:
                clear.append((item, factor, abs(puzzle.value(f"{item.name}.force"))))
    if clear:
        item, factor, value = puzzle.random.choice(clear)
        why = f"It goes with its length alone, which is the same there: it stays {number(value)} N."
        if factor == 2:
            why = f"It goes with the speed itself: {number(value)} N becomes {number(factor * value)} N."
        return _growing(
            puzzle,
            item.name,
            f"How large is the force of the {known.strut_words(item)} in the same place?",
            factor,
            why,
            Look(names=1, chart=f"{item.name}.force"),
        )
    names = puzzle.clear("acceleration")
    if not names:
        return None
    name = puzzle.random.choice(names)
    return _growing(
        puzzle,
        f"{name}.acceleration",
        f"How large is the force that accelerates a mass at {name}, in the same place?",
        4,
        "It goes with the acceleration, and that with the square of the speed.",
    )


def _growing(
    puzzle: Puzzle, subject: str, text: str, factor: int, why: str, shows: Look = _BOTH
) -> QuizQuestion:
    """Return a question on what a doubled speed does."""
    return puzzle.question(
        subject,
        f"The input runs twice as fast. {text}",
        QuizAnswer(_FACTORS[factor]),
        [
            QuizAnswer(words, f"what {_GOES_WITH[one]} does")
            for one, words in _FACTORS.items()
            if one != factor
        ],
        why,
        shuffled=True,
        shows=shows,
        arrows=[name for name in [subject.partition(".")[0]] if name in puzzle.pose.position],
    )


_ORDERS = ("position", "velocity", "acceleration")


def curves(puzzle: Puzzle) -> QuizQuestion | None:
    """Return which of three curves is the output's velocity or acceleration; taken wrongly, another."""
    body = output_body(puzzle.scene.linkage)
    if body is None or not puzzle.scene.info.full_turn:
        return None
    tokens = (
        ("travel", "travel_velocity", "travel_acceleration")
        if body.slider
        else ("angle", "angular_velocity", "angular_acceleration")
    )
    scaled = _distinct(puzzle, [puzzle.values(f"{body.name}.{token}") for token in tokens])
    if scaled is None:
        return None
    order = puzzle.random.sample(range(3), 3)
    which = puzzle.random.choice((1, 2))
    right = _ORDERS[which]
    answers = [
        QuizAnswer(
            f"curve {order.index(n) + 1}",
            f"the {_ORDERS[n]} taken for the {right}" if n != which else "",
            curve=tuple(round(float(value), 3) for value in part),
        )
        for n, part in enumerate(scaled)
    ]
    token = f"{body.name}.{tokens[which]}"
    kind, where = ("", " along its guide") if body.slider else ("angular ", "")
    return puzzle.question(
        token,
        f"Over one period, which curve is the {kind}{right} of {puzzle.name(body)}{where}?",
        answers.pop(which),
        answers,
        f"Where the {_ORDERS[which - 1]} has its extremes the {right}, its steepness, is zero.",
        shows=Look(names=1, chart=token),
    )


def _distinct(puzzle: Puzzle, columns: Sequence[Array]) -> list[Array] | None:
    """Return a value over a period as time goes, and its two rates, each at most 1 in size.

    None where they look alike, one is unbounded or rests, or the value grows from turn to turn.
    """
    step = max(len(puzzle.cycle.phase) // _SAMPLES, 1)
    value, *rates = (column[::step] for column in columns)
    if not all(np.isfinite(part).all() and np.ptp(part) > 0.0 for part in (value, *rates)):
        return None
    value = value - (value.max() + value.min()) / 2
    if abs(float(value[-1] - value[0])) > 0.5 * float(np.ptp(value)):
        return None  # it turns on and on: its angle is a line
    way = -1 if puzzle.scene.linkage.drive.speed < 0 else 1
    scaled = [part[::way] / np.abs(part).max() for part in (value, *rates)]
    alike = (float(np.abs(one - other).max()) < _APART for one, other in combinations(scaled, 2))
    return None if any(alike) else scaled


def coriolis(puzzle: Puzzle) -> QuizQuestion | None:
    """Return whether a point that slides has a Coriolis acceleration; only where the guide turns it has."""
    found = list(_sliding(puzzle))
    if not found:
        return None
    joint, guide, turns = puzzle.random.choice(found)
    why = (
        f"The guide turns while {joint} slides along it: 2ω × v is not zero."
        if turns
        else "The guide does not turn: ω is zero, and 2ω × v with it."
    )
    slip = "the guide's turning overlooked" if turns else "sliding alone taken for a Coriolis term"
    return puzzle.question(
        joint,
        f"{joint} slides along {guide}. In a frame fixed to that guide, has the acceleration of {joint} a "
        "Coriolis term?",
        *either(("yes", "no"), turns, slip),
        why,
        shows=_BOTH,
        arrows=[joint],
    )


def _sliding(puzzle: Puzzle) -> Iterator[tuple[str, str, bool]]:
    """Yield joints that slide clearly, each with the words for its guide, and whether that turns clearly."""
    linkage = puzzle.scene.linkage
    for slide in (slide for joint in linkage.joints for slide in joint.slides):
        if linkage.joint(slide.point).fixed or not _slides(puzzle, slide):
            continue
        if slide.start is None:
            yield slide.point, "a fixed line", False
        elif slide.axis is None:
            yield slide.point, f"the slot at {slide.start}", False
        else:
            carriers = puzzle.bodies_of(*slide.axis)
            body = next(
                (one for one in carriers if abs(puzzle.share(f"{one.name}.angular_velocity")) > PLAIN), None
            )
            if body is not None:
                yield slide.point, puzzle.name(body), True


def _slides(puzzle: Puzzle, slide: Slide) -> bool:
    """Return whether a joint clearly slides along its guide."""
    ends = (slide.start or slide.line.through, slide.point)
    rates = []
    for found in (puzzle.cycle, puzzle.pose):
        way, moving = (way_between(vectors, ends) for vectors in (found.position, found.velocity))
        rates.append(np.abs(said(found, growth(way, moving), "{}/s", 1)))
    return bool(rates[1] > PLAIN * float(np.nanmax(rates[0])))
