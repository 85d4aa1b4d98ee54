"""The kinds of questions: each made from what is solved, its wrong answers from a known misconception."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from math import atan2, degrees, hypot, inf, isfinite, pi, tau
from types import MappingProxyType

import numpy as np

from linkanim.digits import short, significant, typeset
from linkanim.mechanics.closing.search import sign_changes
from linkanim.mechanics.facts.naming import four_bar_of
from linkanim.mechanics.motion.measures import between, coupler_body, growth, output_body, pole
from linkanim.play.question import CLEAR, Puzzle, QuizQuestion

_PLAIN = 0.1
"""A share of a greatest value that is seen at once."""
_MOST = 4
"""So many answers a question has at most."""
_TURN = ("counterclockwise", "clockwise")
_WAYS = ("to the right", "up", "to the left", "down")
_OBLIQUE = pi / 6
"""A way that is farther from a compass point is between two of them."""
_APART = 20.0
"""Crank angles in degrees that nobody takes for one another."""
_NEAR = 0.08
"""Places that are nearer to each other, in sizes of the linkage, could be taken for one."""

Maker = Callable[[Puzzle], QuizQuestion | None]


def turning(puzzle: Puzzle) -> QuizQuestion | None:
    """Return which way a link turns; taken wrongly, as the input does."""
    clear = [body for body in puzzle.turning if abs(puzzle.share("angular_velocity", body.name)) > _PLAIN]
    if not clear:
        return None
    body = puzzle.random.choice(clear)
    rate = puzzle.pose.angular_velocity[body.name]
    right, wrong = _TURN if rate > 0 else _TURN[::-1]
    forward = puzzle.pose.coordinate_rate > 0
    against = puzzle.scene.linkage.drive.coordinate.is_angle and forward != (rate > 0)
    misled = " It turns against the input: directions are not handed on along a chain." if against else ""
    return puzzle.question(
        "turning",
        body.name,
        f"Which way does the {puzzle.name(body)} turn?",
        right,
        [wrong],
        f"Its angular velocity is {_number(rate)} rad/s, so it turns {right}.{misled}",
        kept=True,
    )


def fastest(puzzle: Puzzle) -> QuizQuestion | None:
    """Return which of some joints is fastest; taken wrongly, the one that is farthest from the input."""
    speeds = {name: hypot(*puzzle.pose.velocity[name]) for name in puzzle.joints}
    greatest = max((value for value in speeds.values() if isfinite(value)), default=0.0)
    chosen: list[str] = []
    for name in puzzle.random.sample(list(speeds), len(speeds)):
        clear = all(abs(speeds[name] - speeds[other]) > 2 * CLEAR * greatest for other in chosen)
        if clear and 2 * CLEAR * greatest < speeds[name] < inf and len(chosen) < _MOST:
            chosen.append(name)
    if len(chosen) < 2:
        return None
    first, *others = sorted(chosen, key=lambda name: -speeds[name])
    unit = puzzle.scene.length_unit
    listed = ", ".join(f"{name} {_number(speeds[name])} {unit}/s" for name in (first, *others))
    return puzzle.question(
        "fastest",
        "velocity",
        "Which of these points is fastest?",
        first,
        others,
        f"Their speeds: {listed}.",
        kept=True,
    )


def heading(puzzle: Puzzle) -> QuizQuestion | None:
    """Return which way a joint moves; taken wrongly, along its link."""
    names = [name for name in puzzle.joints if puzzle.share("velocity", name) > _PLAIN]
    puzzle.random.shuffle(names)
    for name in names:
        x, y = puzzle.pose.velocity[name]
        quarter = atan2(y, x) / (pi / 2)
        if abs(quarter - round(quarter)) * pi / 2 < _OBLIQUE:
            right = _WAYS[round(quarter) % 4]
            why = f"Its velocity is ({_number(x)}, {_number(y)}) {puzzle.scene.length_unit}/s."
            wrong = [way for way in _WAYS if way != right]
            return puzzle.question(
                "heading", name, f"Which way does {name} move?", right, wrong, why, kept=True
            )
    return None


def speeding(puzzle: Puzzle) -> QuizQuestion | None:
    """Return whether a joint becomes faster; taken wrongly, whether it moves forward."""
    names = [name for name in puzzle.joints if puzzle.share("velocity", name) > _PLAIN]
    puzzle.random.shuffle(names)
    for name in names:
        (vx, vy), (ax, ay) = puzzle.pose.velocity[name], puzzle.pose.acceleration[name]
        along = (vx * ax + vy * ay) / hypot(vx, vy)
        if (
            isfinite(along)
            and abs(along) > _PLAIN * hypot(ax, ay)
            and puzzle.share("acceleration", name) > CLEAR
        ):
            right, wrong = ("it speeds up", "it slows down")[:: 1 if along > 0 else -1]
            why = (
                f"Its acceleration along its velocity is {_number(along)} {puzzle.scene.length_unit}/s²: "
                "not where it moves to, but whether both point the same way, decides."
            )
            text = f"Does {name} speed up or slow down?"
            return puzzle.question("speeding", name, text, right, [wrong], why, kept=True)
    return None


_POWERS = MappingProxyType({"velocity": ("twice as large", 2), "acceleration": ("four times as large", 4)})
_FACTORS = ("as large as before", "twice as large", "four times as large", "eight times as large")


def doubled(puzzle: Puzzle) -> QuizQuestion | None:
    """Return what becomes of a joint's velocity or acceleration as the speed doubles."""
    kind = puzzle.random.choice(tuple(_POWERS))
    names = [name for name in puzzle.joints if puzzle.share(kind, name) > _PLAIN]
    if not names:
        return None
    name, (right, factor) = puzzle.random.choice(names), _POWERS[kind]
    value = hypot(*getattr(puzzle.pose, kind)[name])
    unit = f"{puzzle.scene.length_unit}/s{'²' if kind == 'acceleration' else ''}"
    power = "the square of the speed" if factor == 4 else "the speed itself"
    return puzzle.question(
        "doubled",
        f"{name}.{kind}",
        f"The input runs twice as fast. How large is the {kind} of {name} in the same place?",
        right,
        [one for one in _FACTORS if one != right],
        f"It goes with {power}: {_number(value)} becomes {_number(factor * value)} {unit}.",
    )


