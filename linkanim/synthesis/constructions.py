"""The construction of a synthesis as a lecturer draws it: marks in the scene's unit, step by step.

It is made from the scene's `purpose` (what it was made for) and its joints; without a purpose there is none.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from itertools import pairwise
from typing import Literal, NamedTuple, cast

import numpy as np

from linkanim.errors import BadInput
from linkanim.mechanics.linkage import RRP, RRR, Crank
from linkanim.mechanics.measures import as_complex
from linkanim.scenes.scene import FunctionPurpose, PosesPurpose, Scene, TimeRatioPurpose
from linkanim.synthesis.burmester import CentreCurve, Poses, burmester_points, circle_points
from linkanim.synthesis.linkages import Complex, Real
from linkanim.units import four_digits
from linkanim.words import name_said, said, to_say

Shape = Literal["plate", "line", "dashed", "thin", "bar", "dot", "ring", "cross", "frame", "arc", "word"]
Tone = Literal["ink", "dim", "first", "second", "third", "fourth"]

_NEAR, _FAR = 2.0, 4.0
"""The distances, in the poses' size, up to which the picture is fitted, and up to which a pole is drawn."""
_INNER, _OUTER = 0.6, 1.1
"""The radii of the scales of input and output, in lengths of their links."""
_SWING = 0.35
"""How far an arc runs to each side of a dead centre (rad)."""
_CURVE = 1600
_ARC = 64
_ALIKE = 1e-6
"""The share of its length by which a rod may differ from its crank and count as equally long."""
_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


class Mark(NamedTuple):
    """A mark to draw: a shape through or at points (x + yi), its label, and its tone.

    A frame's points are its origin and the end of its x axis; an arc's are all points along it; a word is
    only its label, about its point. A mark that `spreads` does not count when the picture is fitted.
    """

    shape: Shape
    points: Complex
    label: str = ""
    tone: Tone = "ink"
    spreads: bool = False


class ConstructionStep(NamedTuple):
    """A step of a construction: a sentence about it, and the marks that it adds."""

    words: str
    marks: tuple[Mark, ...]


def construction(scene: Scene) -> tuple[ConstructionStep, ...]:
    """Return the steps of a scene's synthesis; BadInput for a scene without a known purpose."""
    match scene.purpose if is_synthesised(scene) else None:
        case PosesPurpose() as purpose:
            return tuple(_guided(scene, purpose))
        case FunctionPurpose() as purpose:
            return tuple(_generated(scene, purpose))
        case TimeRatioPurpose() as purpose:
            return tuple(_returning(scene, purpose))
    raise BadInput(
        f"{scene.name}: has no construction; one is drawn of what linkanim guide, function and "
        "quick-return have made"
    )


def is_synthesised(scene: Scene) -> bool:
    """Tell whether a scene has a crank O2–A and a coupler A–B that ends on a bar to O4, or on a line."""
    joints = scene.linkage.by_name
    if scene.purpose is None or not {"O2", "A", "B"} <= joints.keys():
        return False
    if isinstance(scene.purpose, PosesPurpose) and not scene.trace:
        return False
    crank, end = joints["A"], joints["B"]
    ours = isinstance(end, RRR) and end.ends == ("A", "O4") and joints["O4"].fixed
    sliding = isinstance(end, RRP) and end.line.on is None
    return isinstance(crank, Crank) and crank.pivot == "O2" and joints["O2"].fixed and (ours or sliding)


def _step(words: str, *marks: Mark) -> ConstructionStep:
    return ConstructionStep(words, marks)


def _at(*points: complex) -> Complex:
    return np.array(points, dtype=np.complex128)


class GuidedBody(NamedTuple):
    """Poses, and in the first of them the coupler's two joints and their pivots.

    `held` is each joint's pivot, None for a joint that slides on a line with the direction `line`.
    """

    poses: Poses
    joints: Complex
    held: tuple[complex, complex | None]
    line: complex | None


