"""How far things go: dead centres, the input's range, closures beyond a limit, Grashof's sum."""

from __future__ import annotations

from itertools import combinations
from math import degrees, tau

import numpy as np

from linkanim.mechanics.closing.search import sign_changes
from linkanim.mechanics.facts.naming import FourBar, four_bar_of
from linkanim.mechanics.motion.measures import output_body
from linkanim.picture.look import Look
from linkanim.play.kinds.wording import MOST, angle, between, crank_degrees, number, swing
from linkanim.play.question import CLEAR, Puzzle, QuizAnswer, QuizQuestion, either

_APART = 20.0
"""Crank angles in degrees that nobody takes for one another."""
_FULL = "it turns fully"


def dead_centre(puzzle: Puzzle) -> QuizQuestion | None:
    """Return at which crank angle the output turns back; taken wrongly, where it is fastest."""
    scene = puzzle.scene
    body = output_body(scene.linkage)
    if body is None or not scene.info.full_turn or scene.period > tau * 1.001:
        return None
    kind, name = "travel_velocity" if body.slider else "angular_velocity", body.name
    quickest = float(puzzle.cycle.phase[int(abs(getattr(puzzle.cycle, kind)[name]).argmax())])
    samples = len(puzzle.cycle.phase)  # once round from between two of them: many turn back at a phase of 0
    once_round = scene.period * (np.arange(samples + 1) + 0.5) / samples
    found = sign_changes(lambda phases: getattr(scene.solve(phase=phases), kind)[name], once_round)
    exact = {crank_degrees(puzzle, float(phase)): float(phase) for phase in found}
    if not exact:
        return None
    right = puzzle.random.choice([*exact])
    fast = crank_degrees(puzzle, quickest)
    others = [fast, *(puzzle.random.uniform(0, 360) for _ in range(20))]
    wrong: list[float] = []
    for one in others:
        if all(between(one, other) > _APART for other in (*exact, *wrong)) and len(wrong) < MOST - 1:
            wrong.append(one)
    if len(wrong) < 2:
        return None
    slips = {fast: "the greatest speed taken for the dead centre"}
    return puzzle.question(
        body.name,
        f"At which crank angle does the {puzzle.name(body)} turn back?",
        QuizAnswer(angle(right)),
        [QuizAnswer(angle(one), slips.get(one, "an angle at which it runs on")) for one in wrong],
        f"Its velocity is zero at {' and '.join(map(angle, exact))}; where that is greatest it runs on.",
        shuffled=True,
        shows=Look(names=1, chart=f"{name}.{kind}"),
        stops=exact[right],
        names=0,  # named, a guide has its dead centres
    )


def input_range(puzzle: Puzzle) -> QuizQuestion | None:
    """Return whether the input turns fully, and else between which angles it swings."""
    drive, info = puzzle.scene.linkage.drive, puzzle.scene.info
    if not drive.coordinate.is_angle:
        return None
    low, high = map(degrees, info.input_range)
    if info.full_turn:
        low, width = puzzle.random.uniform(-90, 90), puzzle.random.uniform(100, 200)
        right, slip = _FULL, "a limit seen where the loop still closes"
        wrong = [
            QuizAnswer(swing(low, low + width), slip),
            QuizAnswer(swing(low - 40, low + width / 2), slip),
        ]
        why = "The solver closes it at every angle of the input."
    else:
        width = high - low
        right = swing(low, high)
        wrong = [
            QuizAnswer(_FULL, "the limit overlooked: beyond it the loop does not close"),
            QuizAnswer(swing(low + 0.25 * width, high + 0.25 * width), "the swing seen from another bar"),
            QuizAnswer(swing(low, low + 0.6 * width), "one limit taken for both"),
        ]
        why = "At both ends two links lie in one line: beyond it the loop does not close."
    text = f"How far can the {info.input_name} turn?"
    return puzzle.question("input", text, QuizAnswer(right), wrong, why, shuffled=True)


def closure(puzzle: Puzzle) -> QuizQuestion | None:
    """Return on which closure an input that swings comes back."""
    info = puzzle.scene.info
    if info.full_turn or not puzzle.scene.linkage.drive.coordinate.is_angle or not info.toggles:
        return None
    retraced, answers = info.mechanism.retraced, ("on the same closure", "on the other closure")
    why = (
        "It goes back by the way it came, as the scene says."
        if retraced
        else "Through the limit the links swing on smoothly, to the other side of their line."
    )
    text = f"The {info.input_name} comes to its limit and turns back. On which closure?"
    slip = "the other closure" if retraced else "the closure that it came by"
    look = Look(names=1, ghost=True)
    return puzzle.question("input", text, *either(answers, retraced, slip), why, shows=look)


def grashof(puzzle: Puzzle) -> QuizQuestion | None:
    """Return what Grashof's sum says of the four-bar that the input drives."""
    bar = four_bar_of(puzzle.scene.mechanism)
    if bar is None:
        return None
    lengths = sorted(bar.links.values())
    if 0 < abs(bar.margin) < CLEAR * lengths[-1]:
        return None
    answers = (
        "a link turns fully: s + l < p + q",
        "no link turns fully: s + l > p + q",
        "s + l = p + q: a change point",
    )
    right = 2 if bar.margin == 0 else 0 if bar.margin > 0 else 1
    slips = ("the sums compared the wrong way round", "a near miss taken for a change point")
    wrong = [QuizAnswer(answers[n], slips[2 in (n, right)]) for n in range(3) if n != right]
    s, p, q, longest = map(number, lengths)
    return puzzle.question(
        bar.joint,
        f"The lengths of the four-bar that the input drives, in {puzzle.scene.length_unit}: {_listed(bar)}. "
        "Does a link turn fully against the others?",
        QuizAnswer(answers[right]),
        wrong,
        f"s + l = {s} + {longest} and p + q = {p} + {q}.",
    )


def _listed(bar: FourBar) -> str:
    return ", ".join(f"{part} {number(length)}" for part, length in bar.links.items())


def grashof_sum(puzzle: Puzzle) -> QuizQuestion | None:
    """Return which link is in the wrong place of Grashof's sum; taken wrongly, one that is in its own."""
    bar = four_bar_of(puzzle.scene.mechanism)
    if bar is None:
        return None
    order = sorted(bar.links, key=lambda part: bar.links[part])
    pairs = [pair for pair in combinations(range(4), 2) if pair != (1, 2)]
    gaps = [bar.links[order[b]] - bar.links[order[a]] for a, b in pairs]
    if min(gaps) < 2 * CLEAR * bar.links[order[3]]:
        return None
    one, other = puzzle.random.choice([pair for pair in pairs if pair != (0, 3)])
    written = [*order]
    written[one], written[other] = written[other], written[one]
    s, p, q, longest = (f"{number(bar.links[part])} ({part})" for part in written)
    right = order[puzzle.random.choice((one, other))]
    wrong = [order[n] for n in range(4) if n not in (one, other)]
    slip = "the order round the loop taken for the order of lengths"
    places = ("s, the shortest", "one of p and q", "one of p and q", "l, the longest")
    return puzzle.question(
        bar.joint,
        f"Grashof's sums of this four-bar: s + l = {s} + {longest}, p + q = {p} + {q}. "
        "Which link is in the wrong place?",
        QuizAnswer(right),
        [QuizAnswer(part, slip) for part in wrong],
        f"The {right} is {places[order.index(right)]}, not {places[written.index(right)]}.",
    )
