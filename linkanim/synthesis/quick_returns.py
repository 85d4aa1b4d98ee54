"""`linkanim.quick_return`: linkages from their swing or stroke and their time ratio, by Alt's construction.

In its two dead centres a crank a and its coupler b lie in line: the output's pin is b - a and b + a away
from the crank's pivot, and between the two directions lies the angle α of the time ratio, which is
Q = (180° + α)/(180° - α). So the pivot sees the chord H between the dead centres at the angle α: it lies
on a circle through both (Alt, 1925; VDI 2130). By the law of cosines H² = 4b² sin²(α/2) + 4a² cos²(α/2),
which leaves one free parameter, the angle k·x of which b/a = tan(k·x)/k with k = tan(α/2), and the pivot is
(b² - a²) sin α / H off the chord's line. Without a quick return α and k are 0: then x itself is b/a, and a is
half the chord.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import field, replace
from functools import cached_property, lru_cache
from typing import Any, NamedTuple

import numpy as np

from linkanim import units
from linkanim.bounds import can_be_computed
from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.mechanics.search import highest
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene, TimeRatioPurpose
from linkanim.synthesis.linkages import Real, angle_of, least_of_turn, refuse_count
from linkanim.units import shown

COUNT = 5
_TABLES: Mapping[str, str] = {"slider-crank": "slider-crank", "crank-rocker": "four-bar"}
"""For each kind, the table of a scene file that holds it."""
KINDS = (*_TABLES, "six-bar")
"""The kinds; a six-bar is a crank-rocker whose rocker is longer and moves a slider by a rod."""
_SWING, _SHORTER = math.radians(60), 5.0
"""The usual swing of a six-bar's rocker, and the strokes in cranks."""
LONGEST = 100.0
"""The longest link of a crank-rocker for which only angles are given."""
_LONGEST_ROD = 12.0
"""The longest rod of a family, in cranks, as its angle may still grow while the crank goes to zero."""
_TRIED = 2001
_STEEPEST = math.radians(1.0)
"""The least transmission angle (rad) of a member."""
_DIGITS = 12


@frozen(eq=False)
class QuickReturn:
    """A linkage with its time ratio; lengths in the scene's unit, angles in radians."""

    scene: Scene = field(repr=False)
    kind: str
    parameters: Mapping[str, float]
    place: float
    """Where in the family it is, from 0 to 1."""
    ratio: float
    output: float
    """The slider's stroke, or the rocker's swing (rad)."""
    transmission_angle: float
    """The least one over the turn (rad)."""
    best: bool
    """Whether it is the member with the largest least transmission angle."""

    @property
    def class_name(self) -> str:
        """The linkage's class, in words."""
        return self.scene.info.class_name

    @property
    def size(self) -> float:
        """The longest link."""
        return max(abs(value) for name, value in self.parameters.items() if name != "offset")


