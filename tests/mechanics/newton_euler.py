"""Every force in a linkage in fifty digits: Newton's and Euler's equations of all bodies, solved at once.

Nothing is shared with the module that is tested: places are those of circles and lines met in many digits,
rates are differences, and all unknowns are found from one dense system.

`python tests/mechanics/newton_euler.py [COUNT]` prints the worst deviation of each kind of joint.
"""

from __future__ import annotations

import random
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
from mpmath import mp, mpf
from random_joints import DOWN_THE_CHAIN, DRIVEN, PHASES, Make, _Exact, _with, solved_linkages
from reference import DIGITS, derivatives

from linkanim.mechanics.linkage import (
    RPP,
    RPR,
    Body,
    Crank,
    Damper,
    DrivenSlider,
    Gear,
    Joint,
    Linkage,
    Load,
    Spring,
)
from linkanim.mechanics.motion import mechanism
from linkanim.mechanics.reactions import Reactions, reactions

SPEED, ACCELERATION = 3.0, -2.0
Found = dict[tuple[str, ...], Any]
"""Numbers by what they are: ("joint", "B", "rod", "x"), ("guide", "slider", "force"), ("effort",)."""


def laden(linkage: Linkage, seed: int) -> Linkage:
    """Return a linkage with masses on every body, springs, dampers, loads and gravity."""
    rng = random.Random(seed)
    names = [joint.name for joint in linkage.joints]
    bodies = [
        Body(
            f"b{n}",
            tuple(frame)[:2],
            (rng.uniform(-30, 60), rng.uniform(-30, 30)),
            None,
            rng.uniform(0.1, 3),
            rng.uniform(1e-4, 1e-2),
        )
        for n, frame in enumerate(linkage.rigid_bodies)
        if n
    ]
    blocks = [
        Body(f"block {one.name}", slider=one.name, mass=rng.uniform(0.1, 3))
        for one in linkage.joints
        if one.travels
    ]
    pairs = [tuple(rng.sample(names, 2)) for _ in range(3)]
    ends = [(one, other) for one, other in pairs if not {one, other} <= linkage.rigid_bodies[0].keys()]
    springs = tuple(
        Spring(f"s{n}", pair, rng.uniform(50, 900), rng.uniform(0, 90)) for n, pair in enumerate(ends[:2])
    )
    dampers = tuple(Damper(f"d{n}", pair, rng.uniform(1, 60)) for n, pair in enumerate(ends[2:]))
    loads = [
        Load(
            f"l{n}",
            body.name,
            joint=rng.choice([*body.joints, ""]) if body.joints else "",
            at=(rng.uniform(-50, 50), rng.uniform(-50, 50)),
            force=(rng.uniform(-90, 90), rng.uniform(-90, 90)),
            torque=rng.uniform(-2, 2),
            turns=rng.random() < 0.5,
        )
        for n, body in enumerate((*bodies, *blocks))
    ]
    return replace(
        linkage,
        bodies=(*bodies, *blocks),
        springs=springs,
        dampers=dampers,
        loads=tuple(replace(load, at=None) if load.joint else load for load in loads),
        metre=1e-3,
        gravity=9.81,
    )


class _System:
    """Linear equations by name, in unknowns by name."""

    def __init__(self) -> None:
        self.terms: dict[tuple[str, ...], dict[tuple[str, ...], Any]] = {}
        self.known: dict[tuple[str, ...], Any] = {}

    def add(self, equation: tuple[str, ...], unknown: tuple[str, ...], factor: Any) -> None:
        row = self.terms.setdefault(equation, {})
        row[unknown] = row.get(unknown, mpf(0)) + factor

    def put(self, equation: tuple[str, ...], value: Any) -> None:
        """Add what is known to an equation's left side."""
        self.terms.setdefault(equation, {})
        self.known[equation] = self.known.get(equation, mpf(0)) + value

    def solved(self) -> Found:
        unknowns = list(dict.fromkeys(name for row in self.terms.values() for name in row))
        assert len(unknowns) == len(self.terms)
        matrix, right = mp.zeros(len(unknowns)), mp.zeros(len(unknowns), 1)
        for n, (equation, row) in enumerate(self.terms.items()):
            for name, factor in row.items():
                matrix[n, unknowns.index(name)] = factor
            right[n] = -self.known.get(equation, mpf(0))
        return dict(zip(unknowns, mp.lu_solve(matrix, right), strict=True))


