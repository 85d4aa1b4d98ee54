"""Where the input is and how it moves: as it was asked for, or from the phase."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from linkanim.explain.expression import TWO, ZERO, Formula, Symbol, arccos, cos, number, sin, square
from linkanim.explain.rates import Rates
from linkanim.explain.work import ANGLE, LENGTH, RATIO, Powers, Work
from linkanim.mechanics.drive.strokes import CylinderStroke, Stroke
from linkanim.mechanics.linkage.pins import Crank
from linkanim.scenes.scene import Scene

_PI = Formula("leaf", symbol=Symbol("π"), shown="3.14159265359")
_ONCE, _TWICE = Powers(rate=1), Powers(rate=2)


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


@dataclass(frozen=True)
class Driven:
    """The input's rates of the first and of the second order."""

    rate: Formula
    second: Formula


def place_input(request: PoseRequest, work: Work) -> Driven:
    """Add the lines of the input's place, and return its rates."""
    joint = work.linkage.joint(work.linkage.drive.joint)
    ends = (joint.pivot, joint.name) if isinstance(joint, Crank) else None
    symbol = work.angle_symbol(*ends) if ends else work.names.slide(joint.name)
    if request.swings:
        found, driven = _swinging(request, work, symbol)
    else:
        found, driven = _stated(request, work, symbol)
    if ends:
        work.angles[ends] = found
    else:
        work.slides[joint.name] = found
    return driven


def _rate_symbols(work: Work) -> tuple[Symbol, Symbol]:
    joint = work.linkage.joint(work.linkage.drive.joint)
    if not isinstance(joint, Crank):
        index = work.names.slide(joint.name).sub
        return Symbol("s", index, "˙"), Symbol("s", index, "¨")
    index = work.names.turning(work.frame((joint.pivot, joint.name)))
    return Symbol("ω", index), Symbol("α", index)


def _stated(request: PoseRequest, work: Work, symbol: Symbol) -> tuple[Formula, Driven]:
    """Take the angle as it is asked for, or from the start and the phase."""
    driven = Driven(work.known(_rate_symbols(work)[0], request.speed, _ONCE, "the input"), ZERO)
    if request.by == "angle":
        return work.known(symbol, request.value, ANGLE, "the input"), driven
    phase = work.known(Symbol("φ"), request.value, ANGLE, "phase")
    start = work.stated(Symbol("θ", "0"), request.scene.linkage.drive.start, ANGLE, "start")
    return work.let(symbol, start + phase, ANGLE), driven


def _swinging(request: PoseRequest, work: Work, symbol: Symbol) -> tuple[Formula, Driven]:
    """Add the law of an input that runs there and back: mid - amp cos φ."""
    phase = work.known(Symbol("φ"), request.value, ANGLE, "phase")
    pace = work.known(Symbol("φ", mark="˙"), request.speed, _ONCE, "rate of the phase")
    path = request.scene.mechanism.assembly.path
    if isinstance(path, Stroke):
        return _stroke(path, work, (phase, pace), symbol)
    low, high = path.input_range
    middle = work.known(Symbol("θ", "m"), (low + high) / 2, ANGLE, "middle of the swing")
    amplitude = work.known(Symbol("A"), (high - low) / 2, ANGLE, "half of the swing")
    found = work.let(symbol, middle - amplitude * cos(phase), ANGLE)
    reach = work.let(Symbol("a"), amplitude * _PI / number("180"), RATIO)
    once, twice = _cosine_rates(reach, phase, pace)
    rate, second = _rate_symbols(work)
    return found, Driven(work.let(rate, once, _ONCE), work.let(second, twice, _TWICE))


def _cosine_rates(reach: Formula, phase: Formula, pace: Formula) -> tuple[Formula, Formula]:
    """Return the rates of mid - reach·cos φ."""
    return reach * sin(phase) * pace, reach * cos(phase) * square(pace)


def _stroke(
    path: Stroke, work: Work, phase: tuple[Formula, Formula], symbol: Symbol
) -> tuple[Formula, Driven]:
    """Add the way of what drives in a straight line, and of a cylinder the crank's angle."""
    letter = "ℓ" if isinstance(path, CylinderStroke) else symbol.letter
    index = "" if letter == "ℓ" else symbol.sub
    ends = (path.first * path.unscale, path.last * path.unscale)
    middle = work.stated(Symbol(letter, "m"), sum(ends) / 2, LENGTH, "middle of the stroke")
    reach = work.known(Symbol("a"), (ends[1] - ends[0]) / 2, LENGTH, "half of the stroke")
    way = work.let(Symbol(letter, index), middle - reach * cos(phase[0]), LENGTH)
    formulas = _cosine_rates(reach, *phase)
    once = work.let(Symbol(letter, index, "˙"), formulas[0], Powers(1, 1))
    twice = work.let(Symbol(letter, index, "¨"), formulas[1], Powers(1, 2))
    if not isinstance(path, CylinderStroke):
        return way, Driven(once, twice)
    return _cylinder(path, work, (way, once, twice), symbol)


def _cylinder(
    path: CylinderStroke, work: Work, way: tuple[Formula, Formula, Formula], symbol: Symbol
) -> tuple[Formula, Driven]:
    """Add the crank's angle and its rates from a cylinder's length."""
    between = work.linkage.drive.actuator.along
    assert between is not None
    length, once, twice = way
    pivot = work.linkage.crank(work.linkage.drive.joint).pivot
    sides = [side * path.unscale for side in path.sides]
    g, r = (
        work.known(Symbol(name), side, LENGTH, f"{{{pivot}}}–{{{end}}}")
        for name, side, end in zip("gc", sides, between, strict=True)
    )
    base = work.known(
        Symbol("θ", "b"), float(path.base), ANGLE, "the crank's angle with the cylinder's ends in line"
    )
    work.say("The cylinder is one side of a triangle with the crank's pivot:")
    corner = work.let(Symbol("ψ"), arccos((square(g) + square(r) - square(length)) / (TWO * g * r)), ANGLE)
    found = work.let(symbol, base + corner if path.side > 0 else base - corner, ANGLE)
    rate, second = _rate_symbols(work)
    arm = g * r * sin(corner)
    turning = work.let(rate, (length * once if path.side > 0 else -(length * once)) / arm, _ONCE)
    bend = square(once) + length * twice - g * r * cos(corner) * square(turning)
    return found, Driven(turning, work.let(second, (bend if path.side > 0 else -bend) / arm, _TWICE))


def start_rates(rates: Rates, driven: Driven) -> None:
    """Put the input's rates where those of its body, or of its slider, stand."""
    work = rates.work
    joint = work.linkage.joint(work.linkage.drive.joint)
    if isinstance(joint, Crank):
        rates.turning[work.frame((joint.pivot, joint.name))] = [driven.rate, driven.second]
    else:
        rates.sliding[joint.name] = [driven.rate, driven.second]