@frozen
class DeadCentreFamily:
    """Linkages with one stroke or swing and one time ratio, by the parameter x.

    Members have x from `low` to `high`. `side` is +1 where the crank's pivot lies on the same side of the
    chord as the rocker's, else -1. The chord has length 1.
    """

    kind: str
    angle: float
    swing: float
    side: float
    low: float
    high: float

    @property
    def ratio(self) -> float:
        """The time ratio."""
        return (math.pi + self.angle) / (math.pi - self.angle)

    @property
    def slope(self) -> float:
        """k, the tangent of half the angle of the time ratio."""
        return math.tan(self.angle / 2)

    def lengths(self, x: Real) -> tuple[Real, Real, Real]:
        """Return crank, coupler, and the distance of the crank's pivot from the chord's line."""
        longer = np.tan(self.slope * x) / self.slope if self.slope else x
        crank = 0.5 / np.hypot(longer * math.sin(self.angle / 2), math.cos(self.angle / 2))
        coupler = longer * crank
        return crank, coupler, (coupler - crank) * (coupler + crank) * math.sin(self.angle)

    def rocker(self, x: Real) -> tuple[Real, Real, Real, Real]:
        """Return crank, coupler, rocker and ground; NaN if the dead centres are in different circuits.

        The ground is negative where the coupler's end lies to the right of the line from A to O4.
        """
        crank, coupler, off = self.lengths(x)
        rocker = np.full_like(x, 1 / (2 * math.sin(self.swing / 2)))
        # the nearer dead centre at 0, the farther at 1, the rocker's pivot below their middle
        other = 0.5 - 1j * rocker * math.cos(self.swing / 2)
        with np.errstate(all="ignore"):
            along = ((coupler - crank) ** 2 + 1 - (coupler + crank) ** 2) / 2
            pivot = along - 1j * self.side * off
            near, far = -pivot, 1 - pivot
            pins = pivot - crank * near / np.abs(near), pivot + crank * far / np.abs(far)
            sides = [
                (np.conj(other - pin) * (end - pin)).imag for pin, end in zip(pins, (0.0, 1.0), strict=True)
            ]
            ground = np.abs(other - pivot)
        return crank, coupler, rocker, np.where(sides[0] * sides[1] > 0, np.sign(sides[0]) * ground, np.nan)

    def transmission(self, x: Real) -> Real:
        """Return the least transmission angle (rad) over a turn; NaN for a crank that does not turn fully."""
        with np.errstate(all="ignore"):
            if self.kind == "slider-crank":
                crank, coupler, off = self.lengths(x)
                # if the pivot's foot is between the dead centres, the nearer one is in the other circuit
                angle = angle_of(np.where(4 * crank * coupler > 1, (crank + np.abs(off)) / coupler, np.nan))
            else:
                crank, coupler, rocker, ground = self.rocker(x)
                angle = least_of_turn(crank, coupler, rocker, np.abs(ground))
            return np.where(angle > 0, angle, np.nan)

    def at(self, longer: float) -> float:
        """Return the x of a coupler that is so many cranks long."""
        return math.atan(longer * self.slope) / self.slope if self.slope else longer

    def place_of(self, x: float) -> float:
        """Return how far along the family a member is, from 0 to 1."""
        return min(max((x - self.low) / (self.high - self.low), 0.0), 1.0)

    @cached_property
    def best(self) -> float:
        """The x of the greatest least transmission angle."""
        places = np.linspace(self.low, self.high, _TRIED)
        values = np.nan_to_num(self.transmission(places))
        step = (self.high - self.low) / (_TRIED - 1)
        return highest(self.transmission, float(places[values.argmax()]), step, (self.low, self.high))


@lru_cache(maxsize=64)
def families(kind: str, ratio: float, swing: float = 0.0) -> tuple[DeadCentreFamily, ...]:
    """Return the families of linkages with a time ratio, and for crank-rockers a swing (rad); maybe none."""
    angle = math.pi * (ratio - 1) / (ratio + 1)
    parts = []
    for side in (1.0,) if kind == "slider-crank" or not angle else (1.0, -1.0):
        whole = DeadCentreFamily(kind, angle, swing, side, 0.0, 0.0)
        whole = replace(whole, high=whole.at(_LONGEST_ROD))
        places = np.linspace(whole.low, whole.high, _TRIED + 1)[1:]
        allowed = np.nan_to_num(whole.transmission(places)) >= _STEEPEST
        sound = np.flatnonzero(allowed)
        parts += [
            replace(whole, low=float(places[run[0]]), high=float(places[run[-1]]))
            for run in np.split(sound, np.flatnonzero(np.diff(sound) > 1) + 1)
            if len(run) > 2
        ]
    return tuple(sorted(parts, key=lambda one: -float(one.transmission(np.array([one.best]))[0])))


