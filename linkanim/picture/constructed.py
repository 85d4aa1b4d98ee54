"""The constructions that a scene has, and their steps: its synthesis, its dead centres, its centres."""

from __future__ import annotations

from functools import lru_cache
from itertools import combinations
from math import inf
from typing import get_args

import numpy as np

from linkanim.errors import BadInput
from linkanim.mechanics.centres import Centre, KennedyStep, joint_between, slide_between, touch
from linkanim.mechanics.motion import Pose
from linkanim.picture.centres import CentrePairs, kennedy_line, label_of
from linkanim.picture.figure import Figure, figure
from linkanim.picture.look import ConstructionKind
from linkanim.scenes.scene import Scene
from linkanim.synthesis.constructions import (
    ConstructionStep,
    Mark,
    construction,
    dead_centre_steps,
    in_line_parts,
    is_synthesised,
)
from linkanim.words import row_said, said, to_say

KINDS: tuple[ConstructionKind, ...] = get_args(ConstructionKind)

NAMES: dict[ConstructionKind, str] = {
    "synthesis": to_say("construction: how it was found"),
    "dead-centres": to_say("construction of its dead centres"),
    "centres": to_say("construction of its instant centres"),
}
"""What each construction is called among commands."""
_TITLES: dict[ConstructionKind, str] = {
    "synthesis": to_say("its construction"),
    "centres": to_say("the construction of its instant centres"),
    "dead-centres": to_say("the construction of its dead centres"),
}
_REFUSED: dict[ConstructionKind, str] = {
    "synthesis": (
        "has no construction of a synthesis; one is drawn of what linkanim guide, function and quick-return "
        "have made"
    ),
    "centres": (
        "has more than five links, or no two whose centres with a third are both known; instant centres are "
        "constructed of up to five"
    ),
    "dead-centres": (
        "is neither a slider-crank, its rod longer than its crank, nor a crank-rocker, driven by its "
        "crank; of those dead centres are constructed"
    ),
}
_LOWERED = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_BEYOND = 0.06
"""How far Kennedy's lines run beyond their centres, in their lengths."""
_REACH = 3.0
"""The length of lines towards an infinitely far centre, in sizes of the linkage."""
_FOUND = ("dot", "ring", "cross")
"""The marks of points that are found."""
_FAR = 3.0
"""Centres up to this far from the linkage's middle, in its sizes, are drawn as points."""
_POSES, _CLOSE = 72, 0.08
"""The number of poses among which the clearest is chosen, and how near to each other its centres may be."""
_SHORT = 0.3
"""The length of the mark that points to an infinitely far centre."""


def kinds_of(scene: Scene) -> tuple[ConstructionKind, ...]:
    """Return which constructions a scene has, that of its synthesis first."""
    known = CentrePairs(figure(scene))
    has = {
        "synthesis": is_synthesised(scene),
        "centres": known.all_shown and bool(known.steps),
        "dead-centres": in_line_parts(scene) is not None,
    }
    return tuple(kind for kind in KINDS if has[kind])


def title_of(scene: Scene, kind: ConstructionKind) -> str:
    """Return the title of a construction's figure."""
    return said("{title}: {part}", title=said(scene.title), part=said(_TITLES[kind]))


def usual_kind(scene: Scene) -> ConstructionKind:
    """Return the first construction that a scene has; BadInput where there is none."""
    if kinds := kinds_of(scene):
        return kinds[0]
    raise BadInput(
        f"{scene.name}: has no construction; one is drawn of what linkanim guide, function and quick-return "
        "have made, of the instant centres of three to five links, and of the dead centres of a "
        "slider-crank or a crank-rocker"
    )


def steps_of(scene: Scene, kind: ConstructionKind, phase: float = 0.0) -> tuple[ConstructionStep, ...]:
    """Return the steps of a construction, of centres at that phase; BadInput where there is none."""
    _refuse_lacking(scene, kind)
    match kind:
        case "synthesis":
            return construction(scene)
        case "dead-centres":
            return dead_centre_steps(scene)
        case "centres":
            return _centre_steps(figure(scene), phase)


def _refuse_lacking(scene: Scene, kind: ConstructionKind) -> None:
    if kind not in kinds_of(scene):
        raise BadInput(f"{scene.name}: {_REFUSED[kind]}")


def all_steps(scene: Scene) -> int:
    """Return how many steps all constructions of a scene have; BadInput where there is none."""
    usual_kind(scene)
    return sum(len(steps_of(scene, kind)) for kind in kinds_of(scene))