def instant_centre(puzzle: Puzzle) -> QuizQuestion | None:
    """Return where a coupler's instant centre is; taken wrongly, at the nearest joint or half-way."""
    body = coupler_body(puzzle.scene.linkage)
    if body is None or abs(puzzle.share("angular_velocity", body.name)) < _PLAIN:
        return None
    centre = complex(*map(float, pole(puzzle.pose, body)))
    box, size = puzzle.figure.box, puzzle.figure.extent
    if not (abs(centre) < inf and abs(centre - complex(*box.middle)) < size):
        return None
    places = {name: complex(*puzzle.pose.position[name]) for name in puzzle.figure.shown}
    ends = [places[name] for name in body.joints[:2]]
    wrong = [sum(ends) / 2, *ends, *places.values()]
    points = _apart([centre, *wrong], _NEAR * size)[:_MOST]
    if len(points) < 3:
        return None
    texts = [f"({_number(point.real)}, {_number(point.imag)}) {puzzle.scene.length_unit}" for point in points]
    return puzzle.question(
        "instant centre",
        body.name,
        f"Where is the instant centre of the {puzzle.name(body)}?",
        texts[0],
        texts[1:],
        "It stands still there for this instant: the normals to the velocities of its points meet there.",
    )


def dead_centre(puzzle: Puzzle) -> QuizQuestion | None:
    """Return at which crank angle the output turns back; taken wrongly, where it is fastest."""
    scene = puzzle.scene
    body = output_body(scene.linkage)
    if body is None or not scene.info.full_turn or scene.period > tau * 1.001:
        return None
    kind, name = "travel_velocity" if body.slider else "angular_velocity", body.name
    quickest = float(puzzle.cycle.phase[int(abs(getattr(puzzle.cycle, kind)[name]).argmax())])
    found = sign_changes(lambda phases: getattr(scene.solve(phase=phases), kind)[name], puzzle.cycle.phase)
    exact = [_crank_degrees(puzzle, float(phase)) for phase in found]
    if not exact:
        return None
    right = puzzle.random.choice(exact)
    others = [_crank_degrees(puzzle, quickest), *(puzzle.random.uniform(0, 360) for _ in range(20))]
    wrong: list[float] = []
    for angle in others:
        if all(_between(angle, one) > _APART for one in (*exact, *wrong)) and len(wrong) < _MOST - 1:
            wrong.append(angle)
    if len(wrong) < 2:
        return None
    return puzzle.question(
        "dead centre",
        body.name,
        f"At which crank angle does the {puzzle.name(body)} turn back?",
        _angle(right),
        map(_angle, wrong),
        f"Its velocity is zero at {' and '.join(map(_angle, exact))}; where that is greatest it runs on.",
    )


def input_range(puzzle: Puzzle) -> QuizQuestion | None:
    """Return whether the input turns fully, and else between which angles it swings."""
    drive, info = puzzle.scene.linkage.drive, puzzle.scene.info
    if not drive.coordinate.is_angle:
        return None
    low, high = map(degrees, info.input_range)
    if info.full_turn:
        low, width = puzzle.random.uniform(-90, 90), puzzle.random.uniform(100, 200)
        right = "it turns fully"
        wrong = [_swing(low, low + width), _swing(low - 40, low + width / 2)]
        why = "The solver closes it at every angle of the input."
    else:
        width = high - low
        right = _swing(low, high)
        wrong = [
            "it turns fully",
            _swing(low + 0.25 * width, high + 0.25 * width),
            _swing(low, low + 0.6 * width),
        ]
        why = "At both ends two links lie in one line: beyond it the loop does not close."
    text = f"How far can the {info.input_name} turn?"
    return puzzle.question("input range", "input", text, right, wrong, why)


