"""A linkage put together, as data, and one walk over it: what is known of its joints so far.

Joints come in their order, each closed from those before it. What turns as one piece is kept beside its
frame: a bar, the arms along which its joints are carried, and how fast it turns.

Seen from a line of travel, fixed or carried by a body, a point lies f forward of the line's base and e to its
left. Where the line turns at Ω with its body, u along it and w from its base to the point,

    f = u·w      f' = Ω (u×w) + u·w'
    e = u×w      e' = -Ω (u·w) + u×w'

and what travels at s along the line has the guide's motion, s' along it, and Coriolis' 2Ω s' across it
(Uicker, Pennock and Shigley, Theory of Machines and Mechanisms, on points moving in moving frames).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from linkanim.errors import AssemblyError
from linkanim.mechanics.closing.chain import ChainRoot, Closing
from linkanim.mechanics.closing.search import samples_a_turn
from linkanim.mechanics.drive.input_path import InputPath
from linkanim.mechanics.formulas.circular import Half
from linkanim.mechanics.formulas.constant import Constant
from linkanim.mechanics.formulas.expression import Expr, Value, sqrt
from linkanim.mechanics.formulas.planar import Moving, MovingPoint, Slope, Vec, carried
from linkanim.mechanics.formulas.precise import direction
from linkanim.mechanics.linkage.joint import Line, Point
from linkanim.mechanics.linkage.linkage import Linkage
from linkanim.mechanics.linkage.pins import Pin
from linkanim.mechanics.linkage.rigid_bodies import holding
from linkanim.mechanics.loops.input_state import InputState
from linkanim.mechanics.loops.loop import Gearing, Loop, gearings, place
from linkanim.mechanics.loops.signed import SignedRoot, plain_root
from linkanim.mechanics.loops.triangle import PinLoop, moving_factors, moving_square


@dataclass(frozen=True)
class Assembly:
    """A linkage's loops, the path of its input and the sign of every closure.

    `linkage` has its lengths scaled by a power of two where products of four of them could leave
    the range of a float; `unscale` brings results back.
    """

    linkage: Linkage
    loops: Mapping[str, Loop]
    path: InputPath
    signs: Mapping[str, int]
    unscale: float = 1.0
    chain: Mapping[str, ChainRoot] = field(default_factory=dict)
    """The roots of dyads on moving points that vanish on the way."""

    @property
    def change_points(self) -> Iterator[float]:
        """The input's places at which a root changes its sign, of loops and of dyads down the chain."""
        for loop in self.loops.values():
            yield from (place for place, turns in loop.change_points if self.path.holds(place, turns))
        for root in self.chain.values():
            yield from map(self.path.coordinate_at, root.change_points)

    @cached_property
    def gears(self) -> Mapping[str, Gearing]:
        """How each crank turns with the input."""
        return gearings(self.linkage)

    @property
    def quickest(self) -> float:
        """How many times as fast as the input the quickest crank turns, at least once."""
        return max([1.0, *(abs(float(gearing.ratio)) for gearing in self.gears.values())])

    @property
    def samples(self) -> int:
        """At how many phases of a drive period it is looked at: as near as what turns fastest needs."""
        return samples_a_turn(self.quickest)


AT_ITS_LIMIT = (
    "it is at its limit at every angle of the input, or at many in a row, where rounding alone would"
    " move it; make one length longer or shorter"
)


@dataclass(frozen=True, slots=True)
class Piece:
    """How one rigid body turns, and the arms between its joints that are known as they were closed."""

    turning: Slope = field(default_factory=lambda: Slope(0.0))
    arms: dict[tuple[str, str], Vec] = field(default_factory=dict)