def steps_before(scene: Scene, kind: ConstructionKind) -> int:
    """Return how many steps the constructions before this one have; BadInput where there is none."""
    _refuse_lacking(scene, kind)
    kinds = kinds_of(scene)
    return sum(len(steps_of(scene, one)) for one in kinds[: kinds.index(kind)])


def places_of(scene: Scene, kind: ConstructionKind, phase: float) -> tuple[complex, ...]:
    """Return places in the scene's unit that a picture of a construction has to include."""
    if kind == "centres":
        shown = figure(scene)
        return CentrePairs(shown).near(scene.pose(phase, 1), shown.box, _FAR)
    marks = [mark for step in steps_of(scene, kind, phase) for mark in step.marks if mark.spreads]
    return tuple(complex(point) for mark in marks for point in mark.points if np.isfinite(point))


def shown_at(
    scene: Scene, at: int, phase: float
) -> tuple[ConstructionKind, tuple[ConstructionStep, ...], int]:
    """Return which construction is shown at a step counted from 1 through all constructions of a scene.

    With it its steps up to there, and how many it has in all.
    """
    *earlier, last = kinds_of(scene)
    for kind in earlier:
        count = len(steps_of(scene, kind, phase))
        if at <= count:
            return kind, steps_of(scene, kind, phase)[:at], count
        at -= count
    steps = steps_of(scene, last, phase)
    return last, steps[:at], len(steps)


@lru_cache(maxsize=2)
def points_up_to(scene: Scene, at: int, phase: float) -> tuple[complex, ...]:
    """Return the points that a construction has found up to a step, but for those far from the linkage."""
    box = figure(scene).box
    size, middle = max(box.right - box.left, box.high - box.low), complex(*box.middle)
    marks = (mark for step in shown_at(scene, at, phase)[1] for mark in step.marks)
    points = (complex(point) for mark in marks if mark.shape in _FOUND for point in mark.points)
    return tuple(point for point in points if abs(point - middle) <= _FAR * size)


def clear_phase(scene: Scene) -> float:
    """Return the phase of the pose whose instant centres are nearest to the linkage, yet apart.

    Of several such poses it is the first; a pose in which every centre is infinitely far is the last choice.
    BadInput where no centres are constructed.
    """
    _refuse_lacking(scene, "centres")
    known = CentrePairs(figure(scene))
    size, middle = known.size, complex(*known.figure.box.middle)

    def spread(phase: float) -> tuple[float, float]:
        places = [one.place for one in known.of(scene.pose(phase, 1)).values() if one.place is not None]
        if not places:
            return inf, inf
        apart = min((abs(one - other) for one, other in combinations(places, 2)), default=size)
        return max(_CLOSE - apart / size, 0.0), round(max(abs(place - middle) for place in places) / size, 6)

    phases = (scene.period * n / _POSES for n in range(_POSES))
    return min(phases, key=spread)


def linkage_marks(scene: Scene, phase: float) -> tuple[Mark, ...]:
    """Return the linkage in a pose as in a construction's figure: bars, plates, pins, links' numbers."""
    shown, pose = figure(scene), scene.pose(phase, 0)
    numbers = shown.numbers | {body: number for number, body in shown.by_number.items() if body}
    marks = list[Mark]()
    for body in dict.fromkeys((*shown.bodies, *numbers)):
        names = body.joints or (body.slider or "",)
        points = np.array([complex(*pose.position[name]) for name in names])
        if body.joints:
            marks.append(Mark("plate" if len(points) > 2 else "bar", points, tone="dim", spreads=True))
        if body in numbers and body.joints:
            marks.append(Mark("word", np.array([points.mean()]), numbers[body], spreads=True))
        elif body in numbers:
            marks.append(Mark("ring", points, numbers[body], spreads=True))
    rings = [Mark("ring", np.array([complex(*pose.position[name])]), spreads=True) for name in shown.pins]
    return (*marks, *rings)


# Kennedy's construction: the centres of adjacent links, then each further centre where two lines meet.


def _centre_steps(shown: Figure, phase: float) -> tuple[ConstructionStep, ...]:
    known = CentrePairs(shown)
    pose = shown.scene.pose(phase, 1)
    centres, near = known.of(pose), set(known.near(pose, shown.box, _FAR))
    size = known.size
    links = shown.by_number
    touching = [(one, other) for one, other in known.pairs if touch(shown.linkage, links[one], links[other])]
    given = [pair for pair in touching if pair in centres]
    marks = [_given_mark(shown, pose, pair, centres[pair], near, size) for pair in given]
    steps = [ConstructionStep(_given_words(shown, centres, given), tuple(marks))]
    for step in known.steps:
        steps += _kennedy_steps(step, centres, near, size)
    return tuple(steps)


