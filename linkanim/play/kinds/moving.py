"""What moves which way and how fast: turning, the fastest point, the heading, the instant centre."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from math import inf, isfinite, pi

from linkanim.mechanics.linkage.linkage import Body
from linkanim.mechanics.motion.measures import coupler_body
from linkanim.picture.look import VELOCITY, Look
from linkanim.play.kinds.wording import BESIDE, MOST, SIDES, TURNS, WAYS, number, obliquity, quarter
from linkanim.play.question import CLEAR, PLAIN, Puzzle, QuizAnswer, QuizQuestion, either

_OBLIQUE = pi / 6
"""A way that is farther from a compass point is between two of them."""
_NEAR = 0.08
"""Places that are nearer to each other, in sizes of the linkage, could be taken for one."""
_ARROWS = Look(names=1, vectors=frozenset({VELOCITY}))
_BACKWARDS = "when the input runs backwards"


def turning(puzzle: Puzzle) -> QuizQuestion | None:
    """Return which way a link turns; taken wrongly, as the input does."""
    clear = [body for body in puzzle.turning if abs(puzzle.share(f"{body.name}.angular_velocity")) > PLAIN]
    if not clear:
        return None
    body = puzzle.random.choice(clear)
    rate = puzzle.value(f"{body.name}.angular_velocity")
    against = puzzle.scene.linkage.drive.coordinate.is_angle and puzzle.pose.coordinate_rate * rate < 0
    slip = "the input's direction, handed on along the chain" if against else f"the way it turns {_BACKWARDS}"
    misled = " The input turns the other way: a chain does not hand on directions." if against else ""
    return puzzle.question(
        body.name,
        f"Which way does {puzzle.name(body)} turn?",
        *either(TURNS, rate > 0, slip),
        f"{_why_turning(puzzle, body, rate)}{misled}",
        shows=_ARROWS,
        arrows=body.joints,
    )


def _why_turning(puzzle: Puzzle, body: Body, rate: float) -> str:
    """Return why a body turns as it does: by how one joint moves about another, a fixed one if any."""
    is_fixed = {name: puzzle.scene.linkage.joint(name).fixed for name in body.joints[:2]}
    first, second = sorted(is_fixed, key=lambda name: not is_fixed[name])
    place, way = (
        quarter(puzzle.vector(kind, second) - puzzle.vector(kind, first)) for kind in ("position", "velocity")
    )
    lies = f"{second} lies {SIDES[place]} {first}"
    if not is_fixed[first]:
        lies = f"Seen from {first}, {second} lies {BESIDE[place]}"
    turns = f"{puzzle.name(body)} turns {TURNS[rate < 0]}, with {number(abs(rate))} rad/s"
    return f"{lies} and moves {WAYS[way]}: {turns}."


def fastest(puzzle: Puzzle) -> QuizQuestion | None:
    """Return which of some joints is fastest; taken wrongly, the input's or the one that is farthest out."""
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
    listed = ", ".join(f"{name} {number(speeds[name])} {unit}/s" for name in (first, *others))
    places = puzzle.pose.position
    slips = dict(_taken_for_fastest(puzzle, chosen))
    return puzzle.question(
        "velocity",
        "Which of these points is fastest?",
        QuizAnswer(first, place=places[first]),
        [QuizAnswer(name, slips.get(name, ""), places[name]) for name in others],
        f"{_why_faster(puzzle, first, others)}The speeds: {listed}.",
        shows=_ARROWS,
        arrows=chosen,
    )


def _taken_for_fastest(puzzle: Puzzle, names: list[str]) -> Iterator[tuple[str, str]]:
    """Yield what is taken for the fastest of some joints, and why."""
    linkage = puzzle.scene.linkage
    if linkage.drive.coordinate.is_angle:
        pivot = linkage.crank(linkage.drive.joint).pivot
        ways = {name: abs(puzzle.apart(pivot, name)) for name in names}
        *_, next_to, far = sorted(names, key=lambda name: ways[name])
        if ways[far] - ways[next_to] > CLEAR * ways[far]:
            yield far, f"the point farthest from {pivot}, taken for the fastest"
    yield linkage.drive.joint, "the input taken for the fastest: a chain can speed up on its way"


def _why_faster(puzzle: Puzzle, first: str, others: list[str]) -> str:
    """Return why a joint is faster than the next one that is on one body with it; "" where none is."""
    shared = ((name, body) for name in others for body in puzzle.bodies_of(first, name))
    for name, body in shared:
        centre, about = puzzle.centre_of(body)
        far, close = (abs(puzzle.vector("position", joint) - centre) for joint in (first, name))
        if CLEAR * far < close < inf:
            times = number(round(far / close, 2))
            return (
                f"{first} and {name} turn with the same ω about {about}, and {first} is {times} times as far "
                "from it. "
            )
    return ""


