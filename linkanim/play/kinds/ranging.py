"""How far things go: dead centres, the input's range, closures beyond a limit, Grashof's sum."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations
from math import degrees, floor, tau

import numpy as np

from linkanim.mechanics.closing.search import sign_changes
from linkanim.mechanics.facts.naming import FourBar, four_bar_of
from linkanim.mechanics.linkage.linkage import Body
from linkanim.mechanics.motion.measures import output_body
from linkanim.picture.look import Look
from linkanim.play.kinds.wording import MOST, angle, between, crank_degrees, number, swing, tenths
from linkanim.play.question import CLEAR, Puzzle, QuizAnswer, QuizQuestion, either

_APART = 20.0
"""Crank angles in degrees that nobody takes for one another."""
_SWINGS_APART = 5.0
"""Ends of swings in degrees that nobody takes for one another."""
_FULL = "it turns fully"
_IN_LINE = 1e-6
"""Two bars are in one line where the sine of the angle between them is less."""
Swing = tuple[float, float]
"""The two ends of a swing, in degrees."""


def dead_centre(puzzle: Puzzle) -> QuizQuestion | None:
    """Return at which crank angle the output turns back; taken wrongly, where it is fastest."""
    body = output_body(puzzle.scene.linkage)
    exact = _turning_back(puzzle, body) if body else {}
    if body is None or not exact:
        return None
    right = puzzle.random.choice([*exact])
    rates = puzzle.values(_rate_of(body))
    fast = crank_degrees(puzzle, float(puzzle.cycle.phase[int(abs(rates).argmax())]))
    slips = {(one + 180) % 360: "the other dead centre, taken to lie half a turn on" for one in exact}
    slips[fast] = "the greatest speed taken for the dead centre"
    wrong: list[float] = []
    for one in (fast, *slips, *(puzzle.random.uniform(0, 360) for _ in range(20))):
        if all(between(one, other) > _APART for other in (*exact, *wrong)) and len(wrong) < MOST - 1:
            wrong.append(one)
    if len(wrong) < 2:
        return None
    return puzzle.question(
        body.name,
        f"At which crank angle does {puzzle.name(body)} turn back?",
        QuizAnswer(angle(right)),
        [QuizAnswer(angle(one), slips.get(one, "")) for one in wrong],
        f"Its velocity changes its sign at {' and '.join(map(angle, exact))}{_in_line(puzzle, body, exact)}.",
        shuffled=True,
        shows=Look(names=1, chart=_rate_of(body)),
        stops=exact[right],
        names=0,  # named, a guide has its dead centres
    )


def _rate_of(body: Body) -> str:
    """Return the token of how fast a body turns, or travels."""
    return f"{body.name}.{'travel_velocity' if body.slider else 'angular_velocity'}"


def _turning_back(puzzle: Puzzle, body: Body) -> dict[float, float]:
    """Return the crank angles at which a body turns back, in degrees, each with its phase.

    None where the input does not turn fully, or does so more than once before all is back.
    """
    scene, samples = puzzle.scene, len(puzzle.cycle.phase)
    if not scene.info.full_turn or scene.period > tau * 1.001:
        return {}
    # once round from between two samples: many turn back at a phase of 0
    once_round = scene.period * (np.arange(samples + 1) + 0.5) / samples
    rate = scene.quantities[_rate_of(body)]
    found = sign_changes(
        lambda phases: np.asarray(rate.read(scene.solve(phase=phases, derivatives=1))), once_round
    )
    return dict(sorted((crank_degrees(puzzle, float(phase)), float(phase)) for phase in found))


def _in_line(puzzle: Puzzle, body: Body, exact: Mapping[float, float]) -> str:
    """Return, after a colon, which bar is in line with the crank as the output turns back; "" if none."""
    linkage = puzzle.scene.linkage
    pin = linkage.drive.joint
    pivot = linkage.crank(pin).pivot
    poses = [puzzle.scene.pose(phase, 0).position for phase in exact.values()]
    for name in (body.slider, *body.joints):
        if name and pin in (end for end, _ in linkage.joint(name).bars):
            ways = [[complex(*pose[joint]) for joint in (pivot, pin, name)] for pose in poses]
            turns = [(c - b) * (b - a).conjugate() for a, b, c in ways]
            if all(abs(turn.imag) < _IN_LINE * abs(turn) for turn in turns):
                return f": there {pivot}–{pin} and {pin}–{name} lie in one line"
    return ""


def input_range(puzzle: Puzzle) -> QuizQuestion | None:
    """Return whether the input turns fully, or how it swings; taken wrongly, another's swing."""
    info = puzzle.scene.info
    if not puzzle.scene.linkage.drive.coordinate.is_angle:
        return None
    own = None if info.full_turn else (degrees(info.input_range[0]), degrees(info.input_range[1]))
    wrong = [] if own is None else [QuizAnswer(_FULL, _overlooked(puzzle))]
    swings = [] if own is None else [own]
    for slip, other in _taken_for_range(puzzle, own):
        if len(wrong) == MOST - 1:
            break
        if all(_are_apart(one, other) for one in swings):
            swings.append(other)
            wrong.append(QuizAnswer(swing(*other), slip))
    right = QuizAnswer(_FULL if own is None else swing(*own))
    text = f"How far can the {info.input_name} turn?"
    why = _why_fully(puzzle) if own is None else _why_swinging(puzzle)
    return puzzle.question("input", text, right, wrong, why, shuffled=True)


def _are_apart(one: Swing, other: Swing) -> bool:
    """Return whether nobody takes two swings for one another."""
    return max(between(a, b) for a, b in zip(one, other, strict=True)) > _SWINGS_APART