class NewtonEuler:
    """The equations of one linkage at one phase, lengths in metres."""

    def __init__(self, linkage: Linkage, pose: Callable[[Any], dict[str, Any]], phase: float) -> None:
        self.linkage, metre = linkage, mpf(linkage.metre)
        found = derivatives(pose, mpf(phase))
        first, second = mpf(SPEED), mpf(ACCELERATION)
        self.at = {name: place * metre for name, place in found[0].items()}
        self.rate = {name: rate * first * metre for name, rate in found[1].items()}
        self.second = {
            name: (bend * first**2 + found[1][name] * second) * metre for name, bend in found[2].items()
        }
        self.frames = [list(frame) for frame in linkage.rigid_bodies]
        self.names = {n: f"b{n}" for n in range(1, len(self.frames))} | {0: "ground"}

    def body_of(self, names: tuple[str, ...]) -> str:
        return self.names[next(n for n, frame in enumerate(self.frames) if set(names) <= set(frame))]

    def line(self, joint: Any) -> Any:
        angle = mp.expj(mpf(joint.line.angle))
        if joint.line.on is None:
            return angle
        axis = self.at[joint.line.on[1]] - self.at[joint.line.on[0]]
        return angle * axis / abs(axis)

    def solved(self) -> Found:
        """All forces; the teeth press apart whichever flank bears."""
        found = self._solved({})
        signs = {name[1]: mp.sign(force) for name, force in found.items() if name[0] == "tooth"}
        return self._solved(signs) if signs else found

    def _solved(self, signs: dict[str, Any]) -> Found:
        system = _System()
        self._pins(system)
        for joint in self.linkage.joints:
            self._constraint(joint, system, signs)
        self._loads(system)
        self._inertia(system)
        for axis in ("x", "y", "moment"):
            system.add(("ground", axis), ("ground", axis), mpf(-1))
        return system.solved()

    def _force(self, system: _System, body: str, place: Any, unknown: tuple[str, ...], along: Any) -> None:
        """Let an unknown force act on a body along a direction."""
        system.add((body, "x"), unknown, mp.re(along))
        system.add((body, "y"), unknown, mp.im(along))
        system.add((body, "moment"), unknown, mp.im(mp.conj(place) * along))

    def _given(self, system: _System, body: str, place: Any, force: Any) -> None:
        system.put((body, "x"), mp.re(force))
        system.put((body, "y"), mp.im(force))
        system.put((body, "moment"), mp.im(mp.conj(place) * force))

    def _pin(self, system: _System, joint: str, unknown: tuple[str, ...], along: Any) -> None:
        """Let the pin push back at an unknown force on a body."""
        system.add(("pin", joint, "x"), unknown, -mp.re(along))
        system.add(("pin", joint, "y"), unknown, -mp.im(along))

    def _pins(self, system: _System) -> None:
        for name in self.linkage.by_name:
            bodies = [self.names[n] for n, frame in enumerate(self.frames) if name in frame]
            bodies += [f"block {name}"] if self.linkage.joint(name).travels else []
            for body in bodies:
                for axis, along in (("x", mpf(1)), ("y", mp.mpc(0, 1))):
                    unknown = ("joint", name, body, axis)
                    self._force(system, body, self.at[name], unknown, along)
                    self._pin(system, name, unknown, along)

    def _constraint(self, joint: Joint, system: _System, signs: dict[str, Any]) -> None:
        name, i = joint.name, mp.mpc(0, 1)
        if joint.travels:
            line = self.line(joint)
            carrier = self.body_of(joint.line.body) if joint.line.on else "ground"  # type: ignore[attr-defined]
            for body, sign in ((f"block {name}", 1), (carrier, -1)):
                self._force(system, body, self.at[name], ("guide", name, "force"), sign * i * line)
                system.add((body, "moment"), ("guide", name, "moment"), mpf(sign))
        if isinstance(joint, RPR):
            along = (self.at[name] - self.at[joint.pivot]) / mpf(joint.length) / mpf(self.linkage.metre)
            body = next(self.names[n] for n, one in enumerate(self.frames) if {joint.pivot, name} <= set(one))
            self._slot(system, joint.through, body, i * along)
        if isinstance(joint, RPP):
            self._slot(system, joint.pin, f"block {name}", i * self.line(joint) * mp.expj(mpf(joint.slot)))
        if name == self.linkage.drive.joint:
            self._input(joint, system)
        elif isinstance(joint, Crank):
            self._gear(joint, system, signs)

    def _slot(self, system: _System, pin: str, body: str, normal: Any) -> None:
        unknown = ("slot", pin, body)
        self._force(system, body, self.at[pin], unknown, normal)
        self._pin(system, pin, unknown, normal)

    def _input(self, joint: Joint, system: _System) -> None:
        actuator = self.linkage.drive.actuator
        if isinstance(joint, DrivenSlider):
            for body, sign in ((f"block {joint.name}", 1), ("ground", -1)):
                self._force(system, body, self.at[joint.name], ("effort",), sign * self.line(joint))
            return
        assert isinstance(joint, Crank)
        if actuator.along is not None:
            fixed, moving = actuator.along
            along = (self.at[moving] - self.at[fixed]) / abs(self.at[moving] - self.at[fixed])
            self._pin(system, moving, ("effort",), -along)
            self._pin(system, fixed, ("effort",), along)
            return
        system.add((self.body_of((joint.pivot, joint.name)), "moment"), ("effort",), mpf(1))
        system.add(("ground", "moment"), ("effort",), mpf(-1))

    def _gear(self, joint: Crank, system: _System, signs: dict[str, Any]) -> None:
        gear = joint.gear
        assert gear is not None
        mate, ratio = self.linkage.crank(gear.mate), mpf(gear.ratio.numerator) / gear.ratio.denominator
        own, other = self.body_of((joint.pivot, joint.name)), self.body_of((mate.pivot, mate.name))
        centre, far = self.at[joint.pivot], self.at[mate.pivot]
        planet = joint.pivot == mate.name and (ratio < 0 or ratio > 1)
        pair = self.linkage.joint(joint.pivot).fixed and joint.pivot != mate.pivot and ratio < 0
        if not (planet or pair):
            unknown = ("torque", joint.name)
            for body, share in ((own, mpf(1)), (other, -ratio), ("ground", ratio - 1)):
                system.add((body, "moment"), unknown, share)
            return
        # the wheels touch where both move alike: the crank's wheel against its mate's, or against the ground
        speed = mpf(0) if planet else mpf(1)
        drift = (ratio * centre - speed * far) if not planet else centre - (centre - far) / ratio
        touch = drift if planet else drift / (ratio - speed)
        out = (centre - touch) / abs(centre - touch)
        tangent = mp.mpc(0, -1) * out
        press = tangent + signs.get(joint.name, 0) * out * mp.tan(mpf(gear.pressure_angle))
        self._force(system, own, touch, ("tooth", joint.name), press)
        self._force(system, "ground" if planet else other, touch, ("tooth", joint.name), -press)

    def _loads(self, system: _System) -> None:
        metre = mpf(self.linkage.metre)
        struts: tuple[Spring | Damper, ...] = (*self.linkage.springs, *self.linkage.dampers)
        for strut in struts:
            first, last = strut.between
            apart = self.at[last] - self.at[first]
            along = apart / abs(apart)
            if isinstance(strut, Spring):
                assert strut.stiffness is not None
                assert strut.free_length is not None
                force = mpf(strut.stiffness) * (abs(apart) - mpf(strut.free_length) * metre)
            else:
                assert strut.coefficient is not None
                force = mpf(strut.coefficient) * mp.re(mp.conj(along) * (self.rate[last] - self.rate[first]))
            for end, pull in ((first, force * along), (last, -force * along)):
                system.put(("pin", end, "x"), mp.re(pull))
                system.put(("pin", end, "y"), mp.im(pull))
        for load in self.linkage.loads:
            body = self.linkage.body(load.on)
            along = self._direction(body)
            base = self.at[body.slider or body.joints[0]]
            place = self.at[load.joint] if load.joint else base
            place = base + mp.mpc(*map(mpf, load.at)) * along * metre if load.at else place
            force = mp.mpc(*map(mpf, load.force)) * (along if load.turns else 1)
            self._given(system, load.on, place, force)
            system.put((load.on, "moment"), mpf(load.torque))

    def _direction(self, body: Body) -> Any:
        if body.slider is not None:
            return self.line(self.linkage.joint(body.slider))
        apart = self.at[body.joints[1]] - self.at[body.joints[0]]
        return apart / abs(apart)

    def _inertia(self, system: _System) -> None:
        if self.linkage.static:
            return self._weight(system, lambda body: mpf(0))
        return self._weight(system, self._acceleration)

    def _acceleration(self, body: Body) -> Any:
        if body.slider is not None:
            return self.second[body.slider]
        return self.second[body.joints[0]] + self._bent(body) * self._arm(body)

    def _arm(self, body: Body) -> Any:
        assert body.com is not None
        return mp.mpc(*map(mpf, body.com)) * mpf(self.linkage.metre) * self._direction(body)

    def _bent(self, body: Body) -> Any:
        """iα - ω² of a body."""
        first, second = body.joints[:2]
        return (self.second[second] - self.second[first]) / (self.at[second] - self.at[first])

    def _weight(self, system: _System, acceleration: Callable[[Body], Any]) -> None:
        for body in self.linkage.bodies:
            assert body.mass is not None
            place = self.at[body.slider] if body.slider else self.at[body.joints[0]] + self._arm(body)
            pull = mp.mpc(0, -mpf(self.linkage.gravity)) - acceleration(body)
            self._given(system, body.name, place, mpf(body.mass) * pull)
            if body.inertia is not None and not self.linkage.static:
                system.put((body.name, "moment"), -mpf(body.inertia) * mp.im(self._bent(body)))