def guided_body(scene: Scene, purpose: PosesPurpose) -> GuidedBody:
    """Return a scene's coupler in the first of the poses that it was made for."""
    rows = np.array(purpose.poses)
    poses = Poses(rows[:, 0] + 1j * rows[:, 1], rows[:, 2].copy())
    motion = scene.cycle(720, derivatives=0)
    phases = np.concatenate([motion.phase, [float(scene.solve(angle=scene.linkage.drive.start).phase)]])
    motion = scene.solve(phase=phases, derivatives=0)
    point = as_complex(motion.position[scene.trace[0]])
    nearest = int(np.abs(point - poses.origins[0]).argmin())
    body = next(body for body in scene.linkage.bodies if scene.trace[0] in body.joints)
    joints = np.array([as_complex(motion.position[name])[nearest] for name in body.joints[:2]])
    pins = {pin.name: complex(*pin.position) for pin in scene.linkage.pins}
    if "O4" in pins:
        return GuidedBody(poses, joints, (pins["O2"], pins["O4"]), None)
    line = scene.linkage.joint("B").line  # type: ignore[attr-defined]
    return GuidedBody(poses, joints, (pins["O2"], None), cmath.exp(1j * float(line.angle)))


def _guided(scene: Scene, purpose: PosesPurpose) -> Iterator[ConstructionStep]:
    """Yield the steps of a body's guidance."""
    body = guided_body(scene, purpose)
    poses = body.poses
    places = [poses.places(complex(joint)) for joint in body.joints]
    reach = 0.18 * poses.size
    frames = [
        Mark("frame", _at(origin, origin + reach * cmath.exp(1j * angle)), str(n), spreads=True)
        for n, (origin, angle) in enumerate(zip(poses.origins, poses.angles, strict=True), start=1)
    ]
    yield _step(said("The body in its {count} poses.", count=poses.count), *frames)
    bodies = [
        Mark("plate", _at(places[0][n], places[1][n], poses.origins[n]), tone="dim")
        for n in range(poses.count)
    ]
    tones: tuple[tuple[str, Tone], ...] = (("A", "first"), ("B", "second"))
    joints = [
        Mark("ring", _at(place), _numbered(name, n), tone, spreads=True)
        for (name, tone), each in zip(tones, places, strict=True)
        for n, place in enumerate(each, start=1)
    ]
    yield _step(said("Two of its joints, A and B, in each pose."), *bodies, *joints)
    if poses.count <= 3:
        yield from _midperpendiculars(body, places)
        yield from _pole_triangle(poses)
    elif poses.poles:
        yield from _curves(poses)
    yield _linkage(body)


def _numbered(name: str, *numbers: int) -> str:
    return name + "".join(map(str, numbers)).translate(_SUBSCRIPTS)


def _midperpendiculars(body: GuidedBody, places: list[Complex]) -> Iterator[ConstructionStep]:
    """Yield the midperpendiculars of each joint's places, which meet in its pivot, or the slider's line."""
    tones: tuple[Tone, Tone] = ("first", "second")
    for name, pivot, each, tone, held in zip("AB", ("O2", "O4"), places, tones, body.held, strict=True):
        chords = [Mark("thin", _at(*pair), tone=tone) for pair in pairwise(each)]
        if held is None:
            assert body.line is not None
            reach = body.poses.size * body.line
            line = Mark("line", _at(each[0] - reach, each[-1] + reach), tone=tone)
            yield _step(
                said("The places of {joint} lie on one line: there it slides.", joint=name), *chords, line
            )
            continue
        lines = []
        for one, other in pairwise(each):
            middle = (one + other) / 2
            lines.append(Mark("dashed", _at(middle, held + 0.12 * (held - middle)), tone=tone))
        one = len(lines) == 1
        words = (
            said(
                "{pivot} is a point of the midperpendicular of {chord}.",
                pivot=pivot,
                chord=f"{name}₁{name}₂",
            )
            if one
            else said(
                "The midperpendiculars of {one} and {other} meet in {pivot}.",
                one=f"{name}₁{name}₂",
                other=f"{name}₂{name}₃",
                pivot=pivot,
            )
        )
        yield _step(words.replace("O2", "O₂").replace("O4", "O₄"), *chords, *lines)


def _pole_triangle(poses: Poses) -> Iterator[ConstructionStep]:
    """Yield the poles: about P₁₂ a turn takes the first pose to the second; three are a triangle."""
    near = {pair: pole for pair, pole in poses.poles.items() if abs(pole - poses.centre) <= _FAR * poses.size}
    if not near:
        return
    marks = [_pole(poses, pair, pole) for pair, pole in near.items()]
    if len(near) == 3:
        corners = list(near.values())
        marks.append(Mark("dashed", _at(*corners, corners[0]), tone="third"))
        yield _step(
            said("The poles of the poses, the pole triangle: its angles are half of their turns."), *marks
        )
    else:
        yield _step(said("The pole: a turn about it takes one pose to the other."), *marks)