def _overlooked(puzzle: Puzzle) -> str:
    """Return what is overlooked by who has an input turn fully that swings."""
    if any(puzzle.scene.mechanism.assembly.path.ends):
        return "the limit overlooked: beyond it the loop does not close"
    return "the stroke of the drive overlooked"


def _taken_for_range(puzzle: Puzzle, own: Swing | None) -> Iterator[tuple[str, Swing]]:
    """Yield swings that are taken for the input's own, None where it turns fully, each after its reason."""
    body, info = output_body(puzzle.scene.linkage), puzzle.scene.info
    if body is not None and body.slider is None and body.name not in info.turning_links:
        angles = np.degrees(puzzle.values(f"{body.name}.angle"))
        if np.ptp(angles) > _SWINGS_APART:
            slip = f"the swing of {puzzle.name(body)} taken for that of the input"
            yield slip, (float(angles.min()), float(angles.max()))
    if own is not None:
        yield "the angles counted clockwise", (-own[1], -own[0])
        yield "the swing counted from its own limit", (0.0, own[1] - own[0])
        return
    if body is not None and len(ends := [*_turning_back(puzzle, body)]) == 2:
        yield f"the dead centres of {puzzle.name(body)} taken for limits of the crank", (ends[0], ends[1])
    for _ in range(MOST):
        low = puzzle.random.uniform(-90, 90)
        yield "a limit seen where the loop still closes", (low, low + puzzle.random.uniform(100, 200))


def _why_fully(puzzle: Puzzle) -> str:
    """Return why an input turns fully: by Grashof's sum of a four-bar alone, else by what its dyads keep."""
    info, bar = puzzle.scene.info, four_bar_of(puzzle.scene.mechanism)
    if bar is not None and sum(joint.dyad for joint in puzzle.scene.linkage.joints) == 1:
        if bar.change_points:
            return f"{info.grashof}: where all bars lie in one line it is at a change point, and turns on."
        against = "both links that turn on it" if bar.shortest == "ground" else "it"
        return f"{info.grashof}, and the shortest link is the {bar.shortest}: {against} can turn fully."
    if info.transmission is None:
        slides = any(joint.slides for joint in puzzle.scene.linkage.joints)
        return f"What it drives {'slides as far as it is taken' if slides else 'turns with it all the way'}."
    least = floor(10 * degrees(info.transmission.least)) / 10
    if least > 0:
        return (
            "A loop closes no farther where a transmission angle comes to 0°: here none is ever less than "
            f"{least:.1f}°."
        )
    return "Where its bars come into one line it is at a change point, and turns on."


def _why_swinging(puzzle: Puzzle) -> str:
    """Return why an input swings: what is in its way at both ends."""
    linkage, info = puzzle.scene.linkage, puzzle.scene.info
    clauses = [linkage.joint(end).at_limit for end in puzzle.scene.mechanism.assembly.path.ends if end]
    if not clauses:
        return f"Its stroke is all: {linkage.drive.actuator.at_ends(puzzle.scene.length_unit)}."
    if len(set(clauses)) == 1:
        return f"At both ends {clauses[0]}: beyond that the loop does not close."
    ends = [
        f"at {tenths(degrees(end))} {clause}" for end, clause in zip(info.input_range, clauses, strict=True)
    ]
    return f"The loop does not close farther: {', and '.join(ends)}."


def closure(puzzle: Puzzle) -> QuizQuestion | None:
    """Return on which closure an input that swings comes back; taken wrongly, on the one it came by."""
    info, mechanism = puzzle.scene.info, puzzle.scene.mechanism
    ends = [end for end in zip(info.input_range, mechanism.assembly.path.ends, strict=False) if end[1]]
    if not ends:
        return None
    place, dyad = puzzle.random.choice(ends)
    jump, slip = "No velocity jumps there", "the closure that it came by"
    why = (
        f"The {info.input_name} stands there for an instant, the links do not: they run on to the other side."
    )
    if mechanism.retraced:  # the scene says so, and nothing else would
        jump, slip = "All velocities change their sign there at once", "the closure beyond the limit"
        why = "With all velocities reversed each link goes back the way it came."
    text = (
        f"At {tenths(degrees(place))} {puzzle.scene.linkage.joint(dyad).at_limit}, and the {info.input_name} "
        f"turns back. {jump}. On which closure do the links come back?"
    )
    answers, look = ("on the same closure", "on the other closure"), Look(names=1, ghost=True)
    return puzzle.question("input", text, *either(answers, mechanism.retraced, slip), why, shows=look)


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
    slips = ["the sums compared the wrong way round"] * 2 + [""]
    if right == 2:
        slips = ["equal sums taken for unequal ones"] * 3
    wrong = [QuizAnswer(answers[n], slips[n]) for n in range(3) if n != right]
    s, p, q, longest = map(number, lengths)
    return puzzle.question(
        bar.joint,
        f"The lengths of the four-bar that the input drives, in {puzzle.scene.length_unit}: {_listed(bar)}. "
        "Does a link turn fully against the others?",
        QuizAnswer(answers[right]),
        wrong,
        f"s + l = {s} + {longest} {'<>='[right]} p + q = {p} + {q}.",
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
    slips = {}
    if written[0] != "input":
        slips["input"] = "the input expected as s, whatever its length"
    if written[3] != "ground":
        slips["ground"] = "the ground expected as l, whatever its length"
    places = ("s, the shortest", "one of p and q", "one of p and q", "l, the longest")
    return puzzle.question(
        bar.joint,
        f"Grashof's sums of this four-bar are written as s + l = {s} + {longest} and p + q = {p} + {q}. "
        "Which of these links is in the wrong place?",
        QuizAnswer(right),
        [QuizAnswer(part, slips.get(part, "")) for part in wrong],
        f"The {right} is {places[order.index(right)]}, not {places[written.index(right)]}.",
    )
