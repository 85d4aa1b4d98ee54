"""The chapter of a worked solution on how a linkage was made: from its poses, function or time ratio.

Each line is computed from shown digits. The lines lead to the lengths of the linkage, which have to come out
right to five significant digits.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from itertools import combinations

from linkanim.explain.formula import TWO, Formula, Symbol, arccos, cos, number, sin, sqrt, square
from linkanim.explain.steps import (
    ANGLE,
    LENGTH,
    RATIO,
    Chapter,
    Equation,
    Powers,
    Scale,
    Step,
    SymbolNames,
    System,
    Work,
    marked,
)
from linkanim.scenes.scene import FunctionPurpose, PosesPurpose, Scene, TimeRatioPurpose
from linkanim.synthesis.constructions import dead_centres, guided_body, is_synthesised
from linkanim.words import said, to_say

_FEWEST, _MOST = 6, 12
_AGREES = 5e-6
_AREA = Powers(2)


def synthesis(scene: Scene, names: SymbolNames) -> tuple[Chapter, ...]:
    """Return the chapter on how a scene was synthesised, if it was, in the fewest digits that serve."""
    if not is_synthesised(scene):
        return ()
    for digits in range(_FEWEST, _MOST + 1):
        with suppress(ZeroDivisionError, ValueError):
            draft = _Chapter(scene, names, digits)
            if draft.agrees:
                return (draft.chapter,)
    return ()


class _Chapter:
    """The chapter in `digits` digits while it is written."""

    def __init__(self, scene: Scene, names: SymbolNames, digits: int) -> None:
        self.scene = scene
        longest = max(abs(value) for joint in scene.linkage.joints for _, value in joint.bars)
        scale = Scale(digits, scene.length_unit, longest, 1.0)
        self.work = Work(scene.linkage, names, scene.pose(0.0, 0), scale)
        self.steps: list[Step] = []
        self.compared: list[tuple[Formula, float]] = []
        self.origins: list[tuple[Formula, Formula]] = []
        self.turned: list[Formula] = []
        self.turns: list[Formula] = []
        self.shifts: list[tuple[Formula, Formula]] = []
        self.named: dict[str, Formula] = {}
        match scene.purpose:
            case PosesPurpose() as purpose:
                self._guided(purpose)
            case FunctionPurpose() as purpose:
                self._generated(purpose)
            case TimeRatioPurpose() as purpose:
                self._returning(purpose)

    @property
    def chapter(self) -> Chapter:
        """The chapter that was written."""
        return Chapter(said("Synthesis"), tuple(self.steps))

    @property
    def agrees(self) -> bool:
        """Whether the lengths that are worked out are the linkage's."""
        return all(abs(value.value - true) <= _AGREES * abs(true) for value, true in self.compared)

    def _step(self, title: str, write: Callable[[], None]) -> None:
        """Add a step with the lines that `write` adds; numbers given for them stand first."""
        self.steps.append(self.work.step(title, write, with_given=True))

    def _length(self, letter: str, sub: str, formula: Formula) -> Formula:
        return self.work.let(Symbol(letter, sub), formula, LENGTH)

    def _ratio(self, letter: str, sub: str, formula: Formula) -> Formula:
        return self.work.let(Symbol(letter, sub), formula, RATIO)

    def _joint(self, name: str) -> complex:
        pin = next(pin for pin in self.scene.linkage.pins if pin.name == name)
        return complex(*pin.position)

    def _bar(self, start: str, end: str) -> float:
        """Return the length that the scene has between two joints."""
        pairs = ((joint.name, *bar) for joint in self.scene.linkage.joints for bar in joint.bars)
        return next(value for name, other, value in pairs if {name, other} == {start, end})

    def _solve(
        self,
        unknowns: tuple[Symbol, Symbol],
        rows: tuple[tuple[Formula, ...], ...],
        measures: tuple[Powers, Powers, Powers],
    ) -> tuple[Formula, Formula]:
        """Add two equations and their solution by Cramer's rule; `measures`: determinant, both unknowns."""
        (a, b, c), (d, e, f) = rows
        self.work.items.append(System(unknowns, rows, rows))
        det = self.work.let(Symbol("D"), a * e - b * d, measures[0])
        first = self.work.let(unknowns[0], (c * e - b * f) / det, measures[1])
        return first, self.work.let(unknowns[1], (a * f - d * c) / det, measures[2])

    # Poses: each bar from its pivot, and its joint's places.

    def _guided(self, purpose: PosesPurpose) -> None:
        count = len(purpose.poses)
        body = guided_body(self.scene, purpose)
        self._step(said("Poses"), partial(self._poses, purpose))
        self._step(said("Displacements"), self._against)
        if count <= 3 and len(body.poses.poles) == count * (count - 1) // 2:
            self._step(said("Poles"), partial(self._poles, count))
        for joint, place, pivot, held in zip("AB", body.joints, ("O2", "O4"), body.held, strict=True):
            if held is None:
                assert body.line is not None
                self._step(
                    said("Slider {joint}", joint=marked(joint)),
                    partial(self._slides, joint, complex(place), body.line),
                )
            else:
                title = said("Joint {joint} for the pivot {pivot}", joint=marked(joint), pivot=marked(pivot))
                self._step(title, partial(self._turns, joint, complex(place), pivot))

    def _poses(self, purpose: PosesPurpose) -> None:
        """Add the poses as they are given: the origin's places, and the angles."""
        self.work.say(
            said(
                "The {count} poses of the body: x and y of its origin, and the angle φ of its axis.",
                count=len(purpose.poses),
            )
        )
        for n, (x, y, angle) in enumerate(purpose.poses, start=1):
            self.origins.append((self._given("x", n, x), self._given("y", n, y)))
            self.turned.append(self.work.known(Symbol("φ", str(n)), angle, ANGLE))

    def _against(self) -> None:
        """Add each pose's rotation and displacement from the first."""
        self.work.say(said("Each pose relative to the first: the rotation α and the displacement u, v."))
        (x, y), *others = self.origins
        for n, (angle, origin) in enumerate(zip(self.turned[1:], others, strict=True), start=2):
            index = str(n)
            self.turns.append(self.work.let(Symbol("α", index), angle - self.turned[0], ANGLE))
            shift = self._length("u", index, origin[0] - x), self._length("v", index, origin[1] - y)
            self.shifts.append(shift)

    def _given(self, letter: str, n: int, value: float) -> Formula:
        return self.work.known(Symbol(letter, str(n)), value, LENGTH)

    def _poles(self, count: int) -> None:
        """Add the poles: each on the perpendicular bisector of the origin's places, which it sees α apart."""
        self.work.say(
            said(
                "A rotation about the pole of two poses takes one to the other. The pole lies on the "
                "perpendicular bisector of the origin's two places, at half their distance times the "
                "cotangent of half the rotation."
            )
        )
        for one, other in combinations(range(count), 2):
            index = f"{one + 1}{other + 1}"
            (x1, y1), (x2, y2) = self.origins[one], self.origins[other]
            half = self.work.let(Symbol("β", index), (self.turned[other] - self.turned[one]) / TWO, ANGLE)
            tilt = self._ratio("k", index, cos(half) / sin(half))
            self._length("x", f"P{index}", (x1 + x2) / TWO - (y2 - y1) / TWO * tilt)
            self._length("y", f"P{index}", (y1 + y2) / TWO + (x2 - x1) / TWO * tilt)

    def _turns(self, joint: str, place: complex, pivot: str) -> None:
        """Add a joint that turns about a pivot: where it lies, and its distances from there."""
        at = self._joint(pivot)
        px = self.work.known(Symbol("x", pivot), at.real, LENGTH, said("chosen"))
        py = self.work.known(Symbol("y", pivot), at.imag, LENGTH, said("chosen"))
        ends = ("O2", "A") if joint == "A" else ("O4", "B")
        own = self._solved_place(joint, (px, py)) if len(self.turns) > 1 else self._chosen(joint, place)
        self.work.say(
            said(
                "In every pose {joint} is equally far from {pivot}, so a bar can join them.",
                joint=marked(joint),
                pivot=marked(pivot),
            )
        )
        for n, (x, y) in enumerate(self._places(joint, own), start=1):
            squared = square(x - px) + square(y - py)
            length = self._length("r", f"{pivot}{joint}{n}", sqrt(squared))
            self.compared.append((length, self._bar(*ends)))

    def _chosen(self, joint: str, place: complex) -> tuple[Formula, Formula]:
        """Return where a joint lies in the first pose, relative to the pose's origin, as it was chosen."""
        own = place - complex(self.origins[0][0].value, self.origins[0][1].value)
        return (
            self.work.known(Symbol("ξ", joint), own.real, LENGTH, said("chosen")),
            self.work.known(Symbol("η", joint), own.imag, LENGTH, said("chosen")),
        )

    def _solved_place(self, joint: str, pivot: tuple[Formula, Formula]) -> tuple[Formula, Formula]:
        """Return where a joint lies in the first pose, from its origin, by the equations of poses 2 and 3."""
        self.work.say(
            said(
                "If {joint} is as far from its pivot in pose n as in pose 1, its coordinates ξ, η "
                "from the first origin satisfy a ξ + b η = c, where p and q are the pivot's "
                "coordinates.",
                joint=marked(joint),
            )
        )
        p = self._length("p", joint, pivot[0] - self.origins[0][0])
        q = self._length("q", joint, pivot[1] - self.origins[0][1])
        rows = []
        for n, (turn, (u, v)) in enumerate(zip(self.turns[:2], self.shifts, strict=False), start=2):
            index = f"{joint}{n}"
            c, s = cos(turn), sin(turn)
            a = self._length("a", index, p - p * c - q * s + u * c + v * s)
            b = self._length("b", index, p * s + q - q * c + v * c - u * s)
            rest = self.work.let(Symbol("c", index), u * p + v * q - (square(u) + square(v)) / TWO, _AREA)
            rows.append((a, b, rest))
        unknowns = Symbol("ξ", joint), Symbol("η", joint)
        return self._solve(unknowns, tuple(rows), (_AREA, LENGTH, LENGTH))

    def _places(self, joint: str, own: tuple[Formula, Formula]) -> Iterator[tuple[Formula, Formula]]:
        """Yield a joint's place in each pose, with the lines that lead there."""
        ahead, left = own
        for n, (x, y) in enumerate(self.origins, start=1):
            if n == 1:
                place = x + ahead, y + left
            else:
                c, s = cos(self.turns[n - 2]), sin(self.turns[n - 2])
                place = x + ahead * c - left * s, y + ahead * s + left * c
            index = f"{joint}{n}"
            yield self._length("x", index, place[0]), self._length("y", index, place[1])

    def _slides(self, joint: str, place: complex, line: complex) -> None:
        """Add a joint that slides along a line: its offset from the crank's pivot in every pose."""
        own = self._chosen(joint, place)
        angle = math.atan2(line.imag, line.real)
        direction = self.work.known(Symbol("φ", "g"), angle, ANGLE, said("direction of the guide"))
        at = self._joint("O2")
        px = self.work.known(Symbol("x", "O2"), at.real, LENGTH)
        py = self.work.known(Symbol("y", "O2"), at.imag, LENGTH)
        offset = self.scene.linkage.joint(joint).line.offset  # type: ignore[attr-defined]
        self.work.say(
            said(
                "In every pose {joint} has the same offset from {pivot}, so it can slide on a line.",
                joint=marked(joint),
                pivot=marked("O2"),
            )
        )
        for n, (x, y) in enumerate(self._places(joint, own), start=1):
            beside = (y - py) * cos(direction) - (x - px) * sin(direction)
            self.compared.append((self._length("e", f"{joint}{n}", beside), float(offset)))

    # Functions: Freudenstein's equation.

    def _generated(self, purpose: FunctionPurpose) -> None:
        sliding = self.scene.linkage.joint("B").travels
        inputs: list[Formula] = []
        outputs: list[Formula] = []

        def points() -> None:
            self.work.say(said(_MET_BY_TRAVEL if sliding else _MET_BY_ANGLE, function=purpose.words))
            for n, (x, y, theta, place) in enumerate(
                zip(purpose.x, purpose.y, purpose.input, purpose.output, strict=True), start=1
            ):
                self.work.known(Symbol("x", str(n)), x, RATIO)
                self.work.known(Symbol("y", str(n)), y, RATIO)
                inputs.append(self.work.known(Symbol("θ", str(n)), theta, ANGLE))
                letter, measure = ("s", LENGTH) if sliding else ("ψ", ANGLE)
                outputs.append(self.work.known(Symbol(letter, str(n)), place, measure))

        self._step(said("Precision points"), points)
        self._step(
            said("Freudenstein's equation"), lambda: self._freudenstein(inputs, outputs, sliding=sliding)
        )

    def _freudenstein(self, inputs: list[Formula], outputs: list[Formula], *, sliding: bool) -> None:
        """Add the equation at each point, the solution of three of them, and the check of the others."""
        k1, k2, k3 = (_symbol("K", str(n)) for n in (1, 2, 3))
        theta, psi, s = _symbol("θ"), _symbol("ψ"), _symbol("s")
        if sliding:
            self.work.items.append(Equation(k1 * s * cos(theta) + k2 * sin(theta) + k3, square(s)))
        else:
            self.work.items.append(Equation(k1 * cos(psi) - k2 * cos(theta) + k3, cos(theta - psi)))
        self.work.say(
            said(
                "It is linear in the three K and holds at every point; p, q and w are its coefficients there."
            )
        )
        rows = []
        for n, (angle, output) in enumerate(zip(inputs, outputs, strict=True), start=1):
            if sliding:
                p = self._length("p", str(n), output * cos(angle))
                q = self._ratio("q", str(n), sin(angle))
                w = self.work.let(Symbol("w", str(n)), square(output), _AREA)
            else:
                p = self._ratio("p", str(n), cos(output))
                q = self._ratio("q", str(n), -cos(angle))
                w = self._ratio("w", str(n), cos(angle - output))
            rows.append((p, q, w))
        self.work.say(
            said("Subtracting the second and the last equation from the first leaves two unknowns.")
        )
        (p1, q1, w1), chosen = rows[0], (rows[len(rows) // 2], rows[-1])
        differences = []
        for n, (p, q, w) in enumerate(chosen, start=1):
            index = f"{n}"
            measures = (LENGTH, RATIO, _AREA) if sliding else (RATIO, RATIO, RATIO)
            parts = zip(("a", "b", "c"), (p - p1, q - q1, w - w1), measures, strict=True)
            differences.append(
                tuple(self.work.let(Symbol(letter, index), part, measure) for letter, part, measure in parts)
            )
        unknowns = Symbol("K", "1"), Symbol("K", "2")
        measured = (LENGTH, LENGTH, _AREA) if sliding else (RATIO, RATIO, RATIO)
        one, two = self._solve(unknowns, tuple(differences), measured)
        three = self.work.let(Symbol("K", "3"), w1 - p1 * one - q1 * two, _AREA if sliding else RATIO)
        self._lengths(one, two, three, sliding=sliding)
        others = [n for n in range(len(rows)) if n not in (0, len(rows) // 2, len(rows) - 1)]
        if others:
            self.work.say(said("The equations that were not used are satisfied too:"))
        for n in others:
            p, q, w = rows[n]
            check = self.work.let(
                Symbol("w", str(n + 1), "′"), one * p + two * q + three, _AREA if sliding else RATIO
            )
            self.compared.append((check, w.value))

    def _lengths(self, one: Formula, two: Formula, three: Formula, *, sliding: bool) -> None:
        """Add the lengths that follow from the three K."""
        if sliding:
            crank = self._length("r", "2", one / TWO)
            offset = self._length("e", "", two / one)
            rod = self._length("r", "3", sqrt(three + square(crank) + square(offset)))
            line = self.scene.linkage.joint("B").line  # type: ignore[attr-defined]
            self.compared += [
                (crank, self._bar("O2", "A")),
                (rod, self._bar("A", "B")),
                (offset, float(line.offset)),
            ]
            return
        span = abs(self._joint("O4") - self._joint("O2"))
        ground = self.work.known(Symbol("r", "1"), span, LENGTH, said("the ground, chosen"))
        crank = self._length("r", "2", ground / one)
        rocker = self._length("r", "4", ground / two)
        rest = square(ground) + square(crank) + square(rocker) - TWO * crank * rocker * three
        coupler = self._length("r", "3", sqrt(rest))
        bars = (("O2", "A"), ("O4", "B"), ("A", "B"))
        self.compared += [
            (length, self._bar(*ends)) for length, ends in zip((crank, rocker, coupler), bars, strict=True)
        ]

    # Time ratios: Alt's construction.

    def _returning(self, purpose: TimeRatioPurpose) -> None:
        even = dead_centres(self.scene).angle <= 1e-6
        self._step(said("The angle of the time ratio"), partial(self._angle, purpose))
        self._step(said("The chord"), partial(self._chord, purpose))
        self._step(said("Crank and coupler"), partial(self._crank_and_coupler, even=even))
        self._step(said("The crank's pivot"), partial(self._pivot, self.named, even=even))
        self._step(said("Transmission angle"), partial(self._transmission, self.named))

    def _angle(self, purpose: TimeRatioPurpose) -> None:
        """Add the angle between the dead centres' directions."""
        quotient = self.work.known(Symbol("Q"), purpose.ratio, RATIO, said("slow to quick"))
        self.work.say(
            said("The crank turns by 180° + α during the slow stroke and by 180° − α during the quick one.")
        )
        straight, one = number("180", in_degrees=True), number("1")
        self.named["α"] = self.work.let(Symbol("α"), straight * (quotient - one) / (quotient + one), ANGLE)

    def _chord(self, purpose: TimeRatioPurpose) -> None:
        """Add the distance between the dead centres: the stroke, or the chord of the swing."""
        if purpose.swing is None:
            stroke = purpose.stroke or 0.0
            self.named["H"] = self.work.known(Symbol("H"), stroke, LENGTH, said("the stroke"))
            return
        swing = self.work.known(Symbol("ψ"), purpose.swing, ANGLE, said("the rocker's swing"))
        rocker = self.work.known(Symbol("r", "4"), self._bar("O4", "B"), LENGTH, said("the rocker, chosen"))
        self.work.say(said("The chord between the two dead centres of the rocker's pin is H."))
        chord = self._length("H", "", TWO * rocker * sin(swing / TWO))
        self.named |= {"ψ": swing, "c": rocker, "H": chord}

    def _crank_and_coupler(self, *, even: bool) -> None:
        """Add crank and coupler: one is chosen, the other follows from it and the chord."""
        crank, chord = self._bar("O2", "A"), self.named["H"]
        if even:
            coupler = self.work.known(Symbol("r", "3"), self._bar("A", "B"), LENGTH, said("chosen"))
            self.work.say(said("Without a quick return the crank is half the chord."))
            length = self._length("r", "2", chord / TWO)
        else:
            self.work.say(
                said(
                    "Coupler minus crank and coupler plus crank, with α between them, form a triangle with H."
                )
            )
            length = self.work.known(Symbol("r", "2"), crank, LENGTH, said("the crank, chosen"))
            half = self.named["α"] / TWO
            coupler = self._length(
                "r", "3", sqrt(square(chord) - square(TWO * length * cos(half))) / (TWO * sin(half))
            )
        self.named |= {"a": length, "b": coupler}
        self.compared += [(length, crank), (coupler, self._bar("A", "B"))]

    def _pivot(self, named: dict[str, Formula], *, even: bool) -> None:
        """Add how far the crank's pivot is off the chord, and for a crank-rocker the ground."""
        a, b, chord = named["a"], named["b"], named["H"]
        off = number("0")
        if not even:
            self.work.say(
                said("The crank's pivot lies this far off the line of the chord: the height of the triangle.")
            )
            off = self._length("e", "", (square(b) - square(a)) * sin(named["α"]) / chord)
        if "c" not in named:
            line = self.scene.linkage.joint("B").line  # type: ignore[attr-defined]
            self.compared += [] if even else [(off, abs(float(line.offset)))]
            named["e"] = off
            return
        across = self._length("m", "", TWO * a * b / chord)
        height = self._length("h", "", named["c"] * cos(named["ψ"] / TWO))
        true = abs(self._joint("O4") - self._joint("O2"))
        sides = [height - off, height + off]
        chosen = min(sides, key=lambda side: abs(math.hypot(across.value, side.value) - true))
        self.work.say(
            said(
                "The rocker's pivot lies h off the chord, over its middle, m from the crank's pivot along it."
            )
        )
        named["d"] = self._length("r", "1", sqrt(square(across) + square(chosen)))
        self.compared.append((named["d"], true))

    def _transmission(self, named: dict[str, Formula]) -> None:
        """Add the least transmission angle over the turn."""
        info = self.scene.info.transmission
        least = math.degrees(info.least) if info else 90.0
        a, b = named["a"], named["b"]
        if "c" not in named:
            self.work.say(said("The rod is steepest where the crank is square to the guide."))
            angle = self.work.let(Symbol("μ"), arccos((a + named["e"]) / b), ANGLE)
            self.compared.append((angle, least))
            return
        c, d = named["c"], named["d"]
        self.work.say(
            said("It is extreme where crank and ground are in line; beyond 90° its supplement counts.")
        )
        for n, reach in (("1", d - a), ("2", d + a)):
            corner = arccos((square(b) + square(c) - square(reach)) / (TWO * b * c))
            angle = self.work.let(Symbol("μ", n), corner, ANGLE)
            if abs(min(angle.value, 180 - angle.value) - least) < 1e-3:
                true = least if angle.value <= 90 else 180 - least
                self.compared.append((angle, true))


_MET_BY_TRAVEL = to_say(
    "{function} is met at these points: x is the crank's angle θ to scale, y is the slider's travel s."
)
_MET_BY_ANGLE = to_say(
    "{function} is met at these points: x is the crank's angle θ to scale, y is the output's angle ψ."
)


def _symbol(letter: str, sub: str = "") -> Formula:
    """Return a letter that stands for itself."""
    return Formula("leaf", symbol=Symbol(letter, sub), shown="0")
