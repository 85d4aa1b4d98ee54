"""List the kinds of questions: each made from what is solved, its wrong answers from known misconceptions.

`KINDS` is the one table: the function that makes a question of each kind, and the levels that ask it. Above
it stand these functions: on acceleration, on how a linkage was made, on directions and speeds, on ranges.
"""

from __future__ import annotations

import cmath
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import combinations, pairwise
from math import degrees, floor, hypot, inf, isfinite, pi, tan, tau
from typing import NamedTuple

import numpy as np

from linkanim.mechanics.analysis import SHORTEST, FourBar, four_bar_of
from linkanim.mechanics.linkage import Body, Slide
from linkanim.mechanics.measures import as_output, coupler_body, growth, output_body
from linkanim.mechanics.measures import between as vector_between
from linkanim.mechanics.program import Array
from linkanim.mechanics.search import sign_changes
from linkanim.picture.look import ACCELERATION, VELOCITY, Look
from linkanim.play.question import (
    BESIDE,
    CLEAR,
    MOST,
    PLAIN,
    SIDES,
    TURNS,
    WAYS,
    Puzzle,
    QuizAnswer,
    QuizQuestion,
    angle,
    between,
    crank_degrees,
    either,
    number,
    obliquity,
    quarter,
    swing,
    tenths,
)
from linkanim.scenes.scene import FunctionPurpose, PosesPurpose, TimeRatioPurpose
from linkanim.units import significant, typeset
from linkanim.words import name_said, row_said, said, said_as, sentences, to_say

# What speeds up, and by what: the acceleration, its Coriolis term, its curve, what a doubled speed does.

_BOTH = Look(names=1, vectors=frozenset({VELOCITY, ACCELERATION}))
_SAMPLES = 72
"""The number of values of a curve."""
_APART = 0.3
"""Curves that differ by less than this share of their greatest value could be confused."""
_FACTORS = {
    1: to_say("as large as before"),
    2: to_say("twice as large"),
    4: to_say("four times as large"),
    8: to_say("eight times as large"),
}
_GOES_WITH = {
    1: to_say("how a spring's force changes"),
    2: to_say("how a velocity or a damper's force changes"),
    4: to_say("how an acceleration changes"),
    8: to_say("how the power that accelerates a mass changes"),
}
"""Words for how something changes when the speed doubles, by the factor."""


def speeding(puzzle: Puzzle) -> QuizQuestion | None:
    """Ask whether a joint becomes faster; the slip is to ask whether it accelerates to the right, or up."""
    names = puzzle.clear("velocity")
    puzzle.random.shuffle(names)
    for name in names:
        along = puzzle.value(f"{name}.tangential_acceleration")
        ax, ay = puzzle.pose.acceleration[name]
        gains = isfinite(along) and abs(along) > PLAIN * hypot(ax, ay)
        if gains and puzzle.share(f"{name}.acceleration") > CLEAR:
            part = f"{number(along)} {puzzle.scene.length_unit}/s²"
            why = (
                said(
                    "The part of its acceleration along its velocity, {part}, points the way it moves.",
                    part=part,
                )
                if along > 0
                else said(
                    "The part of its acceleration along its velocity, {part}, points against its velocity.",
                    part=part,
                )
            )
            larger = ax if abs(ax) > abs(ay) else ay
            slip = said("the sign of the acceleration alone, whichever way the point moves")
            return puzzle.question(
                name,
                said("Does {name} speed up or slow down?", name=name),
                *either(
                    (to_say("it speeds up"), to_say("it slows down")),
                    along > 0,
                    slip if (larger > 0) != (along > 0) else "",
                ),
                why,
                shows=_BOTH,
                arrows=[name],
            )
    return None


def doubled(puzzle: Puzzle) -> QuizQuestion | None:
    """Ask how a joint's velocity or acceleration changes when the speed doubles."""
    kind, factor = puzzle.random.choice((("velocity", 2), ("acceleration", 4)))
    names = puzzle.clear(kind)
    if not names:
        return None
    name = puzzle.random.choice(names)
    value = puzzle.value(f"{name}.{kind}")
    unit = f"{puzzle.scene.length_unit}/s{'²' if kind == 'acceleration' else ''}"
    change = {"value": number(value), "grown": number(factor * value), "unit": unit}
    words = _GROWING[kind]
    return _growing(
        puzzle,
        f"{name}.{kind}",
        said(words[0], name=name),
        factor,
        said(words[1], **change),
    )


_GROWING = {
    "velocity": (
        to_say("How large is the velocity of {name} in the same position?"),
        to_say("It is proportional to the speed itself: {value} becomes {grown} {unit}."),
    ),
    "acceleration": (
        to_say("How large is the acceleration of {name} in the same position?"),
        to_say("It is proportional to the square of the speed: {value} becomes {grown} {unit}."),
    ),
}


def force(puzzle: Puzzle) -> QuizQuestion | None:
    """Ask how a force changes when the speed doubles: a spring's, a damper's, or that on a mass."""
    known = puzzle.scene.linkage
    clear = []
    for items, factor in ((known.springs, 1), (known.dampers, 2)):
        for item in items:
            if item.forceful and abs(puzzle.share(f"{item.name}.force")) > PLAIN:
                clear.append((item, factor, abs(puzzle.value(f"{item.name}.force"))))
    if clear:
        item, factor, value = puzzle.random.choice(clear)
        why = said(
            "It depends on the length alone, which is the same there: it stays {value} N.",
            value=number(value),
        )
        if factor == 2:
            why = said(
                "It is proportional to the speed: {value} N becomes {grown} N.",
                value=number(value),
                grown=number(factor * value),
            )
        return _growing(
            puzzle,
            item.name,
            said(
                "How large is the force of the {strut} in the same position?",
                strut=known.strut_words(item),
            ),
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
        said("How large is the force that accelerates a mass at {name}, in the same position?", name=name),
        4,
        said("It is proportional to the acceleration, and so to the square of the speed."),
    )