def _pole(poses: Poses, pair: tuple[int, int], pole: complex) -> Mark:
    near = abs(pole - poses.centre) <= _NEAR * poses.size
    return Mark("cross", _at(pole), _numbered("P", pair[0] + 1, pair[1] + 1), "third", spreads=near)


def pose_marks(poses: Poses, count: int = _CURVE) -> tuple[Mark, ...]:
    """Return the marks of Burmester's theory: poles, the curves of four poses, the points of five.

    A curve is drawn by `count` points of each of its circuits.
    """
    steps = _pole_triangle(poses) if poses.count <= 3 else _curves(poses, count) if poses.poles else ()
    return tuple(mark for step in steps for mark in step.marks)


def _curves(poses: Poses, count: int = _CURVE) -> Iterator[ConstructionStep]:
    """Yield Burmester's curves of four poses with the poles they run through, or the points of five."""
    four = poses if poses.count == 4 else Poses(poses.origins[:4], poses.angles[:4])
    curve = CentreCurve(four)
    phases = np.linspace(0, math.tau, count)
    walks = [curve.at(circuit, phases) for circuit in range(len(curve.circuits))]
    centres = [Mark("line", walk, tone="third") for walk in walks]
    circles = [Mark("line", circle_points(four, walk), tone="fourth") for walk in walks]
    words = said("The curves of the centre points and, in pose 1, of the circle points.")
    if poses.count != 4:
        words = said("The curves of the centre points and, in pose 1, of the circle points of poses 1 to 4.")
    yield _step(words, *centres, *circles)
    near = {pair: pole for pair, pole in four.poles.items() if abs(pole - poses.centre) <= _FAR * poses.size}
    marks = [_pole(poses, pair, pole) for pair, pole in near.items()]
    ring = [(0, 1), (1, 2), (2, 3), (0, 3)]
    if all(pair in near for pair in ring):
        corners = [near[pair] for pair in (*ring, ring[0])]
        marks.append(Mark("dashed", _at(*corners), tone="third"))
    yield _step(
        said("The poles, among them the quadrilateral of two pairs of opposite ones, lie on the former."),
        *marks,
    )
    if poses.count > 4:
        yield from _of_last(poses, phases)
        bars = burmester_points(poses)
        shapes: tuple[tuple[Shape, Complex], ...] = (("dot", bars.centre), ("ring", bars.circle))
        marks = [
            Mark(shape, _at(place), tone="ink", spreads=bool(abs(place - poses.centre) <= _NEAR * poses.size))
            for shape, places in shapes
            for place in places
        ]
        words = said(
            "Of all five poses {count} of Burmester's four pairs of points are real.", count=len(bars.centre)
        )
        yield _step(words, *marks)


def _of_last(poses: Poses, phases: Real) -> Iterator[ConstructionStep]:
    """Yield the curve of the first three poses and the last: two such curves meet in Burmester's points.

    Of the nine points that two cubics share, two are the circular points at infinity, and three are poles.
    """
    which = np.array([0, 1, 2, -1])
    others = Poses(poses.origins[which], poses.angles[which])
    if others.poles:
        curve = CentreCurve(others)
        walks = [curve.at(circuit, phases) for circuit in range(len(curve.circuits))]
        yield _step(
            said(
                "That of the centre points of poses 1, 2, 3 and 5 crosses it at P₁₂, P₁₃, P₂₃ and, of all "
                "five poses, at Burmester's points."
            ),
            *(Mark("line", walk, tone="dim") for walk in walks),
        )


def _linkage(body: GuidedBody) -> ConstructionStep:
    """Return the linkage in the first pose."""
    first, second = (complex(joint) for joint in body.joints)
    marks = [Mark("plate", _at(first, second, body.poses.origins[0]), tone="ink")]
    for name, joint, held in zip(("O₂", "O₄"), (first, second), body.held, strict=True):
        if held is not None:
            marks += [Mark("bar", _at(held, joint)), Mark("dot", _at(held), name, spreads=True)]
    return _step(said("The linkage in pose 1."), *marks)


