"""How far a linkage may be off when each of its lengths is: to first order, and by samples.

A quantity is off by the sum of what each length does to it: to first order its derivative by that length,
times the length's error. At the most all errors add up. A point is off in the plane, where the vectors of all
lengths, each forth or back, add up to a zonotope: the worst is its farthest corner.

Derivatives are central differences of order 8 over three steps, of which the two that agree best decide: they
have ten digits and more, less only beside a limit. Samples are linkages whose errors are even within the
tolerance, solved as they are, so that what first order leaves out is seen.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import field
from functools import cache
from itertools import count
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from linkanim.bounds import can_be_computed
from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.mechanics.measures import output_body
from linkanim.scenes.editing import dimensions
from linkanim.scenes.files import load
from linkanim.scenes.many import Many, named_lengths, solve_many, solved_alike, solved_together
from linkanim.scenes.scene import Scene
from linkanim.units import shown

Real = NDArray[np.float64]

SAMPLES = 10_000
"""The number of linkages that are drawn."""
LIKELY = 0.95
"""The share of the samples that are off by no more than what is likely."""
_PHASES = 72
"""The number of phases of a period."""
_SEED = 1
_STENCIL = np.array([4 / 5, -1 / 5, 4 / 105, -1 / 280])
"""The weights of a central difference of order 8 at one to four steps."""
_STEPS = 2.0 ** -np.array([5.0, 7.0, 9.0])
"""The steps, as shares of what a length may well change by."""
_BESIDE = 0.05
"""How far (rad) to either side of a dead centre a parabola finds a sample's own."""
_NOTHING = 1e-12
"""An effect of an error of one length, in lengths or radians, that is none."""
_MOST = 0.1
"""The largest tolerance, as a share of a linkage's extent."""


class Off(NamedTuple):
    """How far one quantity may be off: lengths in the scene's unit, angles in radians.

    `bound` (P,) is the most to first order at each of `phases`; a stroke or a swing has one value and no
    phases. `alone` (L, P) is what each length does alone, to first order. Of the samples, where the bound
    is worst, `likely` is what 95 in 100 stay within, `greatest` the most; NaN where none were drawn.
    """

    name: str
    is_angle: bool
    phases: Real
    bound: Real
    alone: Real
    likely: float
    greatest: float

    @property
    def worst(self) -> float:
        """The most that it may be off, to first order, in any phase."""
        return float(self.bound.max())

    @property
    def by(self) -> Real:
        """The most (L,) that each length does alone in any phase."""
        return np.asarray(self.alone.max(axis=1))

    @property
    def worst_phase(self) -> float | None:
        """The phase at which it is worst; None of a stroke or a swing."""
        return float(self.phases[self.bound.argmax()]) if len(self.phases) else None


@frozen(eq=False)
class Tolerance:
    """How far a scene's quantities may be off when each of its lengths is off by `by` at the most."""

    scene: Scene = field(repr=False)
    by: float
    lengths: tuple[str, ...]
    quantities: tuple[Off, ...]

    def most(self, off: Off) -> str:
        """Return the length that matters most to a quantity."""
        return self.lengths[int(off.by.argmax())]


class _Quantity(NamedTuple):
    """A quantity: what it is called, its values (N, 1) or (N, 2) in a motion, a stroke's dead centres."""

    name: str
    is_angle: bool
    values: Callable[[Any], Real]
    ends: tuple[float, float] | None = None

    def less(self, one: Real, other: Real) -> Real:
        """Return a difference; of angles at most half a turn."""
        off = one - other
        return np.asarray((off + np.pi) % (2 * np.pi) - np.pi if self.is_angle else off)

    def off(self, scene: Scene, phases: Real, effects: Real, draw: Draw | None) -> Off:
        """Return how far it is off by the effects (L, P, 1 or 2) of all lengths, and by the samples."""
        bound = _farthest(effects)
        likely = greatest = np.nan
        if draw:
            places = (draw, lambda phase: scene.solve(phase=[phase], derivatives=0))
            if self.ends:
                drawn, exact = (self._strokes(*self.ends, solve)[:, None] for solve in places)
            else:
                drawn, exact = (self.values(solve(float(phases[bound.argmax()]))) for solve in places)
            off = np.linalg.norm(self.less(drawn, exact), axis=1)
            off = off[np.isfinite(off)]
            likely, greatest = (float(np.quantile(off, share)) for share in (LIKELY, 1.0))
        alone = np.linalg.norm(effects, axis=2)
        return Off(self.name, self.is_angle, phases, bound, alone, likely, greatest)

    def _strokes(self, back: float, forth: float, solve: Callable[[float], Any]) -> Real:
        """Return the strokes of linkages, each between its own dead centres, by a parabola beside ours."""
        extremes = []
        for end in (back, forth):
            low, middle, high = (self.values(solve(end + way))[:, 0] for way in (-_BESIDE, 0.0, _BESIDE))
            if self.is_angle:
                low, high = (middle + self.less(side, middle) for side in (low, high))
            bend = low - 2 * middle + high
            extremes.append(middle - (high - low) ** 2 / (8 * bend))
        return self.less(extremes[1], extremes[0])


