"""What moves which way and how fast: turning, the fastest point, the heading, the instant centre."""

from __future__ import annotations

from collections.abc import Iterable
from math import atan2, hypot, inf, isfinite, pi

from linkanim.mechanics.motion.measures import coupler_body, pole
from linkanim.picture.look import VELOCITY, Look
from linkanim.play.kinds.wording import MOST, number
from linkanim.play.question import CLEAR, PLAIN, Puzzle, QuizAnswer, QuizQuestion, either

_TURN = ("counterclockwise", "clockwise")
_WAYS = ("to the right", "up", "to the left", "down")
_OBLIQUE = pi / 6
"""A way that is farther from a compass point is between two of them."""
_NEAR = 0.08
"""Places that are nearer to each other, in sizes of the linkage, could be taken for one."""
_ARROWS = Look(names=1, vectors=frozenset({VELOCITY}))
_BACKWARDS = "the chain seen backwards"


def turning(puzzle: Puzzle) -> QuizQuestion | None:
    """Return which way a link turns; taken wrongly, as the input does."""
    clear = [body for body in puzzle.turning if abs(puzzle.share("angular_velocity", body.name)) > PLAIN]
    if not clear:
        return None
    body = puzzle.random.choice(clear)
    rate = puzzle.pose.angular_velocity[body.name]
    forward = puzzle.pose.coordinate_rate > 0
    against = puzzle.scene.linkage.drive.coordinate.is_angle and forward != (rate > 0)
    misled = " It turns against the input: directions are not handed on along a chain." if against else ""
    slip = "the input's direction, handed on along the chain" if against else _BACKWARDS
    return puzzle.question(
        body.name,
        f"Which way does the {puzzle.name(body)} turn?",
        *either(_TURN, rate > 0, slip),
        f"Its angular velocity is {number(rate)} rad/s, so it turns {_TURN[rate < 0]}.{misled}",
        shows=_ARROWS,
        arrows=body.joints,
    )


def fastest(puzzle: Puzzle) -> QuizQuestion | None:
    """Return which of some joints is fastest; taken wrongly, the one that is farthest from the input."""
    speeds = {name: hypot(*puzzle.pose.velocity[name]) for name in puzzle.joints}
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
    driven = complex(*places[puzzle.scene.linkage.drive.joint])
    far = max(others, key=lambda name: abs(complex(*places[name]) - driven))
    return puzzle.question(
        "velocity",
        "Which of these points is fastest?",
        QuizAnswer(first, place=places[first]),
        [QuizAnswer(name, _too_fast(puzzle, name, far), places[name]) for name in others],
        f"Their speeds: {listed}.",
        shows=_ARROWS,
        arrows=chosen,
    )


def _too_fast(puzzle: Puzzle, name: str, far: str) -> str:
    """Say why a joint is taken for the fastest."""
    if name == puzzle.scene.linkage.drive.joint:
        return "the input taken for the fastest: a chain can speed up on its way"
    if name == far:
        return "the farthest point taken for the fastest"
    return "its place taken for its speed"


def heading(puzzle: Puzzle) -> QuizQuestion | None:
    """Return which way a joint moves; taken wrongly, back, along its link or as it is accelerated."""
    names = puzzle.clear("velocity")
    puzzle.random.shuffle(names)
    for name in names:
        x, y = puzzle.pose.velocity[name]
        quarter = atan2(y, x) / (pi / 2)
        if abs(quarter - round(quarter)) * pi / 2 < _OBLIQUE:
            way = round(quarter) % 4
            ax, ay = puzzle.pose.acceleration[name]
            gains = round(atan2(ay, ax) / (pi / 2)) % 4 if isfinite(ax) and isfinite(ay) else None
            slips = ["along its link, not across"] * 4
            if gains is not None:
                slips[gains] = "the acceleration taken for the velocity"
            slips[(way + 2) % 4] = _BACKWARDS
            why = f"Its velocity is ({number(x)}, {number(y)}) {puzzle.scene.length_unit}/s."
            return puzzle.question(
                name,
                f"Which way does {name} move?",
                QuizAnswer(_WAYS[way]),
                [QuizAnswer(_WAYS[n], slips[n]) for n in range(4) if n != way],
                why,
                shows=_ARROWS,
                arrows=[name],
            )
    return None


def instant_centre(puzzle: Puzzle) -> QuizQuestion | None:
    """Return where a coupler's instant centre is; taken wrongly, at the nearest joint or half-way."""
    body = coupler_body(puzzle.scene.linkage)
    if body is None or abs(puzzle.share("angular_velocity", body.name)) < PLAIN:
        return None
    centre = complex(*map(float, pole(puzzle.pose, body)))
    box, size = puzzle.figure.box, puzzle.figure.extent
    if not (abs(centre) < inf and abs(centre - complex(*box.middle)) < size):
        return None
    places = {name: complex(*puzzle.pose.position[name]) for name in puzzle.figure.shown}
    ends = [places[name] for name in body.joints[:2]]
    half = sum(ends) / 2
    points = _apart([centre, half, *ends, *places.values()], _NEAR * size)[:MOST]
    if len(points) < 3:
        return None
    near = min(
        (point for point in points[1:] if point != half), key=lambda at: abs(at - centre), default=None
    )
    slips = {half: "the middle of the link taken for the pole"}
    slips |= {near: "the nearer joint taken for the pole"} if near is not None else {}
    slips[centre], other = "", "a joint that moves, or of another link, taken for the pole"
    unit = puzzle.scene.length_unit
    right, *wrong = (
        QuizAnswer(
            f"({number(point.real)}, {number(point.imag)}) {unit}",
            slips.get(point, other),
            (point.real, point.imag),
        )
        for point in points
    )
    return puzzle.question(
        body.name,
        f"Where is the instant centre of the {puzzle.name(body)}?",
        right,
        wrong,
        "It stands still there for this instant: the normals to the velocities of its points meet there.",
        shows=Look(names=1, vectors=frozenset({VELOCITY}), centres=1),
        arrows=body.joints,
        shuffled=True,
        stops=puzzle.phase,
    )


def _apart(points: Iterable[complex], least: float) -> list[complex]:
    """Return the points that are so far from each one before them."""
    kept: list[complex] = []
    for point in points:
        if all(abs(point - other) > least for other in kept):
            kept.append(point)
    return kept