def quick_return(
    *,
    ratio: float,
    stroke: float | None = None,
    swing: float | None = None,
    kind: str | None = None,
    crank: float | None = None,
    place: float | None = None,
    count: int = COUNT,
    unit: str = "mm",
    name: str = "quick-return",
    source: str = "made by linkanim for a time ratio",
) -> tuple[QuickReturn, ...]:
    """Return linkages whose output takes `ratio` times as long one way as the other, the best first.

    For a slider-crank give the `stroke`; for a crank-rocker the `swing` (rad) and perhaps, as `stroke`, the
    chord between the dead centres of its pin. A six-bar has a slider whose `stroke` may be many times its
    `crank`, a fifth of it by default: a rocker with that `swing`, 60 degrees by default, is as long as that
    takes. The first linkage has the largest least transmission angle of
    the family, the others lie evenly along it; `place`, from 0 to 1, takes that one alone. BadInput for
    numbers that make no sense, and if no linkage of the kind does it.
    """
    named = kind is not None
    kind = kind or ("slider-crank" if swing is None else "crank-rocker")
    if kind not in KINDS:
        raise BadInput(f"kind={shown(kind)}: take {' or '.join(KINDS)}")
    units.metre(unit)
    refuse_count(count)
    if not (math.isfinite(ratio) and 1 <= ratio < 10):
        raise BadInput(f"a time ratio of {ratio:g}: give the slow way's time over the quick way's, 1 to 10")
    if stroke is not None and not (can_be_computed(stroke) and stroke > 0):
        raise BadInput(f"a stroke of {stroke:g}: give a length above zero")
    if kind != "crank-rocker" and stroke is None:
        other = "" if named else ", or the swing of a crank-rocker, such as 60 deg"
        raise BadInput(f"the stroke is missing: give that of a {kind}, such as 80{other}")
    if kind != "six-bar" and crank is not None:
        raise BadInput(f"the crank of a {kind} follows from the others; leave it out, or ask for a six-bar")
    if crank is not None and not (can_be_computed(crank) and crank > 0):
        raise BadInput(f"a crank of {crank:g}: give a length above zero")
    if kind == "six-bar":
        swing = _SWING if swing is None else swing
    if kind == "slider-crank" and swing is not None:
        raise BadInput("a slider-crank has a stroke, and no swing; give the one and leave out the other")
    if kind == "crank-rocker" and swing is None:
        raise BadInput("a crank-rocker has a swing; give its rocker's, such as 60 deg")
    if swing is not None and not math.radians(1) <= swing <= math.radians(179):
        raise BadInput(f"a swing of {math.degrees(swing):g} deg: a rocker swings by 1 to 179 deg")
    if place is not None and not 0 <= place <= 1:
        raise BadInput(f"place={place:g}: the family goes from 0 to 1")
    solutions = families("crank-rocker" if kind == "six-bar" else kind, ratio, swing or 0.0)
    if not solutions:
        said = f"swings by {math.degrees(swing):g} deg" if swing else "slides"
        other = ", or another swing" if swing else ""
        raise BadInput(f"no {kind} {said} with a time ratio of {ratio:g}; take a smaller one{other}")
    family = solutions[0]
    best = family.best
    places = (
        [best, *np.linspace(family.low, family.high, count + 1)[1:-1]]
        if place is None
        else [family.low + place * (family.high - family.low)]
    )
    stated = {"length_unit": unit, "source": source}
    if kind == "six-bar":
        assert stroke is not None
        short = crank or stroke / _SHORTER
        return tuple(_longer(family, float(x), (stroke, short), stated, name) for x in places[:count])
    return tuple(_made(family, float(x), stroke, stated, name) for x in places[:count])


class FamilyMember(NamedTuple):
    """A scene as a member of the family of its time ratio: the family, and the chord in the scene's unit.

    `place`, from 0 to 1, is where in the family it is. `transmission` is its least transmission angle (rad),
    `best` the greatest one in the family.
    """

    family: DeadCentreFamily
    chord: float
    place: float
    transmission: float
    best: float