def tolerance(
    scene: Scene | str,
    by: float,
    *,
    samples: int = SAMPLES,
    progress: Callable[[int, int], None] | None = None,
) -> Tolerance:
    """Return how far points, output and stroke may be off when each length is off by `by` at the most.

    The points are the traced joints, or all joints that move where none is; angles are in radians, lengths
    and `by` in the scene's unit. Of fixed pins each coordinate is a length, but those of the input's own.
    `samples` linkages are drawn beside the first order. BadInput for a tolerance that makes no sense, and for
    linkages that are at a change point, or that a cylinder or a slider drives.
    """
    steps = count(1)
    scene = load(scene) if isinstance(scene, str) else scene
    if not (can_be_computed(by) and 0 < by <= _MOST * scene.linkage.extent):
        most = f"{_MOST * scene.linkage.extent:.3g} {scene.length_unit}"
        raise BadInput(
            f"a tolerance of {shown(by)}: give a length above zero and of {most} at the most, a tenth of the "
            "linkage's extent"
        )
    names = _lengths_of(scene)
    quantities = tuple(_quantities(scene)) if solved_together(scene, names) else ()
    whole = 1 + len(quantities)
    if not quantities:
        raise BadInput(
            f"{scene.name}: tolerances are worked out for chains of dyads that a turning crank drives, away "
            "from change points and limits"
        )

    def pulse() -> None:
        if progress:
            progress(next(steps), whole)

    phases = np.linspace(0, scene.period, _PHASES, endpoint=False)
    strokes = [phase for one in quantities if one.ends for phase in one.ends]
    effects = _effects(scene, names, quantities, np.concatenate([phases, strokes]))
    pulse()
    if not all(np.isfinite(one).all() for one in effects):
        raise BadInput(
            f"{scene.name}: with a length only a little different it cannot be put together in every pose, "
            "so there is no first order; change its lengths, or its start"
        )
    acts = np.max([np.abs(one).max(axis=(1, 2)) for one in effects], axis=0) > _NOTHING
    used = tuple(name for name, acting in zip(names, acts, strict=True) if acting)
    draw = _drawn(scene, used, by, samples) if samples else None
    deviations = []
    for one, every in zip(quantities, effects, strict=True):
        pulse()
        off = by * every[acts]
        if one.ends:
            back, forth = (off[:, [len(phases) + strokes.index(end)]] for end in one.ends)
            deviations.append(one.off(scene, np.empty(0), forth - back, draw))
        else:
            deviations.append(one.off(scene, phases, off[:, : len(phases)], draw))
    return Tolerance(scene, by, used, tuple(deviations))


def _lengths_of(scene: Scene) -> tuple[str, ...]:
    """Return a name for each length that may be off: a bar by its body, others by their key."""
    names: dict[tuple[object, ...], list[str]] = {}
    for name, number in named_lengths(scene).items():
        names.setdefault(number.key, []).append(name)
    pivot = scene.linkage.drive.joint
    held = {getattr(joint, "pivot", None) for joint in scene.linkage.joints if joint.name == pivot}
    chosen = []
    for key, called in names.items():
        own = key[0] in ("bodies", "springs", "dampers", "loads", "view")
        if not own and not (key[0] == "ground" and key[1] in held and len(key) > 2):
            bodies = [name for name in called if "." not in name and not name.isdecimal()]
            chosen.append(bodies[0] if bodies else called[0])
    return tuple(chosen)