def _growing(
    puzzle: Puzzle, subject: str, text: str, factor: int, why: str, shows: Look = _BOTH
) -> QuizQuestion:
    """Return a question on what a doubled speed does."""
    return puzzle.question(
        subject,
        sentences(said("The input runs twice as fast."), text),
        QuizAnswer(said(_FACTORS[factor]), alphabet=_FACTORS[factor]),
        [
            QuizAnswer(said(words), said(_GOES_WITH[one]), alphabet=words)
            for one, words in _FACTORS.items()
            if one != factor
        ],
        why,
        shuffled=True,
        shows=shows,
        arrows=[name for name in [subject.partition(".")[0]] if name in puzzle.pose.position],
    )


_ORDERS = ("position", "velocity", "acceleration")
_SLIDING = {
    "velocity": to_say("Over one period, which curve is the velocity of {name} along its guide?"),
    "acceleration": to_say("Over one period, which curve is the acceleration of {name} along its guide?"),
}
_TURNING = {
    "velocity": to_say("Over one period, which curve is the angular velocity of {name}?"),
    "acceleration": to_say("Over one period, which curve is the angular acceleration of {name}?"),
}


def curves(puzzle: Puzzle) -> QuizQuestion | None:
    """Ask which of three curves is the output's velocity or acceleration; wrong answers are the others."""
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
            said("curve {number}", number=order.index(n) + 1),
            said("the {one} taken for the {other}", one=said(_ORDERS[n]), other=said(right))
            if n != which
            else "",
            curve=tuple(round(float(value), 3) for value in part),
            alphabet=f"curve {order.index(n) + 1}",
        )
        for n, part in enumerate(scaled)
    ]
    token = f"{body.name}.{tokens[which]}"
    return puzzle.question(
        token,
        said((_SLIDING if body.slider else _TURNING)[right], name=puzzle.name(body)),
        answers.pop(which),
        answers,
        said(
            "Where the {one} has its extremes, the {other}, its slope, is zero.",
            one=said(_ORDERS[which - 1]),
            other=said(right),
        ),
        shows=Look(names=1, chart=token),
    )