def member_of(scene: Scene) -> FamilyMember | None:
    """Return where a scene is in the family of its time ratio; None where it belongs to none.

    A scene whose lengths were changed has the place of the nearest member with the same time ratio.
    """
    purpose = scene.purpose
    kind = next((one for one, table in _TABLES.items() if table in scene.document), "")
    if not isinstance(purpose, TimeRatioPurpose) or not kind:
        return None
    places = {name: complex(*at) for name, at in scene.pose(0.0, 0).position.items()}
    crank, coupler = abs(places["A"] - places["O2"]), abs(places["B"] - places["A"])
    if kind == "slider-crank":
        swing, chord, ground = 0.0, purpose.stroke, 0.0
    else:
        swing, ground = purpose.swing or 0.0, abs(places["O4"] - places["O2"])
        chord = 2 * abs(places["B"] - places["O4"]) * math.sin(swing / 2)
    if not chord or not 1 <= purpose.ratio < 10:
        return None
    candidates = []
    for family in families(kind, purpose.ratio, swing):
        x = min(max(family.at(coupler / crank), family.low), family.high)
        its = 0.0 if kind == "slider-crank" else abs(float(family.rocker(np.array([x]))[3][0])) * chord
        candidates.append((abs(its - ground), family, x))
    if not candidates:
        return None
    _, family, x = min(candidates, key=lambda one: one[0])
    least, most = family.transmission(np.array([x, family.best])).tolist()
    return FamilyMember(family, chord, family.place_of(x), least, most)


def moved_along(scene: Scene, x: float) -> Scene:
    """Return the member of a scene's family at a place, 0 to 1, with the same chord.

    BadInput for a scene that belongs to no family.
    """
    member = member_of(scene)
    if member is None:
        raise BadInput(f"{scene.name}: was made for no time ratio, so it belongs to no family")
    family = member.family
    _, _, tables = _sized(family, family.low + x * (family.high - family.low), member.chord)
    merged = {key: {**scene.document[key], **table} for key, table in tables.items()}
    return scene_from({**scene.document, **merged}, name=scene.name, where=scene.name)


def _sized(
    family: DeadCentreFamily, x: float, chord: float | None
) -> tuple[float, dict[str, float], dict[str, Any]]:
    """Return a member's chord, parameters and tables; without a chord, its longest link is `LONGEST`."""
    sliding, at = family.kind == "slider-crank", np.array([x])
    values = [float(part[0]) for part in (family.lengths(at) if sliding else family.rocker(at))]
    scale = chord or LONGEST / max(map(abs, values))
    lengths = [round(scale * value, _DIGITS - math.floor(math.log10(scale))) for value in values]
    return scale, *(_slider_crank if sliding else _crank_rocker)(lengths)


def _made(
    family: DeadCentreFamily, x: float, stroke: float | None, stated: Mapping[str, str], name: str
) -> QuickReturn:
    """Return a member of a family as a scene, its time ratio as the solver has it."""
    scale, parameters, tables = _sized(family, x, stroke)
    document = {
        "title": f"{family.kind.capitalize()} with a time ratio of {family.ratio:g}",
        **stated,
        "drive": {"joint": "A", "speed": "20 rpm", "start": "0 deg"},
        **tables,
        "quick-return": {
            "ratio": round(family.ratio, _DIGITS),
            **_stated(family, scale, stated["length_unit"]),
        },
    }
    scene = scene_from(document, name=name, where=name)
    info = scene.info
    output = info.stroke if family.kind == "slider-crank" else info.swing and info.swing.stroke
    return QuickReturn(
        scene=scene,
        kind=family.kind,
        parameters=parameters,
        place=family.place_of(x),
        ratio=info.time_ratio or 1.0,
        output=output or 0.0,
        transmission_angle=float(family.transmission(np.array([x]))[0]),
        best=x == family.best,
    )