def _quantities(scene: Scene) -> Iterator[_Quantity]:
    """Yield the points, then the output's angle or travel, then its swing or stroke."""
    pins = {pin.name for pin in scene.linkage.pins}
    moving = [joint.name for joint in scene.linkage.joints if joint.name not in pins]
    for name in scene.trace or moving:
        yield _Quantity(name, False, _place(name))
    body, info = output_body(scene.linkage), scene.info
    if body is None:
        return
    sliding = body.slider is not None
    values = _travel(body.name) if sliding else _angle(body.name)
    yield _Quantity(body.name, not sliding, values)
    ends = info.dead_centres if sliding else info.swing and info.swing.dead_centres
    if ends:
        yield _Quantity("stroke" if sliding else "swing", not sliding, values, ends)


def _place(name: str) -> Callable[[Any], Real]:
    return lambda motion: np.asarray(motion.position[name])


def _travel(name: str) -> Callable[[Any], Real]:
    return lambda motion: np.asarray(motion.travel[name])[:, None]


def _angle(name: str) -> Callable[[Any], Real]:
    return lambda motion: np.asarray(motion.angle[name])[:, None]


def _own(scene: Scene, names: tuple[str, ...]) -> Real:
    values = {one.key: one.value for one in dimensions(scene)}
    return np.array([float(values[named_lengths(scene)[name].key]) for name in names])


def _effects(
    scene: Scene,
    names: tuple[str, ...],
    quantities: tuple[_Quantity, ...],
    phases: Real,
) -> list[Real]:
    """Return the derivatives (L, P, 1 or 2) of each quantity by each length, at each phase.

    All linkages, each with one length moved, are solved in one call. Where one is not like the scene's own
    the next smaller step decides.
    """
    own, known, reach = _own(scene, names), named_lengths(scene), scene.linkage.extent / 8
    is_length = [known[name].type.measure == "length" for name in names]
    steps = np.multiply.outer(np.where(is_length, np.minimum(own / 2, reach), reach), _STEPS)
    away = steps[:, :, None, None] * np.multiply.outer([1.0, 2.0, 3.0, 4.0], [1.0, -1.0])
    rows = own[:, None, None] + np.eye(len(own))[:, :, None] * away.reshape(1, len(own), -1)
    lengths = np.repeat(rows.reshape(len(own), -1), len(phases), axis=1)
    motion = solved_alike(scene, dict(zip(names, lengths, strict=True)), np.tile(phases, away.size))
    effects = []
    for one in quantities:
        values = one.values(motion).reshape(*away.shape, len(phases), -1)
        apart = one.less(values[:, :, :, 0], values[:, :, :, 1])
        slopes = np.einsum("lhkpc,k->lhpc", apart, _STENCIL) / steps[:, :, None, None]
        off = np.nan_to_num(np.abs(np.diff(slopes, axis=1)), nan=np.inf).max(axis=-1)
        first = (off[:, 0] <= off[:, 1]) & np.isfinite(slopes[:, 1]).all(axis=-1)
        effects.append(np.where(first[..., None], slopes[:, 1], slopes[:, 2]))
    return effects


Draw = Callable[[float], Many]
"""Solves the linkages that were drawn at a phase."""


def _drawn(scene: Scene, names: tuple[str, ...], by: float, samples: int) -> Draw:
    errors = np.random.default_rng(_SEED).uniform(-by, by, (len(names), samples))
    lengths = dict(zip(names, _own(scene, names)[:, None] + errors, strict=True))
    return cache(lambda phase: solve_many(scene, lengths, phase))


def _farthest(effects: Real) -> Real:
    """Return the norm (P,) of the farthest corner of the zonotope that effects (L, P, 1 or 2) span."""
    if effects.shape[2] == 1:
        return np.asarray(np.abs(effects[..., 0]).sum(axis=0))
    x, y = effects[..., 0], effects[..., 1]
    most = np.zeros(effects.shape[1])
    for n in range(len(effects)):
        across = x[n] * y - y[n] * x
        beside = np.where(across == 0, np.sign(x[n] * x + y[n] * y), 0.0)
        corner = (np.sign(across)[..., None] * effects).sum(axis=0)
        edge = (beside[..., None] * effects).sum(axis=0)
        for sign in (1.0, -1.0):
            most = np.maximum(most, np.linalg.norm(corner + sign * edge, axis=1))
    return most
