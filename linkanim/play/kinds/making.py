"""How a linkage was made: the pole of two of its poses, a time ratio's slow way, precision points."""

from __future__ import annotations

import cmath
from itertools import combinations, pairwise
from math import degrees, inf, tan

from linkanim.digits import significant, typeset
from linkanim.play.kinds.wording import MOST, angle, number, tenths
from linkanim.play.question import CLEAR, Puzzle, QuizAnswer, QuizQuestion
from linkanim.scenes.purpose import FunctionPurpose, PosesPurpose, TimeRatioPurpose

_FAR = 3.0
"""Of the poses' distances: a pole farther away is not asked for."""
_DIGITS = 4


def pole(puzzle: Puzzle) -> QuizQuestion | None:
    """Return about which point a turn takes one pose to another; taken wrongly, another pole, the middle."""
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
    tries = [(2 * middle - poles[one, other], "the turn taken the other way round")]
    tries += [(middle, "the middle of the way, about which it would be turned by half a turn")]
    tries += [
        (poles[pair], f"the pole of poses {pair[0] + 1} and {pair[1] + 1}")
        for pair in near
        if pair != (one, other)
    ]
    kept = [poles[one, other]]
    wrong: list[QuizAnswer] = []
    for place, slip in tries:
        if len(wrong) < MOST - 1 and all(abs(place - known) > CLEAR * size for known in kept):
            kept.append(place)
            wrong.append(QuizAnswer(_place(puzzle, place), slip))
    if len(wrong) < 2:
        return None
    first, second = (_pose(puzzle, purpose.poses[n]) for n in (one, other))
    return puzzle.question(
        next(body.name for body in puzzle.scene.linkage.bodies if puzzle.scene.trace[0] in body.joints),
        f"A body is taken from the pose at {first} to that at {second} by one turn: about which point?",
        QuizAnswer(_place(puzzle, poles[one, other])),
        wrong,
        "The pole lies on the midperpendicular of the way between both places, "
        f"{number(abs(poles[one, other] - middle))} {puzzle.scene.length_unit} from its middle: half the way "
        "times the cotangent of half the turn.",
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
    return f"{_place(puzzle, complex(x, y))}, turned by {tenths(degrees(turned))},"


def slow_way(puzzle: Puzzle) -> QuizQuestion | None:
    """Return how far the crank turns on the output's slow way; taken wrongly, on the quick one."""
    purpose = puzzle.scene.purpose
    if not isinstance(purpose, TimeRatioPurpose) or purpose.ratio < 1 + 10 * CLEAR:
        return None
    ratio = purpose.ratio
    slow, quick = 360 * ratio / (1 + ratio), 360 / (1 + ratio)
    beyond = slow - 180
    tries = {
        quick: "the quick way taken for the slow one",
        180 * ratio: "half a turn times the time ratio",
        180 + beyond / 2: "the angle between the directions of the dead centres halved",
    }
    wrong = [QuizAnswer(angle(value), slip) for value, slip in tries.items() if value < 360]
    return puzzle.question(
        "input",
        f"The output's slow way takes {number(ratio)} times as long as its quick way. "
        "By how much does the crank turn meanwhile?",
        QuizAnswer(angle(slow)),
        wrong,
        f"Both ways are a whole turn, in this ratio: {tenths(slow)} and {tenths(quick)}.",
        shuffled=True,
    )


def precision_point(puzzle: Puzzle) -> QuizQuestion | None:
    """Return where a linkage gives its function exactly; taken wrongly, between two such points."""
    purpose = puzzle.scene.purpose
    if not isinstance(purpose, FunctionPurpose) or len(purpose.x) < 3:
        return None
    right = puzzle.random.choice(purpose.x)
    middles = [(low + high) / 2 for low, high in pairwise(purpose.x)]
    puzzle.random.shuffle(middles)
    texts = [_at(x) for x in (right, *middles)]
    if len(set(texts)) < len(texts):
        return None
    slip = "a place between two precision points, where the error is near an extreme"
    shown = " and ".join([", ".join(map(_at, purpose.x[:-1])), _at(purpose.x[-1])])
    return puzzle.question(
        "input",
        f"Made for {purpose.words}: where does the linkage give y without an error of its structure?",
        QuizAnswer(_at(right)),
        [QuizAnswer(_at(x), slip) for x in middles[: MOST - 1]],
        f"Its precision points are {shown}; between them the error goes to one side and to the other.",
        shuffled=True,
    )


def _at(x: float) -> str:
    return f"x = {typeset(significant(x, _DIGITS))}"