def told(linkage: Linkage, found: Reactions) -> Found:
    """Return reactions under the names of the equations' unknowns."""
    numbers: Found = {("effort",): found.effort, ("ground", "moment"): found.moment}
    numbers |= {("ground", axis): part for axis, part in zip("xy", found.ground, strict=True)}
    for joint, bodies in found.joints.items():
        for body, force in bodies.items():
            numbers |= {("joint", joint, body, axis): part for axis, part in zip("xy", force, strict=True)}
    for body, guide in found.guides.items():
        name = body.removeprefix("block ")
        numbers |= {("guide", name, "force"): guide.force, ("guide", name, "moment"): guide.moment}
    return numbers


def worst(
    linkage: Linkage,
    seed: int,
    phases: tuple[float, ...] = PHASES,
    *,
    static: bool = False,
    beside: bool = False,
) -> float:
    """Return how far any force is from many digits, in the greatest at its phase.

    `beside` asks for phases from where J comes to its limit.
    """
    linkage = replace(laden(linkage, seed), static=static)
    solved = mechanism(linkage)
    exact = _Exact(linkage, solved)
    phases = tuple(end + way for end in exact.flips for way in phases) if beside else phases
    motion = solved.solve(phase=np.array(phases), speed=SPEED, acceleration=ACCELERATION)
    found = told(linkage, reactions(motion))
    return max(
        (_deviation(linkage, exact.places, (n, at), found) for n, at in enumerate(phases)), default=0.0
    )


