"""Where the input is and how it moves: as it was asked for, or from the phase."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from linkanim.explain.expression import TWO, Formula, Symbol, arccos, cos, number, sin, square
from linkanim.explain.lines import marked
from linkanim.explain.rates import Rates
from linkanim.explain.work import ANGLE, LENGTH, RATIO, Powers
from linkanim.mechanics.drive.strokes import CylinderStroke, Stroke
from linkanim.mechanics.linkage.pins import Crank
from linkanim.scenes.scene import Scene

_PI = Formula("leaf", symbol=Symbol("π"), shown="3.14159265359")
_ONCE = Powers(rate=1)


@dataclass(frozen=True)
class PoseRequest:
    """Which pose of a scene is worked out: `by` its "angle" or "phase", in rad, at its speed."""

    scene: Scene
    by: Literal["angle", "phase"]
    value: float
    speed: float

    def motion(self) -> Any:
        """Return the pose as solving gives it."""
        return self.scene.solve(**{self.by: self.value}, speed=self.speed)  # type: ignore[arg-type]

    @property
    def swings(self) -> bool:
        """Whether the phase is asked for of an input that turns back."""
        return self.by == "phase" and not self.scene.info.full_turn


def place_input(request: PoseRequest, rates: Rates) -> None:
    """Add the lines of the input's place, and put its rates where they stand."""
    work = rates.work
    joint = work.linkage.joint(work.linkage.drive.joint)
    ends = (joint.pivot, joint.name) if isinstance(joint, Crank) else None
    symbol = work.angle_symbol(*ends) if ends else work.names.slide(joint.name)
    found = (_swinging if request.swings else _stated)(request, rates, symbol)
    if ends:
        work.angles[ends] = found
    else:
        work.slides[joint.name] = found


def _stated(request: PoseRequest, rates: Rates, symbol: Symbol) -> Formula:
    """Take the angle as it is asked for, or from the start and the phase."""
    work = rates.work
    rates.start(work.known(rates.symbol(work.driver, 1), request.speed, _ONCE, "the input"))
    if request.by == "angle":
        return work.known(symbol, request.value, ANGLE, "the input")
    phase = work.known(Symbol("φ"), request.value, ANGLE, "phase")
    start = work.stated(Symbol("θ", "0"), request.scene.linkage.drive.start, ANGLE, "start")
    return work.let(symbol, start + phase, ANGLE)


def _swinging(request: PoseRequest, rates: Rates, symbol: Symbol) -> Formula:
    """Add the law of an input that runs there and back: mid - amp cos φ."""
    work = rates.work
    phase = work.known(Symbol("φ"), request.value, ANGLE, "phase")
    pace = work.known(Symbol("φ", mark="˙"), request.speed, _ONCE, "rate of the phase")
    path = request.scene.mechanism.assembly.path
    if isinstance(path, Stroke):
        return _stroke(path, rates, (phase, pace), symbol)
    low, high = path.input_range
    middle = work.known(Symbol("θ", "m"), (low + high) / 2, ANGLE, "middle of the swing")
    amplitude = work.known(Symbol("A"), (high - low) / 2, ANGLE, "half of the swing")
    found = work.let(symbol, middle - amplitude * cos(phase), ANGLE)
    reach = work.let(Symbol("a"), amplitude * _PI / number("180", in_degrees=True), RATIO)
    once, twice = _cosine_rates(reach, phase, pace)
    rates.let_rate(work.driver, once, 1)
    rates.let_rate(work.driver, twice, 2)
    return found


def _cosine_rates(reach: Formula, phase: Formula, pace: Formula) -> tuple[Formula, Formula]:
    """Return the rates of mid - reach·cos φ."""
    return reach * sin(phase) * pace, reach * cos(phase) * square(pace)


def _stroke(path: Stroke, rates: Rates, phase: tuple[Formula, Formula], symbol: Symbol) -> Formula:
    """Add the way of what drives in a straight line, and of a cylinder the crank's angle."""
    work = rates.work
    letter = "ℓ" if isinstance(path, CylinderStroke) else symbol.letter
    index = "" if letter == "ℓ" else symbol.sub
    ends = (path.first * path.unscale, path.last * path.unscale)
    middle = work.stated(Symbol(letter, "m"), sum(ends) / 2, LENGTH, "middle of the stroke")
    reach = work.known(Symbol("a"), (ends[1] - ends[0]) / 2, LENGTH, "half of the stroke")
    way = work.let(Symbol(letter, index), middle - reach * cos(phase[0]), LENGTH)
    formulas = _cosine_rates(reach, *phase)
    once = work.let(Symbol(letter, index, "˙"), formulas[0], Powers(1, 1))
    twice = work.let(Symbol(letter, index, "¨"), formulas[1], Powers(1, 2))
    if isinstance(path, CylinderStroke):
        return _cylinder(path, rates, (way, once, twice), symbol)
    rates.start(once, twice)
    return way


def _cylinder(
    path: CylinderStroke, rates: Rates, way: tuple[Formula, Formula, Formula], symbol: Symbol
) -> Formula:
    """Add the crank's angle and its rates from a cylinder's length."""
    work, between = rates.work, rates.work.linkage.drive.actuator.along
    assert between is not None
    length, once, twice = way
    pivot = work.linkage.crank(work.linkage.drive.joint).pivot
    sides = [side * path.unscale for side in path.sides]
    g, r = (
        work.known(Symbol(name), side, LENGTH, f"{marked(pivot)}–{marked(end)}")
        for name, side, end in zip("gc", sides, between, strict=True)
    )
    base = work.known(
        Symbol("θ", "b"), float(path.base), ANGLE, "the crank's angle with the cylinder's ends in line"
    )
    work.say("The cylinder is one side of a triangle with the crank's pivot:")
    corner = work.let(Symbol("ψ"), arccos((square(g) + square(r) - square(length)) / (TWO * g * r)), ANGLE)
    found = work.let(symbol, base + corner if path.side > 0 else base - corner, ANGLE)
    arm = g * r * sin(corner)
    turning = rates.let_rate(work.driver, (length * once if path.side > 0 else -(length * once)) / arm, 1)
    bend = square(once) + length * twice - g * r * cos(corner) * square(turning)
    rates.let_rate(work.driver, (bend if path.side > 0 else -bend) / arm, 2)
    return found
