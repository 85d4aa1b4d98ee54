"""Hold a scene: a linkage with its title, its source and what it was made for, ready to be solved.

Its parts, in reading order:

- What a linkage was made for, as its file keeps it: poses, a function, or a stroke and its time ratio.
- A scene: a linkage with its title, its source and what to trace, ready to be solved.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from linkanim.bounds import MOST_TURNS_ON
from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.units import shown
from linkanim.words import cached_as_said

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from linkanim.mechanics.analysis import Info
    from linkanim.mechanics.linkage import Linkage
    from linkanim.mechanics.motion import Mechanism, Motion, Pose
    from linkanim.mechanics.nearest import PointPath
    from linkanim.mechanics.quantities import Quantity

# What a linkage was made for, as its file keeps it: poses, a function, or a stroke and its time ratio.
#
# It does not affect the motion; the rooms that explain and draw the synthesis read it.


class PosesPurpose(NamedTuple):
    """Poses of the coupler: x, y (the scene's unit) and angle (rad); its origin is the first traced joint."""

    poses: tuple[tuple[float, float, float], ...]


class FunctionPurpose(NamedTuple):
    """A function in words, with its precision points.

    At each x the function has a y, the crank stands at an angle `input` (rad), and the output at an angle
    (rad), or a slider at a travel along its line (the scene's unit).
    """

    words: str
    x: tuple[float, ...]
    y: tuple[float, ...]
    input: tuple[float, ...]
    output: tuple[float, ...]


class TimeRatioPurpose(NamedTuple):
    """The slow stroke's time over the quick one's, and the slider's stroke, or the rocker's swing (rad)."""

    ratio: float
    stroke: float | None = None
    swing: float | None = None


Purpose = PosesPurpose | FunctionPurpose | TimeRatioPurpose


# A scene: a linkage with its title, its source and what to trace, ready to be solved.

Outline = Literal["bar", "plate", "wheel", "railwheel", "slot", "hook", "pad", "bucket", "none"]
"""How a body may be drawn: as a bar through its joints, a plate around them, a wheel about its first joint, a
wheel on a rail, a bar with a slot from its first to its second joint, a bar that ends in a hook or a pad, a
bucket whose edge is its last joint, or not at all."""
Block = Literal["block", "piston"]
"""How a sliding body may be drawn: as a block between rails, or as a piston in a cylinder with a head."""


class BodyStyle(NamedTuple):
    """How a scene has a body drawn: its outline, its colour (red, green, blue), and its radius as a wheel.

    Each is None where the scene does not state it.
    """

    outline: Outline | Block | None = None
    colour: tuple[int, int, int] | None = None
    radius: float | None = None


FREE_STYLE = BodyStyle()
_MADE_ANEW = frozenset({"quantities as said", "_lengths", "_forms"})
"""What a scene knows that holds functions, and goes through no pickle."""


@frozen
class Scene:
    """A linkage to show; lengths in `length_unit`, angles in radians, time in seconds."""

    name: str
    title: str
    source: str
    length_unit: str
    linkage: Linkage
    trace: tuple[str, ...] = ()
    chapter: str = ""
    """Of a collection, the part that it belongs to; the catalogue's are those of `chapters()`."""
    notes: tuple[str, ...] = ()
    """What a reader of its figures should know, such as where its source errs."""
    look_at: str = ""
    """What to watch for, in a sentence."""
    styles: tuple[tuple[str, BodyStyle], ...] = ()
    """How it has its bodies drawn, by their names, of those of which it says anything."""
    purpose: Purpose | None = None
    """What it was made for."""
    document: Mapping[str, Any] = field(default_factory=dict, repr=False, compare=False)
    """The scene file as it was read, for editing and writing it back."""
    goal: Scene | None = field(default=None, repr=False, compare=False)
    """The scene that this one, shown for an instant, is on the way to; what is told of that holds for it."""

    original_title: tuple[str, str] | None = field(default=None, repr=False, compare=False)
    """The title, and the class that it says, of a scene that was changed into another class."""

    @property
    def bare(self) -> Scene:
        """The scene without what has been worked out for it, which takes a hundred times its memory."""
        return replace(self, linkage=replace(self.linkage))

    @cached_property
    def mechanism(self) -> Mechanism:
        """The linkage put together; AssemblyError where it cannot be."""
        from linkanim.mechanics.motion import mechanism, transient

        free = self.goal is not None and not self.goal.mechanism.hindered
        return transient(self.linkage) if free else mechanism(self.linkage)

    def refuse_forceless(self) -> None:
        """Raise BadInput where the scene states nothing that has a force."""
        if not self.linkage.forceful:
            reason = "states no mass, spring, damper or load, so it has no forces"
            raise BadInput(f"{self.name}: {reason}; give a body a mass, or add [loads]")
        if not self.linkage.reacting:
            raise BadInput(
                f"{self.name}: forces of a block on two lines, or of a slot on a link of one point, are not "
                "worked out; what the input delivers is"
            )

    @property
    def without_inertia(self) -> Scene:
        """The scene with its forces as at rest; BadInput where it has none."""
        self.refuse_forceless()
        return replace(self, linkage=replace(self.linkage, static=True))

    def style(self, body: str) -> BodyStyle:
        """Return how the scene has a body drawn."""
        return dict(self.styles).get(body, FREE_STYLE)

    @cached_property
    def info(self) -> Info:
        """What is known of the linkage: class, input range, toggles, change points, stroke and more."""
        from linkanim.mechanics.analysis import Info

        if self.goal is not None:
            return self.goal.info
        return Info(self.mechanism, self.length_unit)

    @cached_as_said
    def quantities(self) -> Mapping[str, Quantity]:
        """All quantities by their tokens, such as "rocker.angle"; words call bodies by what they do."""
        from linkanim.mechanics.quantities import register

        return register(self.linkage, self.info.link_names)

    @cached_property
    def telling(self) -> tuple[str, ...]:
        """The tokens of the six to ten quantities that say most of it, the most telling first."""
        from linkanim.mechanics.quantities import key_quantities

        return key_quantities(self.cycle(self.mechanism.count(96)), self.trace)

    @cached_property
    def valued(self) -> tuple[str, ...]:
        """The tokens of the quantities with a finite value somewhere in a cycle, the telling ones first."""
        import numpy as np

        cycle = self.cycle(self.mechanism.count(96))
        tokens = dict.fromkeys((*self.telling, *self.quantities))
        return tuple(token for token in tokens if np.isfinite(self.quantities[token].read(cycle)).any())

    @cached_property
    def length_step(self) -> float:
        """The step in which its lengths are told: a power of ten, about a three-thousandth of the longest.

        How far it stands from the origin counts no more than how far its pins are apart.
        """
        joints = self.linkage.joints
        pins = [self.linkage.pin(joint.name).position for joint in joints if joint.fixed]
        stated = [abs(length) for joint in joints if not joint.fixed for length in joint.stated_lengths]
        spans = [max(along) - min(along) for along in zip(*pins, strict=True)]
        size = max((*stated, *map(abs, self.linkage.drive.actuator.stated_lengths), *spans), default=0.0)
        longest = self.linkage.longest
        return 10.0 ** round(math.log10(min(longest, size or longest) / 3000))

    @cached_property
    def derived(self) -> dict[str, Scene]:
        """The scene in other units of length, and on its "other closure", as far as they were asked for."""
        return {}

    @cached_property
    def _point_paths(self) -> dict[str, PointPath]:
        return {}

    def point_path(self, joint: str) -> PointPath:
        """Return where a joint passes over one true period, and where it is nearest to a place.

        KeyError for a name that is no joint's.
        """
        from linkanim.mechanics.nearest import point_path

        if joint not in self._point_paths:
            self._point_paths[joint] = point_path(self.mechanism, joint)
        return self._point_paths[joint]

    @property
    def period(self) -> float:
        """The true period in phase: 2π, or a whole multiple of it if all joints are back only then."""
        return 2 * math.pi * self.mechanism.periods

    @property
    def lines(self) -> tuple[tuple[str, str], ...]:
        """Label and value of what is told of the scene and of its linkage, in words; a value may be empty."""
        return (
            ("scene", f"{self.name}: {self.title}"),
            ("chapter", self.chapter),
            ("source", self.source),
            ("watch for", self.look_at),
            *self.info.lines,
        )

    def solve(
        self,
        *,
        angle: ArrayLike | None = None,
        phase: ArrayLike | None = None,
        travel: ArrayLike | None = None,
        speed: ArrayLike | None = None,
        acceleration: ArrayLike = 0.0,
        derivatives: int = 2,
        joints: Sequence[str] | None = None,
        out: NDArray[np.float64] | None = None,
    ) -> Motion:
        """Return the motion at crank angles or at phases (radians), or at a slider's travels, scalar or (N,).

        `speed` (rad/s) and `acceleration` (rad/s²) are those of what is given: of the crank's angle,
        or of the phase; the scene's own speed where none is given. Of a slider that drives, at its travel on
        its way from its first end to its last, they are in the scene's unit of length per s and s².
        `derivatives` 0, 1 or 2 says how much is worked out. A place outside the input's range gives NaN;
        rates at a limit are infinite. Of `joints`, if any are named, positions and rates are worked out, and
        nothing else. They are written into `out`, if given: a float array (derivatives + 1, joints, 2, N), of
        which the motion's arrays are views. BadInput unless one of angle, phase and travel is given, for an
        angle if the input is a slider, for a travel if it is none, for anything but numbers, for an `out` of
        another shape, and beyond a billion turns.
        """
        if (angle is None) + (phase is None) + (travel is None) != 2:
            raise BadInput("give either angle= or phase=, in radians, or travel= of a slider that drives")
        if joints is not None or out is not None:
            joints = self._named(joints)
        if travel is not None:
            kept = {"derivatives": derivatives, "joints": joints, "out": out}
            return self._at_travel(travel, speed, acceleration, kept)
        if angle is not None:
            self.linkage.drive.check_angle(self.name, "take the phase")
        check_derivatives(derivatives)
        by = "angle" if phase is None else "phase"
        where = given_numbers(by, angle if phase is None else phase)  # type: ignore[arg-type]
        self.check_turns(by, where)
        rate = self.linkage.drive.speed if speed is None else speed
        if type(rate) is not float:
            rate = given_numbers("speed", rate)
        if type(acceleration) is not float:
            acceleration = given_numbers("acceleration", acceleration)
        try:
            return self.mechanism.solve(
                **{by: where},
                speed=rate,
                acceleration=acceleration,
                derivatives=derivatives,
                joints=joints,
                out=out,
            )
        except ValueError as error:
            if out is None:
                raise
            raise BadInput(f"solve: {error}") from None

    def _named(self, joints: Sequence[str] | None) -> tuple[str, ...]:
        """Return the joints that are named, all of them where none are; BadInput for a name of none."""
        names = [joint.name for joint in self.linkage.joints]
        if joints is None:
            return tuple(names)
        for name in joints if not isinstance(joints, str) else [joints]:
            if name not in names:
                raise BadInput(f"solve(joints={joints!r}): {self.name} has joints {', '.join(names)}")
        return tuple(dict.fromkeys([joints] if isinstance(joints, str) else joints))

    def _at_travel(
        self, travel: ArrayLike, speed: ArrayLike | None, acceleration: ArrayLike, kept: dict[str, Any]
    ) -> Motion:
        """Return the motion at travels of a slider that drives: s = middle - half cos φ, and so its rates."""
        import numpy as np

        if self.linkage.drive.coordinate.is_angle:
            raise BadInput(f"{self.name}: its input turns, and has no travel; take the angle")
        at, (first, last) = given_numbers("travel", travel), self.linkage.drive.actuator.stated_lengths
        half = (last - first) / 2
        with np.errstate(all="ignore"):
            gone, ahead = (at - first) / half, (last - at) / half
            phase = 2 * np.arctan2(np.sqrt(gone), np.sqrt(ahead))
            if speed is None:
                return self.solve(phase=phase, acceleration=acceleration, **kept)
            slope = half * np.sin(phase)
            rate = given_numbers("speed", speed) / slope
            second = (
                given_numbers("acceleration", acceleration) - half * np.cos(phase) * rate * rate
            ) / slope
        return self.solve(phase=phase, speed=rate, acceleration=second, **kept)

    @cached_property
    def _most(self) -> float:
        """The greatest phase or angle (rad) at which a pose has all its digits."""
        return 2 * math.pi * MOST_TURNS_ON / max(self.mechanism.assembly.quickest / 2, 1.0)

    def check_turns(self, what: str, places: NDArray[np.float64]) -> None:
        """Raise BadInput for phases or angles (rad) so large that a pose would not have all its digits."""
        flat, most = places.ravel(), self._most**2
        # sums of squares take least time; of more numbers at once they would wait for threads of their own
        for first in range(0, flat.size, 8192):
            part = flat[first : first + 8192]
            if not part.dot(part) <= most:
                break
        else:
            return
        size = max(float(flat.max()), -float(flat.min()))
        if size > self._most:
            turns = f"{round(self._most / (2 * math.pi)):,}"
            raise BadInput(
                f"{self.name}: {what}={size:g} is more than {turns} turns, up to which a pose has all its"
                f" digits; take off whole periods, each {self.period:g} rad"
            )

    def cycle(self, count: int, *, derivatives: int = 2) -> Motion:
        """Return the motion at `count` phases, equally spaced over one true period, the end left out."""
        import numpy as np

        if not isinstance(count, int | np.integer) or count < 1:
            raise BadInput(f"cycle({count!r}): give a whole number of phases, at least 1")
        return self.solve(phase=np.arange(count) * (self.period / count), derivatives=derivatives)

    def pose(
        self,
        phase: float,
        derivatives: int = 2,
        *,
        speed: float | None = None,
        acceleration: float = 0.0,
    ) -> Pose:
        """Return the motion at one phase in plain floats, as fast as a frame needs it.

        BadInput for anything but numbers, and for `derivatives` other than 0, 1 and 2.
        """
        if derivatives not in (0, 1, 2):
            check_derivatives(derivatives)
        rate = self.linkage.drive.speed if speed is None else speed
        # A pose takes a microsecond or two, so values that are floats already are not checked further.
        if not (type(phase) is type(rate) is type(acceleration) is float):
            phase, rate, acceleration = _as_floats(phase, rate, acceleration)
        if abs(phase) > self._most:
            self.check_turns("phase", given_numbers("phase", phase))
        return self.mechanism.pose(phase, rate, acceleration, derivatives)

    def __getstate__(self) -> dict[str, Any]:
        """Return the state for a pickle, without what holds functions: that is made anew."""
        return {name: value for name, value in vars(self).items() if name not in _MADE_ANEW}

    def _repr_html_(self) -> str:
        """Return the scene's title and what is told of its linkage, as a notebook shows it."""
        from html import escape

        cells = "".join(
            f"<tr><th style='text-align:left'>{escape(label)}</th><td>{escape(value)}</td></tr>"
            for label, value in self.lines
            if value
        )
        return f"<table>{cells}</table>"


def given_numbers(name: str, given: ArrayLike, call: str = "solve") -> NDArray[np.float64]:
    """Return what is given as an array of floats; BadInput where it is anything but numbers."""
    import numpy as np

    try:
        numbers = np.asarray(given)
        if numbers.dtype.kind in "fiubO":
            return np.asarray(numbers, np.float64)
    except (TypeError, ValueError):
        pass
    raise BadInput(f"{call}({name}={shown(given)}): give numbers, one or an array of them")


def _as_floats(phase: float, speed: float, acceleration: float) -> tuple[float, float, float]:
    try:
        return float(phase + 0.0), float(speed + 0.0), float(acceleration + 0.0)
    except TypeError:
        raise BadInput(
            f"pose({phase!r}): phase, speed and acceleration are numbers, in radians and seconds"
        ) from None


def check_derivatives(derivatives: int) -> None:
    """Raise BadInput for anything but 0, 1 and 2."""
    if derivatives not in (0, 1, 2):
        raise BadInput(
            f"derivatives={derivatives!r}: give 0 (positions), 1 (velocities) or 2 (accelerations)"
        )