def _generated(scene: Scene, purpose: FunctionPurpose) -> Iterator[ConstructionStep]:
    """Yield the steps of a function generator: both scales, and the linkage in its precision points."""
    motion = scene.solve(angle=np.array(purpose.input), derivatives=0)
    names = ("O2", "A", "B")
    pivot, pins, ends = (np.broadcast_to(as_complex(motion.position[name]), len(purpose.x)) for name in names)
    start = complex(pivot[0])
    crank = abs(pins[0] - start)
    ticks = [
        _tick(start, angle, _INNER * crank, f"x = {x:.4g}", "first")
        for x, angle in zip(purpose.x, purpose.input, strict=True)
    ]
    yield _step(
        said(
            "x is read on the input's angle, on an even scale: {count} precision points.",
            count=len(purpose.x),
        ),
        Mark("arc", _arc(start, purpose.input[0], purpose.input[-1], _INNER * crank), tone="first"),
        *ticks,
        Mark("dot", _at(start), "O₂", spreads=True),
    )
    pins_of = {pin.name: complex(*pin.position) for pin in scene.linkage.pins}
    other = pins_of.get("O4")
    if other is None:
        places = [
            Mark("ring", _at(end), f"y = {y:.4g}", "second", spreads=True)
            for end, y in zip(ends, purpose.y, strict=True)
        ]
        yield _step(
            said("y is read on the slider's way, likewise."),
            Mark("line", ends, tone="second"),
            *places,
        )
    else:
        reach = _OUTER * abs(ends[0] - other)
        angles = np.unwrap(np.angle(ends - other)).tolist()
        yield _step(
            said("y is read on the output's angle, likewise."),
            Mark("arc", _arc(other, angles[0], angles[-1], reach), tone="second"),
            *(
                _tick(other, angle, reach, f"y = {y:.4g}", "second")
                for y, angle in zip(purpose.y, angles, strict=True)
            ),
            Mark("dot", _at(other), "O₄", spreads=True),
        )
    held = [] if other is None else [other]
    polylines = [_at(start, pin, end, *held) for pin, end in zip(pins, ends, strict=True)]
    first, *rest = polylines
    marks = [
        *(Mark("thin", polyline, tone="dim", spreads=True) for polyline in rest),
        Mark("bar", first, spreads=True),
    ]
    yield _step(
        said("The linkage in its precision points: there what it does is y, to the last digit."), *marks
    )
    yield from _freudenstein(scene, purpose, None if other is None else abs(other - start))


def _freudenstein(scene: Scene, purpose: FunctionPurpose, r1: float | None) -> Iterator[ConstructionStep]:
    """Yield Freudenstein's equations with their numbers, and the lengths that they lead to.

    `r1` is the ground's length, None for a slider.
    """
    theta, output = np.array(purpose.input), np.array(purpose.output)
    if r1 is None:
        form, right = "K₁ s cos θ + K₂ sin θ + K₃ = s²", output**2
        rows = np.column_stack([output * np.cos(theta), np.sin(theta), np.ones_like(theta)])
    else:
        form, right = "K₁ cos ψ − K₂ cos θ + K₃ = cos(θ − ψ)", np.cos(theta - output)
        rows = np.column_stack([np.cos(output), -np.cos(theta), np.ones_like(theta)])
    k1, k2, k3 = np.linalg.lstsq(rows, right, rcond=None)[0].tolist()
    equations = "; ".join(
        f"{four_digits(a)} K₁ {_joined(b)} K₂ + K₃ = {four_digits(c)}"
        for (a, b, _), c in zip(rows, right, strict=True)
    )
    yield _step(
        said(
            "Freudenstein's equation, {equation}, holds in each point: {points}.",
            equation=form,
            points=equations,
        )
    )
    bars = {
        frozenset((joint.name, end)): value for joint in scene.linkage.joints for end, value in joint.bars
    }
    r2, r3 = bars[frozenset(("O2", "A"))], bars[frozenset(("A", "B"))]
    given = f"K₁ = {four_digits(k1)}, K₂ = {four_digits(k2)}, K₃ = {four_digits(k3)}"
    if r1 is None:
        offset = f"e = K₂/K₁ = {four_digits(k2 / k1)}"
        found = f"{given}; r₂ = K₁/2 = {r2:.4g}, {offset}, r₃ = √(K₃ + r₂² + e²) = {r3:.4g}"
        yield _step(said("So {equations}.", equations=found))
    else:
        r4 = bars[frozenset(("O4", "B"))]
        ground = f"r₁ = {four_digits(r1)}"
        found = (
            f"r₂ = r₁/K₁ = {r2:.4g}, r₄ = r₁/K₂ = {r4:.4g}, r₃ = √(r₁² + r₂² + r₄² − 2 r₂ r₄ K₃) = {r3:.4g}"
        )
        yield _step(
            said("So {constants}; with {ground} {lengths}.", constants=given, ground=ground, lengths=found)
        )