def _named(pair: tuple[str, str]) -> str:
    """Return what a centre is called in a sentence: P₁₃."""
    return label_of(*pair).replace("_{", "").replace("}", "").translate(_LOWERED)


def _given_words(shown: Figure, centres: dict[tuple[str, str], Centre], given: list[tuple[str, str]]) -> str:
    links, linkage = shown.by_number, shown.linkage
    joined = [pair for pair in given if joint_between(linkage, *(links[number] for number in pair))]
    slid = [
        pair
        for pair in given
        if pair not in joined and slide_between(linkage, *(links[number] for number in pair))
    ]
    geared = [pair for pair in given if pair not in joined and pair not in slid]
    words = list[str]()
    if joined:
        names = row_said([*map(_named, joined)])
        words.append(said("The joints of adjacent links are their instant centres: {names}.", names=names))
    if slid:
        far = row_said([*map(_named, slid)])
        words.append(said("Across a guide the centre of what slides is infinitely far: {names}.", names=far))
    if geared:
        words.append(said("Pitch circles touch in {names}.", names=row_said([*map(_named, geared)])))
    return " ".join(words)


def _given_mark(
    shown: Figure, pose: Pose, pair: tuple[str, str], centre: Centre, near: set[complex], size: float
) -> Mark:
    """Return the mark of a centre that is known by how links touch; of one at infinity, its direction."""
    place, way = centre
    if place is not None:
        return Mark("dot", np.array([place]), _named(pair), "first", place in near)
    slide = slide_between(shown.linkage, *(shown.by_number[number] for number in pair))
    assert slide
    foot = complex(*pose.position[slide.point])
    way = way if (way.imag, way.real) > (1e-9, 0.0) else -way
    ends = np.array([foot + _SHORT * size * way, foot])
    return Mark("dashed", ends, said("to {centre} at ∞", centre=_named(pair)), "first", True)


def _kennedy_steps(
    step: KennedyStep, centres: dict[tuple[str, str], Centre], near: set[complex], size: float
) -> list[ConstructionStep]:
    """Return the steps to a centre: a line for each of the links that lead to it, and where they meet."""
    one, other = step.pair
    target, name = centres.get(step.pair), _named(step.pair)
    place = target.place if target else None
    steps = []
    for n, third in enumerate(step.by):
        through = _through((one, third), (third, other), centres)
        ends = kennedy_line(step.pair, third, centres, _REACH * size)
        marks = []
        if ends:
            begin, end = ends
            over = _BEYOND * (end - begin)
            marks.append(Mark("dashed", np.array([begin - over, end + over]), tone="third"))
        last = n == len(step.by) - 1
        if not ends and _all_far(step.pair, third, centres):
            words = said(
                "For links {links} the line is at infinity: {centre} is infinitely far.",
                links=row_said([one, third, other]),
                centre=name,
            )
        elif not ends:
            words = said(
                "Links {links} give no line here: their centres coincide.",
                links=row_said([one, third, other]),
            )
        elif n == 0:
            words = said(
                "By Kennedy's theorem for links {links}, {centre} lies on {line}.",
                links=row_said([one, third, other]),
                centre=name,
                line=through,
            )
        elif place is not None:
            words = said(
                "For links {links} it lies on {line}, too: there it is.",
                links=row_said([one, third, other]),
                line=through,
            )
        else:
            words = said(
                "For links {links} it lies on {line}, too; both are parallel: {centre} is infinitely far.",
                links=row_said([one, third, other]),
                line=through,
                centre=name,
            )
        if last and place is not None:
            marks.append(Mark("cross", np.array([place]), name, "first", place in near))
        steps.append(ConstructionStep(words, tuple(marks)))
    return steps


def _all_far(pair: tuple[str, str], third: str, centres: dict[tuple[str, str], Centre]) -> bool:
    """Return whether the centres of two links with a third are both infinitely far."""
    known = [centres.get((end, third)) or centres.get((third, end)) for end in pair]
    return all(centre is not None and centre.place is None for centre in known)


def _through(one: tuple[str, str], other: tuple[str, str], centres: dict[tuple[str, str], Centre]) -> str:
    """Return the line through two centres in words."""
    names = [_named(pair) for pair in (one, other)]
    known = [centres.get(pair) or centres.get(pair[::-1]) for pair in (one, other)]
    far = [centre is not None and centre.place is None for centre in known]
    if any(far) and not all(far):
        there, here = names if far[0] else names[::-1]
        return said("the line through {one} towards {other}", one=here, other=there)
    return said("the line through {one} and {other}", one=names[0], other=names[1])