def closure(puzzle: Puzzle) -> QuizQuestion | None:
    """Return on which closure an input that swings comes back."""
    info = puzzle.scene.info
    if info.full_turn or not puzzle.scene.linkage.drive.coordinate.is_angle or not info.toggles:
        return None
    answers = ("on the same closure", "on the other closure")
    right, wrong = answers[:: 1 if info.mechanism.retraced else -1]
    why = (
        "It goes back by the way it came, as the scene says."
        if info.mechanism.retraced
        else "Through the limit the links swing on smoothly, to the other side of their line."
    )
    text = f"The {info.input_name} comes to its limit and turns back. On which closure?"
    return puzzle.question("closure", "input", text, right, [wrong], why)


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
    number = 2 if bar.margin == 0 else 0 if bar.margin > 0 else 1
    s, p, q, longest = map(_number, lengths)
    words = ", ".join(f"{part} {_number(length)}" for part, length in bar.links.items())
    return puzzle.question(
        "grashof",
        bar.joint,
        f"The lengths of the four-bar that the input drives, in {puzzle.scene.length_unit}: {words}. "
        "Does a link turn fully against the others?",
        answers[number],
        [answer for answer in answers if answer != answers[number]],
        f"s + l = {s} + {longest} and p + q = {p} + {q}.",
        kept=True,
    )


def coriolis(puzzle: Puzzle) -> QuizQuestion | None:
    """Return whether a slider's acceleration has a Coriolis term; only where the guide turns it has."""
    found = list(_sliding(puzzle))
    if not found:
        return None
    joint, turns = puzzle.random.choice(found)
    answers = ("yes", "no")
    right, wrong = answers[:: 1 if turns else -1]
    why = (
        f"{joint} slides along a guide that turns meanwhile: 2ω × v is not zero."
        if turns
        else f"The guide of {joint} does not turn: ω is zero, and 2ω × v with it."
    )
    text = f"Is there a Coriolis term in the acceleration of {joint}, told in its guide's frame?"
    return puzzle.question("coriolis", joint, text, right, [wrong], why, kept=True)


def _sliding(puzzle: Puzzle) -> Iterator[tuple[str, bool]]:
    """Yield joints that slide clearly, each with whether its guide turns clearly; none between."""
    sliders = {body.slider: body for body in puzzle.scene.linkage.bodies if body.slider}
    for joint in puzzle.scene.linkage.joints:
        for slide in joint.slides:
            if slide.axis is None and slide.start is None and joint.name in sliders:
                if abs(puzzle.share("travel_velocity", sliders[joint.name].name)) > _PLAIN:
                    yield joint.name, False
            elif slide.axis and slide.start and _slides(puzzle, (slide.start, slide.point)):
                body = next((one for one in puzzle.turning if {*slide.axis} <= {*one.joints}), None)
                if body is not None and abs(puzzle.share("angular_velocity", body.name)) > _PLAIN:
                    yield slide.point, True


def _slides(puzzle: Puzzle, ends: tuple[str, str]) -> bool:
    """Return whether two joints clearly come nearer to each other, or part."""
    rates = [
        growth(between(found.position, ends), between(found.velocity, ends))
        for found in (puzzle.cycle, puzzle.pose)
    ]
    return bool(abs(rates[1]) > _PLAIN * float(np.nanmax(abs(rates[0]))))


KINDS: MappingProxyType[str, Maker] = MappingProxyType(
    {
        "turning": turning,
        "fastest": fastest,
        "heading": heading,
        "speeding": speeding,
        "doubled": doubled,
        "instant centre": instant_centre,
        "dead centre": dead_centre,
        "input range": input_range,
        "closure": closure,
        "grashof": grashof,
        "coriolis": coriolis,
    }
)


def _number(value: float) -> str:
    return typeset(short(value) if abs(value) >= 0.1 or not value else significant(value, 3))


def _angle(angle: float) -> str:
    return f"{angle % 360:.1f}°"


def _swing(low: float, high: float) -> str:
    return typeset(f"it swings between {low:.1f}° and {high:.1f}°")


def _between(one: float, other: float) -> float:
    """Return how far two angles in degrees are from each other, 0 to 180."""
    return abs((one - other + 180) % 360 - 180)


def _crank_degrees(puzzle: Puzzle, phase: float) -> float:
    return degrees(puzzle.scene.pose(phase, 0).coordinate) % 360


def _apart(points: Iterable[complex], least: float) -> list[complex]:
    """Return the points that are so far from each one before them."""
    kept: list[complex] = []
    for point in points:
        if all(abs(point - other) > least for other in kept):
            kept.append(point)
    return kept