def _longer(
    family: DeadCentreFamily, x: float, sizes: tuple[float, float], stated: Mapping[str, str], name: str
) -> QuickReturn:
    """Return a six-bar with a stroke and a crank of these sizes.

    The rocker's end D has the stroke as its chord, and the slider's line runs along the chord, halfway up the
    arc above it: so D is equally far from the line at both dead centres, and the stroke is the chord.
    """
    stroke, short = sizes
    values = [float(part[0]) for part in family.rocker(np.array([x]))]
    digits = _DIGITS - math.floor(math.log10(stroke))
    crank, coupler, rocker, ground = (round(value * short / values[0], digits) for value in values)
    ends = [
        math.acos((ground**2 + rocker**2 - reach**2) / (2 * abs(ground) * rocker))
        for reach in (coupler - crank, coupler + crank)
    ]
    half = (ends[1] - ends[0]) / 2
    lever = stroke / (2 * math.sin(half))
    middle = math.copysign(1.0, ground) * (math.pi - (ends[0] + ends[1]) / 2)
    document: dict[str, Any] = {
        "title": f"Six-bar with a time ratio of {family.ratio:g} and a stroke of {stroke / crank:.4g} cranks",
        **stated,
        "drive": {"joint": "A", "speed": "20 rpm", "start": "0 deg"},
        "ground": {"O2": [0, 0], "O4": [abs(ground), 0]},
        "quick-return": {"ratio": round(family.ratio, _DIGITS), "swing": f"{math.degrees(2 * half)!r} deg"},
    }

    def scene(sign: float) -> Scene:
        """Return the scene whose slider goes forward to the left, or to the right, of the rocker's middle."""
        angle = f"{math.degrees(middle) + sign * 90!r} deg"
        line = {"through": "O4", "angle": angle, "offset": -sign * lever * (1 + math.cos(half)) / 2}
        joints = {
            "A": {"crank": "O2", "length": crank},
            "B": {
                "from": ["A", "O4"],
                "length": [coupler, rocker],
                "side": "left" if ground > 0 else "right",
            },
            "D": {"on": ["O4", "B"], "at": [lever, 0]},
            "C": {"from": "D", "length": lever, "line": line, "side": "forward"},
        }
        bodies = {
            "crank": {"joints": ["O2", "A"]},
            "coupler": {"joints": ["A", "B"]},
            "rocker": {"joints": ["O4", "B", "D"]},
            "rod": {"joints": ["D", "C"]},
            "slider": {"slider": "C"},
        }
        return scene_from({**document, "joints": joints, "bodies": bodies}, name=name, where=name)

    one = scene(1.0)
    forward = one.cycle(_TRIED, derivatives=1).travel_velocity["slider"] > 0
    made = one if forward.mean() >= 0.5 else scene(-1.0)
    info = made.info
    own = float(family.transmission(np.array([x]))[0])
    return QuickReturn(
        scene=made,
        kind="six-bar",
        parameters={
            **{"ground": abs(ground), "crank": crank, "coupler": coupler, "rocker": rocker},
            **{"lever": lever, "rod": lever},
        },
        place=family.place_of(x),
        ratio=info.time_ratio or 1.0,
        output=info.stroke or 0.0,
        transmission_angle=min(own, math.acos((1 - math.cos(half)) / 2)),
        best=x == family.best,
    )


def _stated(family: DeadCentreFamily, scale: float, unit: str) -> dict[str, str]:
    """Return the purpose, a stroke or a swing and a time ratio, as the scene's file keeps it."""
    if family.kind == "slider-crank":
        return {"stroke": f"{round(scale, _DIGITS)!r} {unit}"}
    return {"swing": f"{round(math.degrees(family.swing), _DIGITS)!r} deg"}


def _slider_crank(lengths: list[float]) -> tuple[dict[str, float], dict[str, Any]]:
    """Return the parameters and tables of a slider-crank that goes forward slowly as its crank turns left."""
    crank, rod, off = lengths
    tables = {"slider-crank": {"crank": crank, "rod": rod, "offset": -off + 0.0}}
    return {"crank": crank, "rod": rod, "offset": -off + 0.0}, tables


def _crank_rocker(lengths: list[float]) -> tuple[dict[str, float], dict[str, Any]]:
    crank, coupler, rocker, ground = lengths
    parameters = {"ground": abs(ground), "crank": crank, "coupler": coupler, "rocker": rocker}
    return parameters, {"four-bar": {**parameters, "assembly": "open" if ground > 0 else "crossed"}}