def _distinct(puzzle: Puzzle, columns: Sequence[Array]) -> list[Array] | None:
    """Return a value and its two rates over a period of time, each scaled to a greatest size of 1.

    None where curves look alike, where one is unbounded or always 0, or where the value grows from turn to
    turn.
    """
    step = max(len(puzzle.cycle.phase) // _SAMPLES, 1)
    value, *rates = (column[::step] for column in columns)
    if not all(np.isfinite(part).all() and np.ptp(part) > 0.0 for part in (value, *rates)):
        return None
    value = value - (value.max() + value.min()) / 2
    if abs(float(value[-1] - value[0])) > 0.5 * float(np.ptp(value)):
        return None  # the body turns fully: its angle grows without end
    sense = -1 if puzzle.scene.linkage.drive.speed < 0 else 1
    scaled = [part[::sense] / np.abs(part).max() for part in (value, *rates)]
    alike = (float(np.abs(one - other).max()) < _APART for one, other in combinations(scaled, 2))
    return None if any(alike) else scaled


def coriolis(puzzle: Puzzle) -> QuizQuestion | None:
    """Ask whether a sliding point has a Coriolis acceleration, which it has only where its guide turns."""
    sliding = list(_sliding(puzzle))
    if not sliding:
        return None
    joint, guide, turns = puzzle.random.choice(sliding)
    why = (
        said("The guide turns while {joint} slides along it: 2ω × v is not zero.", joint=joint)
        if turns
        else said("The guide does not turn: ω is zero, and 2ω × v with it.")
    )
    slip = (
        said("the guide's turning overlooked") if turns else said("sliding alone taken for a Coriolis term")
    )
    return puzzle.question(
        joint,
        said(
            "{joint} slides along {guide}. Seen from that guide, does the acceleration of "
            "{joint} have a Coriolis term?",
            joint=joint,
            guide=guide,
        ),
        *either((to_say("yes"), to_say("no")), turns, slip),
        why,
        shows=_BOTH,
        arrows=[joint],
    )


def _sliding(puzzle: Puzzle) -> Iterator[tuple[str, str, bool]]:
    """Yield joints that clearly slide, each with words for its guide, and whether that clearly turns."""
    linkage = puzzle.scene.linkage
    for slide in (slide for joint in linkage.joints for slide in joint.slides):
        if linkage.joint(slide.point).fixed or not _slides(puzzle, slide):
            continue
        if slide.start is None:
            yield slide.point, said("a fixed line"), False
        elif slide.axis is None:
            yield slide.point, said("the slot at {start}", start=slide.start), False
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
    for motion in (puzzle.cycle, puzzle.pose):
        apart, moving = (vector_between(vectors, ends) for vectors in (motion.position, motion.velocity))
        rates.append(np.abs(as_output(motion, growth(apart, moving), "{}/s", 1)))
    return bool(rates[1] > PLAIN * float(np.nanmax(rates[0])))


# How a linkage was made: the pole of two of its poses, a time ratio's slow stroke, precision points.

_FAR = 3.0
"""A pole farther away than this, in distances of the poses, is not asked for."""
_DIGITS = 4


def pole(puzzle: Puzzle) -> QuizQuestion | None:
    """Ask about which point a turn takes one pose to another; wrong answers: other poles, or the middle."""
    purpose = puzzle.scene.purpose
    if not isinstance(purpose, PosesPurpose) or not puzzle.scene.trace:
        return None
    origins = [complex(x, y) for x, y, _ in purpose.poses]
    size = max(abs(one - other) for one, other in combinations(origins, 2))
    pairs = list(combinations(range(len(origins)), 2))
    poles = {pair: _pole(purpose, *pair) for pair in pairs}
    near = [pair for pair in pairs if abs(poles[pair] - origins[pair[0]]) <= _FAR * size]
    if not near:
        return None
    one, other = puzzle.random.choice(near)
    middle = (origins[one] + origins[other]) / 2
    tries = [(2 * middle - poles[one, other], said("the turn taken the other way round"))]
    tries += [(middle, said("the middle between the places, about which it would turn by half a turn"))]
    tries += [
        (poles[pair], said("the pole of poses {one} and {other}", one=pair[0] + 1, other=pair[1] + 1))
        for pair in near
        if pair != (one, other)
    ]
    places = [poles[one, other]]
    wrong: list[QuizAnswer] = []
    for place, slip in tries:
        if len(wrong) < MOST - 1 and all(abs(place - known) > CLEAR * size for known in places):
            places.append(place)
            wrong.append(QuizAnswer(_place(puzzle, place), slip))
    if len(wrong) < 2:
        return None
    first, second = (_pose(puzzle, purpose.poses[n]) for n in (one, other))
    return puzzle.question(
        next(body.name for body in puzzle.scene.linkage.bodies if puzzle.scene.trace[0] in body.joints),
        said(
            "A body is taken from the pose at {first} to that at {second} by one turn: about which point?",
            first=first,
            second=second,
        ),
        QuizAnswer(_place(puzzle, poles[one, other])),
        wrong,
        said(
            "The pole lies on the perpendicular bisector of the two places, {distance} {unit} "
            "from its middle: half their distance times the cotangent of half the turn.",
            distance=number(abs(poles[one, other] - middle)),
            unit=puzzle.scene.length_unit,
        ),
        shuffled=True,
    )


def _pole(purpose: PosesPurpose, one: int, other: int) -> complex:
    """Return the pole of two poses, infinite where they are parallel."""
    (x, y, first), (u, v, second) = purpose.poses[one], purpose.poses[other]
    turned = cmath.rect(1.0, second - first)
    if abs(turned - 1) < CLEAR:
        return complex(inf, inf)
    return (complex(x, y) + complex(u, v)) / 2 + 0.5j * complex(u - x, v - y) / tan((second - first) / 2)


def _place(puzzle: Puzzle, place: complex) -> str:
    return f"({number(place.real)}, {number(place.imag)}) {puzzle.scene.length_unit}"


def _pose(puzzle: Puzzle, pose: tuple[float, float, float]) -> str:
    x, y, turned = pose
    return said(
        "{place}, turned by {angle},", place=_place(puzzle, complex(x, y)), angle=tenths(degrees(turned))
    )


def slow_way(puzzle: Puzzle) -> QuizQuestion | None:
    """Ask how far the crank turns during the output's slow stroke; a wrong answer is the quick one."""
    purpose = puzzle.scene.purpose
    if not isinstance(purpose, TimeRatioPurpose) or purpose.ratio < 1 + 10 * CLEAR:
        return None
    ratio = purpose.ratio
    slow, quick = 360 * ratio / (1 + ratio), 360 / (1 + ratio)
    beyond = slow - 180
    tries = {
        quick: said("the quick stroke taken for the slow one"),
        180 * ratio: said("half a turn times the time ratio"),
        180 + beyond / 2: said("the angle between the directions of the dead centres halved"),
    }
    wrong = [QuizAnswer(angle(value), slip) for value, slip in tries.items() if value < 360]
    return puzzle.question(
        "input",
        said(
            "The output's slow stroke takes {ratio} times as long as its quick stroke. By how "
            "much does the crank turn during the slow one?",
            ratio=number(ratio),
        ),
        QuizAnswer(angle(slow)),
        wrong,
        said(
            "Both strokes together are a whole turn, in this ratio: {slow} and {quick}.",
            slow=tenths(slow),
            quick=tenths(quick),
        ),
        shuffled=True,
    )


def precision_point(puzzle: Puzzle) -> QuizQuestion | None:
    """Ask where a linkage gives its function exactly; wrong answers lie between two such points."""
    purpose = puzzle.scene.purpose
    if not isinstance(purpose, FunctionPurpose) or len(purpose.x) < 3:
        return None
    right = puzzle.random.choice(purpose.x)
    middles = [(low + high) / 2 for low, high in pairwise(purpose.x)]
    puzzle.random.shuffle(middles)
    texts = [_at(x) for x in (right, *middles)]
    if len(set(texts)) < len(texts):
        return None
    slip = said("a place between two precision points, where the error is near an extreme")
    shown = row_said([*map(_at, purpose.x)])
    return puzzle.question(
        "input",
        said("Made for {function}: where is the linkage's structural error zero?", function=purpose.words),
        QuizAnswer(_at(right)),
        [QuizAnswer(_at(x), slip) for x in middles[: MOST - 1]],
        said("Its precision points are {shown}; between them the error changes its sign.", shown=shown),
        shuffled=True,
    )


def _at(x: float) -> str:
    return f"x = {typeset(significant(x, _DIGITS))}"


# Directions and speeds: turning, the fastest point, the heading, the instant centre.

_OBLIQUE = pi / 6
"""A heading farther than this from a compass point (rad) is between two compass points."""
_NEAR = 0.08
"""Places nearer to each other than this, in sizes of the linkage, could be confused."""
_ARROWS = Look(names=1, vectors=frozenset({VELOCITY}))


def turning(puzzle: Puzzle) -> QuizQuestion | None:
    """Ask in which direction a link turns; the slip is to take the input's direction."""
    clear = [body for body in puzzle.turning if abs(puzzle.share(f"{body.name}.angular_velocity")) > PLAIN]
    if not clear:
        return None
    body = puzzle.random.choice(clear)
    rate = puzzle.value(f"{body.name}.angular_velocity")
    against = puzzle.scene.linkage.drive.coordinate.is_angle and puzzle.pose.coordinate_rate * rate < 0
    slip = (
        said("the input's direction, passed on along the chain")
        if against
        else said("the way it turns when the input runs backwards")
    )
    misled = said("The input turns the other way: a chain does not hand on directions.") if against else ""
    return puzzle.question(
        body.name,
        said("Which way does {name} turn?", name=puzzle.name(body)),
        *either(TURNS, rate > 0, slip),
        sentences(_why_turning(puzzle, body, rate), misled),
        shows=_ARROWS,
        arrows=body.joints,
    )


def _why_turning(puzzle: Puzzle, body: Body, rate: float) -> str:
    """Return why a body turns as it does: by how one joint moves about another, a fixed one if any."""
    is_fixed = {name: puzzle.scene.linkage.joint(name).fixed for name in body.joints[:2]}
    first, second = sorted(is_fixed, key=lambda name: not is_fixed[name])
    place, moving = (
        quarter(puzzle.vector(kind, second) - puzzle.vector(kind, first)) for kind in ("position", "velocity")
    )
    lies = said(SIDES[place], name=second, other=first)
    if not is_fixed[first]:
        lies = said(BESIDE[place], name=second, other=first)
    turns = said(
        "{name} turns {way}, at {rate} rad/s",
        name=puzzle.name(body),
        way=said(TURNS[rate < 0]),
        rate=number(abs(rate)),
    )
    return said("{lies} and moves {way}: {turns}.", lies=lies, way=said(WAYS[moving]), turns=turns)


def fastest(puzzle: Puzzle) -> QuizQuestion | None:
    """Ask which joint is fastest; wrong answers take the input's, or the joint that is farthest out."""
    speeds = {name: puzzle.value(f"{name}.velocity") for name in puzzle.joints}
    greatest = max((value for value in speeds.values() if isfinite(value)), default=0.0)
    chosen: list[str] = []
    for name in puzzle.random.sample(list(speeds), len(speeds)):
        clear = all(abs(speeds[name] - speeds[other]) > 2 * CLEAR * greatest for other in chosen)
        if clear and 2 * CLEAR * greatest < speeds[name] < inf and len(chosen) < MOST:
            chosen.append(name)
    if len(chosen) < 2:
        return None
    first, *others = sorted(chosen, key=lambda name: -speeds[name])
    unit = puzzle.scene.length_unit
    listed = said_as("list", ", ").join(
        f"{name} {number(speeds[name])} {unit}/s" for name in (first, *others)
    )
    places = puzzle.pose.position
    slips = dict(_taken_for_fastest(puzzle, chosen))
    return puzzle.question(
        "velocity",
        said("Which of these points moves fastest?"),
        QuizAnswer(first, place=places[first]),
        [QuizAnswer(name, slips.get(name, ""), places[name]) for name in others],
        sentences(_why_faster(puzzle, first, others), said("The speeds: {speeds}.", speeds=listed)),
        shows=_ARROWS,
        arrows=chosen,
    )


def _taken_for_fastest(puzzle: Puzzle, names: list[str]) -> Iterator[tuple[str, str]]:
    """Yield joints that may wrongly be taken for the fastest, and why."""
    linkage = puzzle.scene.linkage
    if linkage.drive.coordinate.is_angle:
        pivot = linkage.driven.pivot
        ways = {name: abs(puzzle.apart(pivot, name)) for name in names}
        *_, next_to, far = sorted(names, key=lambda name: ways[name])
        if ways[far] - ways[next_to] > CLEAR * ways[far]:
            yield far, said("the point farthest from {pivot}, taken for the fastest", pivot=pivot)
    yield linkage.drive.joint, said("the input taken for the fastest: a chain of links can speed up")


def _why_faster(puzzle: Puzzle, first: str, others: list[str]) -> str:
    """Return why a joint is faster than the next fastest on a body with it; "" where there is none."""
    shared = ((name, body) for name in others for body in puzzle.bodies_of(first, name))
    for name, body in shared:
        centre, about = puzzle.centre_of(body)
        far, close = (abs(puzzle.vector("position", joint) - centre) for joint in (first, name))
        if CLEAR * far < close < inf:
            times = number(round(far / close, 2))
            return said(
                "{first} and {name} turn with the same ω about {about}, and {first} is {times} times "
                "as far from it.",
                first=first,
                name=name,
                about=about,
                times=times,
            )
    return ""


def heading(puzzle: Puzzle) -> QuizQuestion | None:
    """Ask in which direction a joint moves; wrong answers are back, along its link, or its acceleration.

    For a joint on a fixed guide the only answers are the two directions of the guide.
    """
    names = puzzle.clear("velocity")
    puzzle.random.shuffle(names)
    for name in names:
        velocity = puzzle.vector("velocity", name)
        if obliquity(velocity) > _OBLIQUE:
            continue
        correct = quarter(velocity)
        possible = (correct, (correct + 2) % 4) if _is_guided(puzzle, name) else range(4)
        slips = dict(_taken_for_heading(puzzle, name, correct))
        return puzzle.question(
            name,
            said("Which way does {name} move?", name=name),
            QuizAnswer(said(WAYS[correct]), alphabet=WAYS[correct]),
            [QuizAnswer(said(WAYS[n]), slips.get(n, ""), alphabet=WAYS[n]) for n in possible if n != correct],
            _why_heading(puzzle, name),
            shows=_ARROWS,
            arrows=[name],
        )
    return None


def _is_guided(puzzle: Puzzle, name: str) -> bool:
    """Return whether a joint slides along a fixed line."""
    slides = puzzle.scene.linkage.joint(name).slides
    return any(slide.point == name and slide.start is None for slide in slides)


def _taken_for_heading(puzzle: Puzzle, name: str, correct: int) -> Iterator[tuple[int, str]]:
    """Yield directions that may wrongly be taken for a joint's heading, and why; later ones prevail."""
    pin = puzzle.pivot_of(name)
    if pin is not None:
        along = quarter(puzzle.apart(pin, name))
        yield from ((n % 4, said("along its link, not across")) for n in (along, along + 2))
    yield (correct + 2) % 4, said("the way it moves when the input runs backwards")
    acceleration = puzzle.vector("acceleration", name)
    known = isfinite(abs(acceleration)) and puzzle.share(f"{name}.acceleration") > CLEAR
    if known and obliquity(acceleration) < _OBLIQUE:
        yield quarter(acceleration), said("the acceleration taken for the velocity")


def _why_heading(puzzle: Puzzle, name: str) -> str:
    """Return why a joint moves as it does: by the bar that pushes it, or by its link's instant centre."""
    velocity = puzzle.vector("velocity", name)
    speed = f"{number(abs(velocity))} {puzzle.scene.length_unit}/s"
    moves = said("{way}, at {speed}", way=said(WAYS[quarter(velocity)]), speed=speed)
    joint = puzzle.scene.linkage.joint(name)
    if _is_guided(puzzle, name):
        for end, _ in joint.bars:
            towards = (puzzle.apart(end, name).conjugate() * puzzle.vector("velocity", end)).real
            return said(_PUSHES if towards > 0 else _PULLS, end=end, name=name, moves=moves)
        return said("It slides along its guide, {moves}.", moves=moves)
    pin = puzzle.pivot_of(name)
    centres = (
        [(puzzle.vector("position", pin), pin)] if pin else map(puzzle.centre_of, puzzle.bodies_of(name))
    )
    for centre, about in centres:
        arm = puzzle.vector("position", name) - centre
        if 0 < abs(arm) < inf:
            turns = said(TURNS[(arm.conjugate() * velocity).imag < 0])
            return said(_LIES[quarter(arm)], turns=turns, about=about, moves=moves)
    carried = next((puzzle.name(body) for body in puzzle.bodies_of(name)), "")
    if carried:
        return said(
            "At this instant {carried} does not turn: all its points move alike, {name} {moves}.",
            carried=carried,
            name=name,
            moves=moves,
        )
    if bars := row_said([f"{end}–{name}" for end, _ in joint.bars]):
        known = {"bars": bars, "name": name, "moves": moves}
        return said("Only this keeps the lengths of the bars {bars}: {name} moves {moves}.", **known)
    return said("It is carried along: {name} moves {moves}.", name=name, moves=moves)


_PUSHES = to_say(
    "{end} moves the bar {end}–{name} towards {name}: it pushes {name} along the guide, {moves}."
)
_PULLS = to_say(
    "{end} moves the bar {end}–{name} away from {name}: it pulls {name} along the guide, {moves}."
)
_LIES = (
    to_say("It turns {turns} about {about} and lies to the right of it: so it moves {moves}."),
    to_say("It turns {turns} about {about} and lies above it: so it moves {moves}."),
    to_say("It turns {turns} about {about} and lies to the left of it: so it moves {moves}."),
    to_say("It turns {turns} about {about} and lies below it: so it moves {moves}."),
)


def instant_centre(puzzle: Puzzle) -> QuizQuestion | None:
    """Ask where a coupler's instant centre is; wrong answers are a joint, a pin or half-way."""
    body = coupler_body(puzzle.scene.linkage)
    if body is None or abs(puzzle.share(f"{body.name}.angular_velocity")) < PLAIN:
        return None
    centre, _ = puzzle.centre_of(body)
    box, size = puzzle.figure.box, puzzle.figure.extent
    if not (abs(centre) < inf and abs(centre - complex(*box.middle)) < size):
        return None
    ends = [puzzle.vector("position", name) for name in body.joints[:2]]
    places = {puzzle.vector("position", name): name for name in puzzle.figure.in_view}
    half = sum(ends) / 2
    points = _apart([centre, half, *ends, *places], _NEAR * size)[:MOST]
    if len(points) < 3:
        return None
    slips = {place: _taken_for_pole(puzzle, name) for place, name in places.items()}
    slips[half] = said("the middle of the link taken for the pole")
    slips[min(ends, key=lambda end: abs(end - centre))] = said("the nearer joint taken for the pole")
    slips[centre] = ""
    unit = puzzle.scene.length_unit
    right, *wrong = (
        QuizAnswer(
            f"({number(point.real)}, {number(point.imag)}) {unit}",
            slips.get(point, ""),
            (point.real, point.imag),
        )
        for point in points
    )
    return puzzle.question(
        body.name,
        said("Where is the instant centre of {name}?", name=puzzle.name(body)),
        right,
        wrong,
        _why_pole(puzzle, body, centre),
        shows=Look(names=1, vectors=frozenset({VELOCITY}), centres=1),
        arrows=body.joints,
        shuffled=True,
        stops=puzzle.phase,
    )


def _why_pole(puzzle: Puzzle, body: Body, centre: complex) -> str:
    """Return why a body's instant centre is there, by the velocities of its first two joints."""
    one, other = body.joints[:2]
    arms = [puzzle.vector("position", name) - centre for name in (one, other)]
    still = said("the point of {name} there is at rest at this instant.", name=puzzle.name(body))
    if abs((arms[0].conjugate() * arms[1]).imag) > CLEAR * abs(arms[0] * arms[1]):
        return said(
            "The normals to the velocities of {one} and {other} meet there: {still}",
            one=one,
            other=other,
            still=still,
        )
    return said(
        "Along the line through {one} and {other} the velocities fall to zero there: {still}",
        one=one,
        other=other,
        still=still,
    )


def _taken_for_pole(puzzle: Puzzle, name: str) -> str:
    """Return in words how a joint is wrongly taken for the pole of a moving link."""
    if puzzle.scene.linkage.joint(name).fixed:
        return said("a fixed pin, about which another link turns")
    return said("a joint that moves, taken for the pole") if puzzle.share(f"{name}.velocity") > CLEAR else ""


def _apart(points: Iterable[complex], least: float) -> list[complex]:
    """Return the points that are at least that far from each one before them."""
    apart: list[complex] = []
    for point in points:
        if all(abs(point - other) > least for other in apart):
            apart.append(point)
    return apart


# How far things go: dead centres, the input's range, closures beyond a limit, Grashof's sum.

_ANSWERS_APART = 20.0
"""Crank angles farther apart than this, in degrees, cannot be confused."""
_SWINGS_APART = 5.0
"""Ends of swings farther apart than this, in degrees, cannot be confused."""
_FULL = to_say("it turns fully")
_IN_LINE = 1e-6
"""Two bars are in one line where the sine of the angle between them is below this."""
Swing = tuple[float, float]
"""The two ends of a swing, in degrees."""


def dead_centre(puzzle: Puzzle) -> QuizQuestion | None:
    """Ask at which crank angle the output turns back; a wrong answer is where it is fastest."""
    body = output_body(puzzle.scene.linkage)
    exact = _turning_back(puzzle, body) if body else {}
    if body is None or not exact:
        return None
    right = puzzle.random.choice([*exact])
    rates = puzzle.values(_rate_of(body))
    fast = crank_degrees(puzzle, float(puzzle.cycle.phase[int(abs(rates).argmax())]))
    slips = {(one + 180) % 360: said("the other dead centre, taken to lie half a turn on") for one in exact}
    slips[fast] = said("the greatest speed taken for the dead centre")
    wrong: list[float] = []
    for one in (fast, *slips, *(puzzle.random.uniform(0, 360) for _ in range(20))):
        if all(between(one, other) > _ANSWERS_APART for other in (*exact, *wrong)) and len(wrong) < MOST - 1:
            wrong.append(one)
    if len(wrong) < 2:
        return None
    return puzzle.question(
        body.name,
        said("At which crank angle does {name} turn back?", name=puzzle.name(body)),
        QuizAnswer(angle(right)),
        [QuizAnswer(angle(one), slips.get(one, "")) for one in wrong],
        said(
            "Its velocity changes its sign at {angles}{in_line}.",
            angles=row_said([*map(angle, exact)]),
            in_line=_in_line(puzzle, body, exact),
        ),
        shuffled=True,
        shows=Look(names=1, chart=_rate_of(body)),
        stops=exact[right],
    )


def _rate_of(body: Body) -> str:
    """Return the token of a body's angular velocity, or of a slider's velocity."""
    return f"{body.name}.{'travel_velocity' if body.slider else 'angular_velocity'}"


def _turning_back(puzzle: Puzzle, body: Body) -> dict[float, float]:
    """Return the crank angles at which a body turns back, in degrees, each with its phase.

    It is empty where the input does not turn fully, or turns more than once in a true period.
    """
    scene, samples = puzzle.scene, len(puzzle.cycle.phase)
    if not scene.info.full_turn or scene.period > tau * 1.001:
        return {}
    # once round, half a sample off 0: many bodies turn back at a phase of 0
    once_round = scene.period * (np.arange(samples + 1) + 0.5) / samples
    rate = scene.quantities[_rate_of(body)]
    reversals = sign_changes(
        lambda phases: np.asarray(rate.read(scene.solve(phase=phases, derivatives=1))), once_round
    )
    return dict(sorted((crank_degrees(puzzle, float(phase)), float(phase)) for phase in reversals))


def _in_line(puzzle: Puzzle, body: Body, exact: Mapping[float, float]) -> str:
    """Return, after a colon, which bar is in line with the crank as the output turns back; "" if none."""
    linkage = puzzle.scene.linkage
    pin = linkage.drive.joint
    pivot = linkage.driven.pivot
    poses = [puzzle.scene.pose(phase, 0).position for phase in exact.values()]
    for name in (body.slider, *body.joints):
        if name and pin in (end for end, _ in linkage.joint(name).bars):
            ways = [[complex(*pose[joint]) for joint in (pivot, pin, name)] for pose in poses]
            turns = [(c - b) * (b - a).conjugate() for a, b, c in ways]
            if all(abs(turn.imag) < _IN_LINE * abs(turn) for turn in turns):
                return said(
                    ": there {pivot}–{pin} and {pin}–{name} lie in one line", pivot=pivot, pin=pin, name=name
                )
    return ""


def input_range(puzzle: Puzzle) -> QuizQuestion | None:
    """Ask whether the input turns fully, or how it swings; wrong answers are other swings."""
    info = puzzle.scene.info
    if not puzzle.scene.linkage.drive.coordinate.is_angle:
        return None
    own = None if info.full_turn else (degrees(info.input_range[0]), degrees(info.input_range[1]))
    wrong = [] if own is None else [QuizAnswer(said(_FULL), _overlooked(puzzle), alphabet=_FULL)]
    swings = [] if own is None else [own]
    for slip, other in _taken_for_range(puzzle, own):
        if len(wrong) == MOST - 1:
            break
        if all(_are_apart(one, other) for one in swings):
            swings.append(other)
            wrong.append(swing(*other, slip))
    right = QuizAnswer(said(_FULL), alphabet=_FULL) if own is None else swing(*own)
    text = said("How far can the {link} turn?", link=info.input_said)
    why = _why_fully(puzzle) if own is None else _why_swinging(puzzle)
    return puzzle.question("input", text, right, wrong, why, shuffled=True)


def _are_apart(one: Swing, other: Swing) -> bool:
    """Return whether two swings cannot be confused."""
    return max(between(a, b) for a, b in zip(one, other, strict=True)) > _SWINGS_APART


def _overlooked(puzzle: Puzzle) -> str:
    """Return in words what a full turn of an input that swings would overlook."""
    if any(puzzle.scene.mechanism.stops):
        return said("the limit overlooked: beyond it the loop does not close")
    return said("the stroke of the drive overlooked")


def _taken_for_range(puzzle: Puzzle, own: Swing | None) -> Iterator[tuple[str, Swing]]:
    """Yield reasons and swings that may wrongly be taken for the input's `own`, None for a full turn."""
    body, info = output_body(puzzle.scene.linkage), puzzle.scene.info
    if body is not None and body.slider is None and body.name not in info.turning_links:
        angles = np.degrees(puzzle.values(f"{body.name}.angle"))
        if np.ptp(angles) > _SWINGS_APART:
            slip = said("the swing of {name} taken for that of the input", name=puzzle.name(body))
            yield slip, (float(angles.min()), float(angles.max()))
    if own is not None:
        yield said("the angles counted clockwise"), (-own[1], -own[0])
        yield said("the swing counted from its own limit"), (0.0, own[1] - own[0])
        return
    if body is not None and len(ends := [*_turning_back(puzzle, body)]) == 2:
        yield (
            said("the dead centres of {name} taken for limits of the crank", name=puzzle.name(body)),
            (ends[0], ends[1]),
        )
    for _ in range(MOST):
        low = puzzle.random.uniform(-90, 90)
        yield said("a limit seen where the loop still closes"), (low, low + puzzle.random.uniform(100, 200))


def _why_fully(puzzle: Puzzle) -> str:
    """Return why an input turns fully: by Grashof's sum for a single four-bar, else by its dyads."""
    info, bar = puzzle.scene.info, four_bar_of(puzzle.scene.mechanism)
    if bar is not None and sum(joint.dyad for joint in puzzle.scene.linkage.joints) == 1:
        if bar.change_points:
            return said(
                "{sums}: where all bars lie in one line it is at a change point, and turns on.",
                sums=info.grashof,
            )
        if bar.shortest == "ground":
            return said(
                "{sums}, and the shortest link is the ground: both links that turn on it can turn fully.",
                sums=info.grashof,
            )
        return said(
            "{sums}, and the shortest link is {shortest}: it can turn fully.",
            sums=info.grashof,
            shortest=said(SHORTEST[bar.shortest]),
        )
    if info.transmission is None:
        slides = any(joint.slides for joint in puzzle.scene.linkage.joints)
        if slides:
            return said("What it drives slides as far as it is taken.")
        return said("What it drives turns with it all the way.")
    least = floor(10 * degrees(info.transmission.least)) / 10
    if least > 0:
        return said(
            "A loop closes no farther where a transmission angle comes to 0°: here none is ever "
            "less than {least}°.",
            least=f"{least:.1f}",
        )
    return said("Where its bars come into one line it is at a change point, and turns on.")


def _why_swinging(puzzle: Puzzle) -> str:
    """Return why an input swings: what stops it at both ends."""
    linkage, info = puzzle.scene.linkage, puzzle.scene.info
    clauses = [linkage.joint(end).at_limit for end in puzzle.scene.mechanism.stops if end]
    if not clauses:
        ends = linkage.drive.actuator.at_ends(puzzle.scene.length_unit)
        return said("Its stroke is all: {ends}.", ends=ends)
    if len(set(clauses)) == 1:
        return said("At both ends {clause}: beyond that the loop does not close.", clause=clauses[0])
    one, other = (
        said("at {angle} {clause}", angle=tenths(degrees(end)), clause=clause)
        for end, clause in zip(info.input_range, clauses, strict=True)
    )
    return said("The loop does not close farther: {one}, and {other}.", one=one, other=other)


def closure(puzzle: Puzzle) -> QuizQuestion | None:
    """Ask on which closure an input that swings comes back; the slip is to take the one by which it came."""
    info, mechanism = puzzle.scene.info, puzzle.scene.mechanism
    ends = [end for end in zip(info.input_range, mechanism.stops, mechanism.keeps, strict=False) if end[1]]
    if not ends:
        return None
    place, dyad, kept = puzzle.random.choice(ends)
    jump, slip = said("No velocity jumps there"), said("the closure that it came by")
    why = said(
        "The {link} stands there for an instant, the links do not: they run on to the other side.",
        link=info.input_said,
    )
    if kept:  # the scene's statement makes it so, or a dyad down the chain, which cannot be seen
        jump, slip = (
            said("All velocities change their sign there at once"),
            said("the closure beyond the limit"),
        )
        why = said("With all velocities reversed each link goes back the way it came.")
    text = said(
        "At {angle} {clause}, and the {link} turns back. {jump}. On which closure do the links come back?",
        angle=tenths(degrees(place)),
        clause=puzzle.scene.linkage.joint(dyad).at_limit,
        link=info.input_said,
        jump=jump,
    )
    answers, look = (to_say("on the same closure"), to_say("on the other closure")), Look(names=1, ghost=True)
    return puzzle.question("input", text, *either(answers, kept, slip), why, shows=look)


def grashof(puzzle: Puzzle) -> QuizQuestion | None:
    """Ask what Grashof's sum says of the four-bar that the input drives."""
    bar = four_bar_of(puzzle.scene.mechanism)
    if bar is None:
        return None
    lengths = sorted(bar.links.values())
    if 0 < abs(bar.margin) < CLEAR * lengths[-1]:
        return None
    answers = (
        to_say("a link turns fully: s + l < p + q"),
        to_say("no link turns fully: s + l > p + q"),
        to_say("s + l = p + q: a change point"),
    )
    right = 2 if bar.margin == 0 else 0 if bar.margin > 0 else 1
    slips = [said("the sums compared the wrong way round")] * 2 + [""]
    if right == 2:
        slips = [said("equal sums taken for unequal ones")] * 3
    wrong = [QuizAnswer(said(answers[n]), slips[n], alphabet=answers[n]) for n in range(3) if n != right]
    s, p, q, longest = map(number, lengths)
    return puzzle.question(
        bar.joint,
        said(
            "The lengths of the four-bar that the input drives, in {unit}: {lengths}. Does "
            "a link turn fully against the others?",
            unit=puzzle.scene.length_unit,
            lengths=_listed(bar),
        ),
        QuizAnswer(said(answers[right]), alphabet=answers[right]),
        wrong,
        said("{found}.", found=f"s + l = {s} + {longest} {'<>='[right]} p + q = {p} + {q}"),
    )


def _listed(bar: FourBar) -> str:
    return said_as("list", ", ").join(
        f"{name_said(part)} {number(length)}" for part, length in bar.links.items()
    )


def grashof_sum(puzzle: Puzzle) -> QuizQuestion | None:
    """Ask which link is in the wrong one of Grashof's sums; the wrong answers are links in the right one."""
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
    s, p, q, longest = (f"{number(bar.links[part])} ({name_said(part)})" for part in written)
    right = order[puzzle.random.choice((one, other))]
    wrong = [order[n] for n in range(4) if n not in (one, other)]
    slips = {}
    if written[0] != "input":
        slips["input"] = said("the input taken for the shortest, whatever its length")
    if written[3] != "ground":
        slips["ground"] = said("the ground taken for the longest, whatever its length")
    middle = said("one of p and q")
    places = (said("s, the shortest"), middle, middle, said("l, the longest"))
    return puzzle.question(
        bar.joint,
        said(
            "Grashof's sums of this four-bar are written as s + l = {s} + {longest} and p + q = "
            "{p} + {q}. Which of these links belongs to the other sum?",
            s=s,
            longest=longest,
            p=p,
            q=q,
        ),
        QuizAnswer(name_said(right), alphabet=right),
        [QuizAnswer(name_said(part), slips.get(part, ""), alphabet=part) for part in wrong],
        said(
            "The {link} is {place}, not {other}.",
            link=name_said(right),
            place=places[order.index(right)],
            other=places[written.index(right)],
        ),
    )


# The one table of kinds: what makes a question of each, and at which levels it is asked.


class QuestionKind(NamedTuple):
    """The function that makes a question of a kind, or None where a puzzle has none, and the kind's levels.

    A kind `of_making` is about what a linkage was made for, and is asked of a scene that states that.
    """

    make: Callable[[Puzzle], QuizQuestion | None]
    levels: tuple[int, ...]
    of_making: bool = False


KINDS: Mapping[str, QuestionKind] = {
    "turning": QuestionKind(turning, (1,)),
    "fastest": QuestionKind(fastest, (1, 2)),
    "heading": QuestionKind(heading, (1, 2)),
    "input range": QuestionKind(input_range, (1, 2)),
    "doubled": QuestionKind(doubled, (1, 2)),
    "grashof": QuestionKind(grashof, (1, 2)),
    "speeding": QuestionKind(speeding, (2, 3)),
    "dead centre": QuestionKind(dead_centre, (2, 3)),
    "closure": QuestionKind(closure, (2, 3)),
    "coriolis": QuestionKind(coriolis, (2, 3)),
    "curves": QuestionKind(curves, (2, 3)),
    "instant centre": QuestionKind(instant_centre, (3,)),
    "force": QuestionKind(force, (3,)),
    "grashof sum": QuestionKind(grashof_sum, (3,)),
    "slow way": QuestionKind(slow_way, (1, 2), of_making=True),
    "precision point": QuestionKind(precision_point, (2, 3), of_making=True),
    "pole": QuestionKind(pole, (2, 3), of_making=True),
}


def of_level(level: int) -> tuple[str, ...]:
    """Return the kinds that a level asks."""
    return tuple(name for name, kind in KINDS.items() if level in kind.levels)