@dataclass
class Walk:
    """What has been found so far; joints add themselves to it in their order.

    `pieces` stand in the order of the linkage's rigid bodies.
    """

    assembly: Assembly
    state: InputState
    points: dict[str, MovingPoint] = field(default_factory=dict)
    pieces: list[Piece] = field(default_factory=lambda: [Piece()])
    travels: dict[str, Moving] = field(default_factory=dict)
    closings: dict[str, Closing] = field(default_factory=dict)
    """What closes each dyad on moving points: L², or how far its end lies from its line, U and W."""

    @property
    def bodies(self) -> dict[str, Slope]:
        """How each named body turns."""
        turning = (body for body in self.linkage.bodies if body.slider is None)
        return {body.name: self.turning_of(body.joints, f"body {body.name}") for body in turning}

    @property
    def centres(self) -> dict[str, MovingPoint]:
        """The centre of mass of each body that states one."""
        bodies = self.linkage.bodies
        return {
            body.name: self.attached((body.joints[0], body.joints[1]), body.com)
            for body in bodies
            if body.com is not None
        }

    @property
    def exact(self) -> bool:
        """Whether what is noted will be run in many digits."""
        return isinstance(self.state.angle, Expr) and self.state.angle.graph.exact

    @property
    def linkage(self) -> Linkage:
        """What is walked over."""
        return self.assembly.linkage

    def pace(self, gearing: Gearing) -> Slope:
        """Return how fast a geared crank turns, with its derivative."""
        ratio = float(gearing.ratio)
        return Slope(self.state.rate * ratio, self.state.second * ratio)

    def add_piece(self, turning: Slope, ends: tuple[str, str], arm: Vec) -> None:
        """Add the bar between two joints, the vector from the first to the second known as `arm`."""
        self.pieces.append(Piece(turning, {ends: arm}))

    def loop_root(self, loop: Loop, sign: int) -> tuple[SignedRoot, Half, Slope]:
        """Return the root of a loop on a crank pin, ψ/2, and ψ' with its derivative."""
        pace = self.pace(loop.gearing)
        root, half = loop.closed(self.state, pace)
        return root.times(sign), half, pace

    def pin_loop(self, loop: Loop, sign: int) -> tuple[SignedRoot, PinLoop]:
        """Return the root of a loop between a crank pin and a fixed pin, and where the two are."""
        assert loop.ground is not None
        root, half, pace = self.loop_root(loop, sign)
        ground, units = loop.ground, (loop.root.spread, loop.root.unit)
        return root, PinLoop(ground.exact, ground.direction, loop.crank.length, half, pace, *units)

    def span_root(self, name: str, across: MovingPoint, lengths: tuple[float, float]) -> SignedRoot:
        """Return the root of two bars on points that both move, D apart."""
        square = moving_square(across)
        u, w = moving_factors(square.value, lengths)
        return self.chain_root(
            name, Closing(u, w, square, False, across if lengths[0] == lengths[1] else None)
        )

    def slot_root(self, name: str, across: MovingPoint, offset: float) -> SignedRoot:
        """Return the root √(L² - o²) of a slot whose pin is carried by a moving point, D from the pivot."""
        square = moving_square(across)
        distance = sqrt(square.value)
        margin = (distance - offset) * (distance + offset)
        return self.chain_root(name, Closing(1.0, margin, square, True, None if offset else across))

    def chain_root(self, name: str, closing: Closing) -> SignedRoot:
        """Return the root of a dyad on moving points, and keep what closes it."""
        margin = closing.u * closing.w
        if isinstance(margin, float) and margin <= 0:
            # Its end keeps its distance from the line: what does not change is no formula, but a number.
            raise AssemblyError(f"joint {name}: {self._why_shut(name, closing)}")
        self.closings[name] = closing
        root = self.assembly.chain.get(name)
        if root is not None:
            return root.root(closing, self.state)
        return plain_root(closing.u, closing.w, closing.separation, closing.half_difference)

    def _why_shut(self, name: str, closing: Closing) -> str:
        """Say why a dyad whose factors do not change has no two closures."""
        u, w = closing.u, closing.w
        if not (isinstance(u, float) and isinstance(w, float) and u * w < 0):
            return AT_ITS_LIMIT
        return self.linkage.joint(name).why_apart(u, w, self.linkage.unit)

    def place_of(self, pin: Pin) -> Vec:
        """Return where a fixed pin stands."""
        if not self.exact:
            return Vec(*pin.position)
        return Vec(*map(Constant, pin.position, place(self.linkage, pin)))

    def attached(self, on: tuple[str, str], at: Point, name: str | None = None) -> MovingPoint:
        """Return the point `at` along on[0] -> on[1] and to its left; `name` where it is a joint."""
        n = self._body_of(on, f"joint {name}" if name else "centre of mass")
        piece, length = self.pieces[n], self._length(n, on)
        arm = self._arm(piece, *on).times(Vec(at[0] / length, at[1] / length))
        if name is not None:
            piece.arms[on[0], name] = arm
        return self.points[on[0]] + carried(arm, piece.turning)

    def axis(self, on: tuple[str, str]) -> tuple[Vec, Slope]:
        """Return the direction from one joint of a body to another, of length 1, and how the body turns."""
        n = self._body_of(on, "line of travel")
        return self._arm(self.pieces[n], *on).scaled(1.0 / self._length(n, on)), self.pieces[n].turning

    def _length(self, n: int, ends: tuple[str, str]) -> Value:
        """Return how far two joints of one body are apart: known, or for many digits worked out."""
        if self.exact:
            arm = self._arm(self.pieces[n], *ends)
            return sqrt(arm.dot(arm))
        start, end = (self.linkage.rigid_bodies[n][name] for name in ends)
        return abs(end - start)

    def _arm(self, piece: Piece, start: str, end: str) -> Vec:
        """Return the vector from one joint of a rigid body to another."""
        if (start, end) in piece.arms:
            return piece.arms[start, end]
        if (end, start) in piece.arms:
            return -piece.arms[end, start]
        return self.points[end].position - self.points[start].position

    def turning_of(self, names: tuple[str, ...], owner: str) -> Slope:
        """Return how the rigid body turns that has all these joints; AssemblyError where none has."""
        return self.pieces[self._body_of(names, owner)].turning

    def _body_of(self, names: tuple[str, ...], owner: str) -> int:
        n = holding(self.linkage.rigid_bodies, names)
        if n is None:
            raise AssemblyError(f"{owner}: {' and '.join(names)} are not joints of one rigid body")
        return n