def _joined(value: float) -> str:
    """Return a number as a term after another one, with its sign as the operator between them."""
    return f"{'−' if value < 0 else '+'} {four_digits(abs(value))}"


def _tick(centre: complex, angle: float, reach: float, label: str, tone: Tone) -> Mark:
    ray = cmath.exp(1j * angle)
    return Mark(
        "thin", _at(centre + 0.97 * reach * ray, centre + 1.03 * reach * ray), label, tone, spreads=True
    )


def _arc(centre: complex, first: float, last: float, reach: float) -> Complex:
    return np.asarray(centre + reach * np.exp(1j * np.linspace(first, last, _ARC)))


class InLineCentres(NamedTuple):
    """A linkage in both dead centres of its output: the crank's pivot, the crank's pins, the output's pins.

    `pivot` is the rocker's, None for a slider.
    """

    crank_pivot: complex
    pins: tuple[complex, complex]
    ends: tuple[complex, complex]
    pivot: complex | None

    @property
    def angle(self) -> float:
        """The angle between the directions of both ends from the crank's pivot (rad)."""
        return abs(cmath.phase((self.ends[1] - self.crank_pivot) / (self.ends[0] - self.crank_pivot)))

    @property
    def swing(self) -> float:
        """The rocker's swing (rad), with its sense; 0 of a slider."""
        if self.pivot is None:
            return 0.0
        return cmath.phase((self.ends[1] - self.pivot) / (self.ends[0] - self.pivot))


def in_line_parts(scene: Scene) -> tuple[str, str, str, str | None] | None:
    """Return the joints of a slider-crank or a crank-rocker whose crank is the input; None of others.

    They are the crank's pivot and its pin, the coupler's end, and the rocker's pivot, None for a slider. In a
    longer chain these are the first loop's joints. A coupler whose end does not swing has no dead centres,
    nor has a rod as long as its crank, whose end may stay at the crank's pivot.
    """
    linkage = scene.linkage
    crank = linkage.driven.joint
    if not isinstance(crank, Crank) or not scene.info.full_turn:
        return None
    for joint in linkage.joints:
        if isinstance(joint, RRP) and joint.end == crank.name and joint.line.on is None:
            rests = math.isclose(joint.length, crank.length, rel_tol=_ALIKE)
            return None if rests else (crank.pivot, crank.name, joint.name, None)
        if isinstance(joint, RRR) and crank.name in joint.ends:
            own = joint.ends.index(crank.name)
            held, coupler, rocker = joint.ends[1 - own], joint.lengths[own], joint.lengths[1 - own]
            if linkage.joint(held).fixed:
                apart = abs(_pin_of(scene, held) - _pin_of(scene, crank.pivot))
                near, far = abs(coupler - crank.length), coupler + crank.length
                swings = abs(apart - rocker) < near and far < apart + rocker
                return (crank.pivot, crank.name, joint.name, held) if swings else None
    return None


def _pin_of(scene: Scene, name: str) -> complex:
    return complex(*scene.linkage.pin(name).position)


def dead_centres(scene: Scene) -> InLineCentres:
    """Return a crank-rocker or slider-crank with crank and coupler in line: overlapping, then stretched."""
    parts = in_line_parts(scene)
    assert parts
    o2, a, b, held = parts
    start = _pin_of(scene, o2)
    motion = scene.cycle(1440, derivatives=0)
    far = np.abs(as_complex(motion.position[b]) - start)
    crank = abs(complex(*scene.pose(0.0, 0).position[a]) - start)
    ends, pins = [], []
    for place in (far.argmin(), far.argmax()):
        phase = _in_line(scene, (a, b), float(motion.phase[place]), start)
        pose = scene.pose(phase, 0)
        end, pin = (complex(*pose.position[name]) for name in (b, a))
        ends.append(end)
        pins.append(start + crank * (pin - start) / abs(pin - start))
    pivot = _pin_of(scene, held) if held else None
    return InLineCentres(start, (pins[0], pins[1]), (ends[0], ends[1]), pivot)


