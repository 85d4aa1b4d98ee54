"""A scene's motion to fifty digits, by geometry of its own: circles met with circles and lines.

Nothing of the solver is used but which of a dyad's two closures it has at a phase, and where along its way
the input is then: both are what the motion is, not what is worked out from it. Rates are differences.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from chain_reference import places
from mpmath import mp, mpf

from linkanim.mechanics.linkage import RPR, RRP, RRR, Body, Cylinder, Joint, Travel
from linkanim.scenes.scene import Scene

DIGITS = 60
SAMPLES = 180
"""Of a true period, where greatest values are sought."""
NUDGE = mpf(10) ** -30
"""Added to every phase: where two joints meet neither has a direction from the other."""
AFTER, NEARLY_ONE = 1e-7, 1e-9
"""So long after a phase, in radians, closures that are so nearly one, as sines, have come apart."""
STEP = 2.0**-17
"""Of the differences, in radians of the phase: five points of it are off by its fourth power."""
_TOUCHING = mpf(10) ** -3
"""A discriminant that is a smaller share of what it is made of may be none near by."""
_BEYOND = mpf(10) ** -4
"""Of the way from an end to the middle: so far beyond it a dyad is looked at that may be what ends it."""
Place = Any
"""x + yi of many digits."""


@dataclass(frozen=True)
class End:
    """An end of the input's way: its coordinate, and the dyads that do not close beyond it."""

    coordinate: Any
    dyads: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class ExactMotion:
    """What a scene does, worked out anew."""

    scene: Scene

    @cached_property
    def _known(self) -> dict[Any, dict[str, Place]]:
        return {}

    @property
    def speed(self) -> float:
        """Radians of the phase a second."""
        return self.scene.linkage.drive.speed

    @cached_property
    def size(self) -> float:
        """The longest length that is stated."""
        return self.scene.linkage.longest

    def at(self, phase: Any) -> dict[str, Place]:
        """Return where every joint lies at a phase."""
        phase = mpf(phase)
        if phase not in self._known:
            with mp.workdps(DIGITS):
                self._known[phase] = self._placed(phase)
        return self._known[phase]

    def _placed(self, phase: Any) -> dict[str, Place]:
        """Return where every joint lies at a phase.

        Where the ends of a dyad all but meet, its closure tells no side: they part again the other way. Of
        its two places there it has the one that the motion goes through.
        """
        linkage, coordinate, signs = self.scene.linkage, self.coordinate(phase), self.signs(float(phase))
        near = {name: complex(*at) for name, at in self.scene.pose(float(phase), 0).position.items()}
        found = places(linkage, coordinate, signs, near)
        for joint in linkage.joints:
            if (
                isinstance(joint, RRR)
                and abs(found[joint.ends[1]] - found[joint.ends[0]]) < NEARLY_ONE * self.size
            ):
                seen = complex(*self.scene.pose(float(phase), 0).position[joint.name])
                other = places(linkage, coordinate, {**signs, joint.name: -signs[joint.name]}, near)
                if abs(other[joint.name] - seen) < abs(found[joint.name] - seen):
                    signs[joint.name], found = -signs[joint.name], other
        return found

    def rate(self, of: Callable[[dict[str, Place]], Any], phase: float, order: int = 1) -> Any:
        """Return how fast something that is read from a pose changes in time, or its rate by `order` 2."""
        with mp.workdps(DIGITS):
            h = mpf(STEP)
            a, b, c, d, e = (of(self.at(mpf(phase) + k * h)) for k in (-2, -1, 0, 1, 2))
            if order == 1:
                return mpf(self.speed) * (a - 8 * b + 8 * d - e) / (12 * h)
            return mpf(self.speed) ** 2 * (-a + 16 * b - 30 * c + 16 * d - e) / (12 * h * h)

    def velocity(self, joint: str, phase: float) -> complex:
        """Return a joint's velocity, x + yi a second."""
        return complex(self.rate(lambda at: at[joint], phase))

    def acceleration(self, joint: str, phase: float) -> complex:
        """Return a joint's acceleration."""
        return complex(self.rate(lambda at: at[joint], phase, 2))

    def turning(self, ends: tuple[str, str], phase: float) -> float:
        """Return how fast the way from one joint to another turns, rad/s."""
        with mp.workdps(DIGITS):
            here = self.at(phase)
            along = here[ends[1]] - here[ends[0]]
            moving = self.rate(lambda at: at[ends[1]] - at[ends[0]], phase)
            return float(mp.im(mp.conj(along) * moving) / abs(along) ** 2)

    def travel(self, joint: str, at: dict[str, Place]) -> Any:
        """Return how far along its line a joint is, a fixed one or one that a body carries."""
        line = self.scene.linkage.slides[joint].line
        along = mp.expj(mpf(line.angle))
        if line.on is not None:
            axis = at[line.on[1]] - at[line.on[0]]
            along *= axis / abs(axis)
        return mp.re((at[joint] - at[line.through]) / along)

    def body_rate(self, body: Body, phase: float, order: int = 1) -> float:
        """Return the angular velocity of a body, or how fast it travels; or how fast that changes."""
        if body.slider is not None:
            slider = body.slider
            return float(self.rate(lambda at: self.travel(slider, at), phase, order))
        first, second = body.joints[:2]
        if order == 1:
            return self.turning((first, second), phase)
        with mp.workdps(DIGITS):
            here = self.at(phase)
            middle = here[second] - here[first]
            # its angle from where it is at the phase, so that no turn is lost
            return float(self.rate(lambda at: mp.arg((at[second] - at[first]) / middle), phase, 2))

    def quickest(self, body: Body) -> float:
        """Return the greatest size of a body's rate in a true period, as well as samples tell it."""
        if body.name not in self._quickest:
            step = self.scene.period / SAMPLES
            rates = (self.body_rate(body, n * step) for n in range(SAMPLES))
            self._quickest[body.name] = max(map(abs, rates))
        return self._quickest[body.name]

    @cached_property
    def _quickest(self) -> dict[str, float]:
        return {}

    @property
    def turns_fully(self) -> bool:
        """Whether the input goes on and on: what the solver takes it for, which `ends` holds against."""
        return self.scene.info.full_turn

    def coordinate(self, phase: Any) -> Any:
        """Return the crank's angle at a phase, or how far the slider that drives has travelled."""
        drive = self.scene.linkage.drive
        with mp.workdps(DIGITS):
            phase = mpf(phase) + NUDGE
            if self.turns_fully:
                return mpf(drive.start) + phase
            low, high = (end.coordinate for end in self._stroke)
            along = (low + high) / 2 - (high - low) / 2 * mp.cos(phase)
            if not isinstance(drive.actuator, Cylinder):
                return along
            return self._turned(along, self.scene.pose(float(phase), 0).coordinate)

    def _turned(self, length: Any, near: float) -> Any:
        """Return the crank's angle, near another, at which a cylinder is so long."""
        drive = self.scene.linkage.drive
        assert isinstance(drive.actuator, Cylinder)
        fixed, moving = drive.actuator.between
        still = places(self.scene.linkage, mpf(0), self.signs(0.0))
        pivot = still[self.scene.linkage.crank(drive.joint).pivot]
        arm, ground = still[moving] - pivot, still[fixed] - pivot
        r, g = abs(arm), abs(ground)
        cosine = (r * r + g * g - length * length) / (2 * r * g)
        away = mp.acos(min(max(cosine, mpf(-1)), mpf(1)))
        zero = mp.arg(ground) - mp.arg(arm)
        turns = [zero + sign * away for sign in (1, -1)]
        turns = [turn + 2 * mp.pi * mp.nint((mpf(near) - turn) / (2 * mp.pi)) for turn in turns]
        return min(turns, key=lambda turn: abs(turn - near))

    @cached_property
    def ends(self) -> tuple[End, End]:
        """The two ends of an input that turns back: angles, or a slider's travel, the lower one first.

        A dyad is named where its bars no longer meet a little beyond the end.
        """
        with mp.workdps(DIGITS):
            stroke = self._stroke
            if isinstance(self.scene.linkage.drive.actuator, Cylinder):
                first, last = (
                    End(self.coordinate(mpf(phase)), end.dyads)
                    for phase, end in zip((0.0, float(mp.pi)), stroke, strict=True)
                )
                return (first, last) if first.coordinate < last.coordinate else (last, first)
            first, last = stroke
            return (first, last) if first.coordinate < last.coordinate else (last, first)

    @cached_property
    def _stroke(self) -> tuple[End, End]:
        """The ends of what runs to and fro, at phase 0 and at π: of an angle, or of a length."""
        actuator = self.scene.linkage.drive.actuator
        ends = self._limit(0.0), self._limit(float(mp.pi))
        if isinstance(actuator, Cylinder | Travel):
            stated = mpf(actuator.first), mpf(actuator.last)
            return End(stated[0], ends[0].dyads), End(stated[1], ends[1].dyads)
        return ends

    def _limit(self, phase: float) -> End:
        """Return where dyads cease to close at an end of the way, or where the input is at its phase."""
        with mp.workdps(DIGITS):
            here, inside = (mpf(self.scene.pose(place, 0).coordinate) for place in (phase, mp.pi / 2))
            beyond, signs = (here - inside) * _BEYOND, self.signs(phase)
            shares = self.discriminants(here, signs)
            near = [name for name, share in shares.items() if abs(share) < _TOUCHING]
            roots = {name: self._root(name, here, signs) for name in near}
            roots = {name: root for name, root in roots.items() if abs(root - here) < abs(beyond)}
            closed = [name for name in roots if self.discriminants(roots[name] + beyond, signs)[name] < 0]
            if not closed:
                return End(here, ())
            inmost = min((roots[name] for name in closed), key=lambda root: beyond * root)
            return End(inmost, tuple(sorted(name for name in closed if abs(roots[name] - inmost) < 1e-9)))

    def _root(self, name: str, near: Any, signs: dict[str, int]) -> Any:
        """Return where a dyad's discriminant is zero, by the secant's rule."""
        one, other = near, near + mpf(10) ** -9
        values = [self.discriminants(angle, signs)[name] for angle in (one, other)]
        for _ in range(40):
            if values[0] == values[1] or abs(one - other) < mpf(10) ** (5 - DIGITS):
                break
            one, other = other, other - values[1] * (other - one) / (values[1] - values[0])
            values = [values[1], self.discriminants(other, signs)[name]]
        return other

    def discriminants(self, coordinate: Any, signs: dict[str, int]) -> dict[str, Any]:
        """Return for each dyad what its root is taken of, as a share of the lengths in it; negative: open."""
        if not any(joint.dyad for joint in self.scene.linkage.joints):
            return {}
        at = places(self.scene.linkage, coordinate, signs)
        found = {joint.name: self._discriminant(joint, at) for joint in self.scene.linkage.joints}
        return {name: share for name, share in found.items() if share is not None}

    @staticmethod
    def _discriminant(joint: Joint, at: dict[str, Place]) -> Any:
        match joint:
            case RRR():
                (p, q), (a, b) = (at[end] for end in joint.ends), map(mpf, joint.lengths)
                way = abs(q - p) ** 2
                return ((a + b) ** 2 - way) * (way - (a - b) ** 2) / (a + b) ** 4
            case RRP():
                base, along = at[joint.line.through], mp.expj(mpf(joint.line.angle))
                if joint.line.on is not None:
                    axis = at[joint.line.on[1]] - at[joint.line.on[0]]
                    along = along * axis / abs(axis)
                rise = mp.im((at[joint.end] - base) / along) - mpf(joint.line.offset)
                return (mpf(joint.length) ** 2 - rise**2) / mpf(joint.length) ** 2
            case RPR() if joint.offset:
                way = abs(at[joint.through] - at[joint.pivot])
                return (way**2 - mpf(joint.offset) ** 2) / mpf(joint.offset) ** 2
        return None

    def signs(self, phase: float) -> dict[str, int]:
        """Return which of its two closures each dyad has at a phase, or just after one where both are one."""
        here, after = (self.scene.pose(phase + part, 0).position for part in (0.0, AFTER))
        places = [{name: complex(*place) for name, place in found.items()} for found in (here, after)]
        found = {}
        for joint in self.scene.linkage.joints:
            if isinstance(joint, RRR | RRP | RPR):
                ahead, later = (_ahead(joint, at) for at in places)
                found[joint.name] = 1 if (later if abs(ahead) < NEARLY_ONE else ahead) >= 0 else -1
        return found


def _ahead(joint: Joint, at: dict[str, complex]) -> float:
    """Return the sine, or the cosine, whose sign tells the closure of a dyad."""
    match joint:
        case RRR():
            p, q = (at[end] for end in joint.ends)
            turn = (q - p).conjugate() * (at[joint.name] - p)
            return turn.imag / (joint.lengths[0] * max(joint.lengths))
        case RRP():
            along = complex(mp.expj(joint.line.angle))
            if joint.line.on is not None:
                axis = at[joint.line.on[1]] - at[joint.line.on[0]]
                along *= axis / abs(axis)
            return (along.conjugate() * (at[joint.name] - at[joint.end])).real / joint.length
        case RPR():
            bar = (at[joint.name] - at[joint.pivot]) / joint.length
            arm = at[joint.through] - at[joint.pivot]
            return (bar.conjugate() * arm).real / max(abs(arm), abs(joint.offset), 1e-300)
    raise AssertionError(joint)