@dataclass(frozen=True, slots=True)
class Guide:
    """A line of travel at one instant: its base point, its direction, and how it turns."""

    base: MovingPoint
    along: Vec
    turning: Slope
    offset: float

    def forward(self, point: MovingPoint) -> Moving:
        """Return how far a point lies forward of the base, with its rates as seen from the line."""
        return self._seen(point)[0]

    def aside(self, point: MovingPoint) -> Moving:
        """Return how far a point lies to the left of the line, with its rates as seen from the line."""
        left = self._seen(point)[1]
        return Moving(left.value - self.offset, left.rate, left.second)

    def _seen(self, point: MovingPoint) -> tuple[Moving, Moving]:
        """Return how far a point lies forward of the base, and to its left."""
        u, omega, alpha = self.along, self.turning.value, self.turning.rate
        w, w1, w2 = (
            point.position - self.base.position,
            point.velocity - self.base.velocity,
            point.acceleration - self.base.acceleration,
        )
        f, e = u.dot(w), u.cross(w)
        f1, e1 = u.dot(w1) + e * omega, u.cross(w1) - f * omega
        f2 = u.dot(w2) + (u.cross(w1) + e1) * omega + e * alpha
        e2 = u.cross(w2) - (u.dot(w1) + f1) * omega - f * alpha
        return Moving(f, f1, f2), Moving(e, e1, e2)

    def place(self, travel: Moving) -> MovingPoint:
        """Return the point that has travelled so far along the line from its base."""
        u, n = self.along, self.along.left()
        guided = self.base + carried(u.scaled(travel.value) + n.scaled(self.offset), self.turning)
        across = self.turning.value * travel.rate * 2.0
        return guided + MovingPoint(
            Vec(0.0, 0.0), u.scaled(travel.rate), u.scaled(travel.second) + n.scaled(across)
        )


def guide(line: Line, walk: Walk) -> Guide:
    """Return where a line of travel lies at the walk's instant, and how it moves."""
    along = Vec(*direction(line.angle))
    if line.on is None:
        return Guide(walk.points[line.through], along, Slope(0.0), line.offset)
    axis, turning = walk.axis(line.on)
    return Guide(walk.points[line.through], axis.times(along), turning, line.offset)