def _in_line(scene: Scene, coupler: tuple[str, str], phase: float, start: complex) -> float:
    """Return the phase near a given one at which crank and coupler lie in line, by Newton's steps."""
    for _ in range(8):
        pose = scene.pose(phase, 1, speed=1.0)
        pin, end = (complex(*pose.position[name]) - start for name in coupler)
        pin_rate, end_rate = (complex(*pose.velocity[name]) for name in coupler)
        off = (pin.conjugate() * end).imag
        rate = (pin_rate.conjugate() * end).imag + (pin.conjugate() * end_rate).imag
        phase -= off / rate
    return phase


def dead_centre_steps(scene: Scene) -> tuple[ConstructionStep, ...]:
    """Return how compasses find the dead centres of a slider-crank or crank-rocker from its lengths."""
    parts, centres = in_line_parts(scene), dead_centres(scene)
    assert parts
    start, (near, far) = centres.crank_pivot, centres.ends
    (o2, a, b, held), unit = parts, scene.length_unit
    o2 = o2.translate(_SUBSCRIPTS)
    crank, coupler = abs(centres.pins[0] - start), abs(far - centres.pins[1])
    word = name_said("rod" if centres.pivot is None else "coupler")
    marks = [
        Mark("dot", _at(start), o2, spreads=True),
        Mark("thin", _circled(start, crank), tone="first", spreads=True),
    ]
    if centres.pivot is None:
        over = 0.25 * (far - near)
        where, marks = (
            said("its line of travel"),
            [*marks, Mark("line", _at(near - over, far + over), tone="second")],
        )
        words = said(
            "Given are the crank's circle about {pivot} and the line of travel of {joint}.",
            pivot=o2,
            joint=b,
        )
    else:
        o4 = (held or "").translate(_SUBSCRIPTS)
        where, arm = said("the circle about {pivot}", pivot=o4), abs(far - centres.pivot)
        begin, swing = cmath.phase(near - centres.pivot), centres.swing
        arc = _arc(centres.pivot, begin - 0.3 * swing, begin + 1.3 * swing, arm)
        marks += [
            Mark("dot", _at(centres.pivot), o4, spreads=True),
            Mark("arc", arc, tone="second", spreads=True),
        ]
        words = said(
            "Given are the crank's circle about {pivot} and the circle of {joint} about {other}.",
            pivot=o2,
            joint=b,
            other=o4,
        )
    steps = [_step(words, *marks)]
    stretched = (
        to_say(
            "Stretched out, crank and {link} lie in line: {end} is on {line}, {length} from {pivot}: {sum}."
        ),
        said("{link} plus crank", link=word),
        coupler + crank,
        "bar",
    )
    less = said("{link} less crank", link=word) if coupler > crank else said("crank less {link}", link=word)
    folded = (
        to_say("Folded, crank and {link} lie in line: {end} is on {line}, {length} from {pivot}: {sum}."),
        less,
        abs(coupler - crank),
        "thin",
    )
    for end, pin, dash, (how, made, length, shape) in (
        (far, centres.pins[1], "″", stretched),
        (near, centres.pins[0], "′", folded),
    ):
        turn = cmath.phase(end - start)
        around = Mark("arc", _arc(start, turn - _SWING, turn + _SWING, abs(end - start)), tone="third")
        words = said(
            how,
            link=word,
            end=f"{b}{dash}",
            line=where,
            length=f"{length:.4g} {unit}",
            pivot=o2,
            sum=made,
        )
        steps.append(_step(words, around, Mark("ring", _at(end), f"{b}{dash}", "second", True)))
        bars = [Mark(cast(Shape, shape), _at(start, pin, end))]
        bars += [Mark("thin", _at(centres.pivot, end))] if centres.pivot is not None else []
        angle = math.degrees(cmath.phase(pin - start)) % 360
        words = said(
            "The crank pin {pin} lies on {line}: there the input stands at {angle}.",
            pin=f"{a}{dash}",
            line=f"{o2}{b}{dash}",
            angle=f"{angle:.4g}°",
        )
        steps.append(_step(words, *bars, Mark("ring", _at(pin), f"{a}{dash}", "first", True)))
    alpha = math.degrees(centres.angle)
    if centres.pivot is None:
        what = said("The stroke is {chord}", chord=f"{b}′{b}″ = {abs(far - near):.4g} {unit}")
    else:
        what = said("The swing is {angle}", angle=f"{abs(math.degrees(centres.swing)):.4g}°")
    if alpha > 1e-6:
        ratio = (180 + alpha) / (180 - alpha)
        begin, turn = cmath.phase(near - start), cmath.phase((far - start) / (near - start))
        corner = Mark("arc", _arc(start, begin, begin + turn, 0.3 * abs(near - start)), "α", "first")
        words = said(
            "{extent}; seen from {pivot} it is {angle}: the time ratio is {ratio}.",
            extent=what,
            pivot=o2,
            angle=f"α = {alpha:.4g}°",
            ratio=f"(180° + α)/(180° − α) = {ratio:.4g}",
        )
        steps.append(_step(words, corner, Mark("thin", _at(near, far), tone="fourth")))
    else:
        words = said(
            "{extent}; it lies in line with {pivot}, so both ways take the same time.", extent=what, pivot=o2
        )
        steps.append(_step(words, Mark("thin", _at(near, far), tone="fourth")))
    return tuple(steps)