def _deviation(
    linkage: Linkage, pose: Callable[[Any], dict[str, Any]], at: tuple[int, float], found: Found
) -> float:
    true = NewtonEuler(linkage, pose, at[1]).solved()
    largest = max(abs(force) for name, force in true.items() if name[0] == "joint")
    off = [abs(mpf(float(found[name][at[0]])) - force) for name, force in true.items() if name in found]
    assert len(off) > 4
    return float(max(off) / largest)


def gear_pair(rng: random.Random) -> Linkage:
    """A crank on a fixed pin, geared to the input: by teeth, by a belt, or about the same pin."""
    ratio = Fraction(rng.choice([-3, -2, -1, 2, 3, 5]), rng.choice([1, 1, 2, 3]))
    return _with(rng, Crank("J", rng.choice(["S", "O4", "O2"]), rng.uniform(5, 40), Gear("A", ratio, 0.3)))


EVERY: tuple[Make, ...] = (*DOWN_THE_CHAIN, *DRIVEN, gear_pair)


def linkages(make: Make, count: int, seed: int = 7) -> Iterator[Linkage]:
    """Yield random linkages with a joint of one kind."""
    found = solved_linkages(make, seed)
    for _ in range(count):
        yield next(found)[0]


if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 40
    with mp.workdps(DIGITS):
        for make in EVERY:
            errors = [worst(one, n, static=n % 4 == 0) for n, one in enumerate(linkages(make, count))]
            print(
                f"{make.__name__:28} {count} {max(errors):9.2e} {sorted(errors)[count // 2]:9.2e}", flush=True
            )