def heading(puzzle: Puzzle) -> QuizQuestion | None:
    """Return which way a joint moves; taken wrongly, back, along its link or as it is accelerated.

    What slides in a fixed guide is asked for the two ways of its guide only.
    """
    names = puzzle.clear("velocity")
    puzzle.random.shuffle(names)
    for name in names:
        velocity = puzzle.vector("velocity", name)
        if obliquity(velocity) > _OBLIQUE:
            continue
        way = quarter(velocity)
        ways = (way, (way + 2) % 4) if _is_guided(puzzle, name) else range(4)
        slips = dict(_taken_for_heading(puzzle, name, way))
        return puzzle.question(
            name,
            f"Which way does {name} move?",
            QuizAnswer(WAYS[way]),
            [QuizAnswer(WAYS[n], slips.get(n, "")) for n in ways if n != way],
            _why_heading(puzzle, name),
            shows=_ARROWS,
            arrows=[name],
        )
    return None


def _is_guided(puzzle: Puzzle, name: str) -> bool:
    """Return whether a joint slides along a fixed line."""
    slides = puzzle.scene.linkage.joint(name).slides
    return any(slide.point == name and slide.start is None for slide in slides)


def _taken_for_heading(puzzle: Puzzle, name: str, way: int) -> Iterator[tuple[int, str]]:
    """Yield which way is taken for a joint's heading, and why; what counts most comes last."""
    pin = puzzle.pivot_of(name)
    if pin is not None:
        along = quarter(puzzle.apart(pin, name))
        yield from ((n % 4, "along its link, not across") for n in (along, along + 2))
    yield (way + 2) % 4, f"the way it moves {_BACKWARDS}"
    acceleration = puzzle.vector("acceleration", name)
    known = isfinite(abs(acceleration)) and puzzle.share(f"{name}.acceleration") > CLEAR
    if known and obliquity(acceleration) < _OBLIQUE:
        yield quarter(acceleration), "the acceleration taken for the velocity"


def _why_heading(puzzle: Puzzle, name: str) -> str:
    """Return why a joint moves as it does: by the bar that pushes it, or by what its link turns about."""
    velocity = puzzle.vector("velocity", name)
    moves = f"{WAYS[quarter(velocity)]}, with {number(abs(velocity))} {puzzle.scene.length_unit}/s"
    joint = puzzle.scene.linkage.joint(name)
    if _is_guided(puzzle, name):
        for end, _ in joint.bars:
            towards = (puzzle.apart(end, name).conjugate() * puzzle.vector("velocity", end)).real
            pushes = f"towards {name}: it pushes" if towards > 0 else f"away from {name}: it pulls"
            return f"{end} moves the bar {end}–{name} {pushes} {name} along the guide, {moves}."
        return f"It slides along its guide, {moves}."
    pin = puzzle.pivot_of(name)
    centres = (
        [(puzzle.vector("position", pin), pin)] if pin else map(puzzle.centre_of, puzzle.bodies_of(name))
    )
    for centre, about in centres:
        arm = puzzle.vector("position", name) - centre
        if 0 < abs(arm) < inf:
            turns = TURNS[(arm.conjugate() * velocity).imag < 0]
            return f"It turns {turns} about {about} and lies {SIDES[quarter(arm)]} it: so it moves {moves}."
    return f"It moves {moves}: its velocity is ({number(velocity.real)}, {number(velocity.imag)})."


def instant_centre(puzzle: Puzzle) -> QuizQuestion | None:
    """Return where a coupler's instant centre is; taken wrongly, at a joint, a pin or half-way."""
    body = coupler_body(puzzle.scene.linkage)
    if body is None or abs(puzzle.share(f"{body.name}.angular_velocity")) < PLAIN:
        return None
    centre, _ = puzzle.centre_of(body)
    box, size = puzzle.figure.box, puzzle.figure.extent
    if not (abs(centre) < inf and abs(centre - complex(*box.middle)) < size):
        return None
    ends = [puzzle.vector("position", name) for name in body.joints[:2]]
    places = {puzzle.vector("position", name): name for name in puzzle.figure.shown}
    half = sum(ends) / 2
    points = _apart([centre, half, *ends, *places], _NEAR * size)[:MOST]
    if len(points) < 3:
        return None
    slips = {place: _taken_for_pole(puzzle, name) for place, name in places.items()}
    slips[half] = "the middle of the link taken for the pole"
    slips[min(ends, key=lambda end: abs(end - centre))] = "the nearer joint taken for the pole"
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
        f"Where is the instant centre of {puzzle.name(body)}?",
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
    still = f"the point of {puzzle.name(body)} in that place stands still at this instant."
    if abs((arms[0].conjugate() * arms[1]).imag) > CLEAR * abs(arms[0] * arms[1]):
        return f"The normals to the velocities of {one} and {other} meet there: {still}"
    return f"Along the line through {one} and {other} the velocities fall to nothing there: {still}"


def _taken_for_pole(puzzle: Puzzle, name: str) -> str:
    """Return as what a joint is taken for the pole of a link that moves."""
    if puzzle.scene.linkage.joint(name).fixed:
        return "a fixed pin, about which another link turns"
    return "a joint that moves, taken for the pole" if puzzle.share(f"{name}.velocity") > CLEAR else ""


def _apart(points: Iterable[complex], least: float) -> list[complex]:
    """Return the points that are so far from each one before them."""
    kept: list[complex] = []
    for point in points:
        if all(abs(point - other) > least for other in kept):
            kept.append(point)
    return kept