def _circled(middle: complex, radius: float) -> Complex:
    return np.asarray(middle + radius * np.exp(1j * np.linspace(0, math.tau, 2 * _ARC)))


def _returning(scene: Scene, purpose: TimeRatioPurpose) -> Iterator[ConstructionStep]:
    """Yield the steps of Alt's construction."""
    centres = dead_centres(scene)
    start, (near, far) = centres.crank_pivot, centres.ends
    alpha = math.degrees(centres.angle)
    chord = [Mark("ring", _at(near), "B′", "second", True), Mark("ring", _at(far), "B″", "second", True)]
    if centres.pivot is None:
        chord.append(Mark("line", _at(near, far), tone="second"))
        yield _step(said("The slider's stroke, between its dead centres B′ and B″."), *chord)
    else:
        arms = [Mark("thin", _at(centres.pivot, end), tone="second") for end in centres.ends]
        chord.append(Mark("thin", _at(near, far), tone="second"))
        pivot = Mark("dot", _at(centres.pivot), "O₄", spreads=True)
        yield _step(said("The rocker's swing, between its dead centres B′ and B″."), *arms, *chord, pivot)
    ratio = f"{purpose.ratio:g}"
    rays = [Mark("dashed", _at(start, end), tone="first") for end in centres.ends]
    pin = Mark("dot", _at(start), "O₂", spreads=True)
    if centres.angle > 1e-6:
        corner = Mark(
            "arc",
            _arc(
                start,
                cmath.phase(near - start),
                cmath.phase(near - start) + cmath.phase((far - start) / (near - start)),
                0.3 * abs(near - start),
            ),
            "α",
            "first",
        )
        yield _step(
            said(
                "A time ratio Q of {ratio} asks for {angle}: at that angle O₂ sees the chord.",
                ratio=ratio,
                angle=f"α = 180° (Q − 1)/(Q + 1) = {alpha:.4g}°",
            ),
            *rays,
            corner,
            pin,
        )
        middle, radius = _circle(start, near, far)
        circle = Mark(
            "arc",
            _circled(middle, radius),
            tone="third",
            spreads=True,
        )
        yield _step(
            said("All points that see it so lie on Alt's circle through B′ and B″; O₂ is chosen on it."),
            circle,
        )
    else:
        yield _step(said("Without a quick return O₂ lies on the chord's line."), *rays, pin)
    joints = [
        Mark("ring", _at(place), label, "first", True)
        for place, label in zip(centres.pins, ("A′", "A″"), strict=True)
    ]
    bars = [
        Mark("bar", _at(start, centres.pins[1], far)),
        Mark("thin", _at(start, centres.pins[0], near)),
    ]
    yield _step(
        said("O₂B″ is coupler and crank, O₂B′ coupler less crank: half their difference is the crank."),
        *bars,
        *joints,
    )


def _circle(one: complex, two: complex, three: complex) -> tuple[complex, float]:
    a, b = two - one, three - one
    across = 2 * (a.conjugate() * b).imag
    middle = one + 1j * (a * abs(b) ** 2 - b * abs(a) ** 2) / across
    return middle, abs(middle - one)
