"""A linkage as data for the page's solver: its joints in the order in which they close, and their lengths."""

from __future__ import annotations

from math import ceil, cos, lcm, pi, sin
from typing import Any

from linkanim.mechanics.analysis import GRASHOF, TRIPLE_ROCKERS, four_bar_of
from linkanim.mechanics.linkage import RPP, RPR, RRP, RRR, Crank, Joint, Pin, Rigid
from linkanim.scenes.scene import Scene
from linkanim.words import said

LINKS = ("ground", "input", "coupler", "output")
_JUST_AFTER = 1e-3
"""The phase (rad) at which the side of a dyad is read off whose `side` refers to another joint."""
_SLOW = 4.0
"""A crank that turns no more than so many times as fast as the input is looked at in the usual steps."""
_LEAST, _MOST = 0.2, 2.0
"""The range of a bar's slider, in shares of the bar's length."""
_ASIDE = 0.5
"""The range to either side of sliders for offsets and points, as a share of the longest bar."""


def model(scene: Scene) -> dict[str, Any] | None:
    """Return the linkage with its lengths for the page's own solver; None where that cannot solve it.

    It cannot solve an input that is no crank, a line that a body carries, a true period of several turns, or
    a smooth path through a change point, along which no closure keeps its name.
    """
    linkage = scene.linkage
    if linkage.drive.actuator.along is not None or scene.info.change_points or scene.info.true_period != 1:
        return None
    model_of = _Model(scene)
    joints = [model_of.joint(joint) for joint in linkage.joints]
    if any(joint is None for joint in joints) or not model_of.shown:
        return None
    gears = scene.mechanism.assembly.gears
    bar = four_bar_of(scene.mechanism)
    single = bar is not None and sum(joint.dyad for joint in linkage.joints) == 1
    return {
        "joints": joints,
        "values": model_of.values,
        "sliders": model_of.shown,
        "drive": linkage.drive.joint,
        "ground": next(pin.name for pin in linkage.pins),
        "retraced": linkage.drive.retraced,
        "turns": lcm(*(gearing.ratio.denominator for gearing in gears.values())),
        "quickness": ceil(scene.mechanism.assembly.quickest / _SLOW),
        "start": linkage.drive.start,
        "stated": linkage.drive.stated_start,
        "level": _level(scene),
        "classes": {
            "grashof": [said("Grashof {kind}", kind=said(GRASHOF[part])) for part in LINKS],
            "rockers": [said("triple-rocker ({kind})", kind=said(TRIPLE_ROCKERS[part])) for part in LINKS],
            "change": [said("change-point {kind}", kind=said(GRASHOF[part])) for part in LINKS],
        },
        "fourBar": model_of.four_bar(bar.joint) if bar and single else None,
    }


def _level(scene: Scene) -> float:
    """Return the direction (rad) to whose left an input's range lies that is taken without a start."""
    linkage, loops = scene.linkage, scene.mechanism.assembly.loops
    first = next((name for name, loop in loops.items() if loop.pin == linkage.drive.joint), None)
    if first is None:
        return 0.0
    loop = loops[first]
    ends = {loop.crank.pivot, *linkage.joint(first).pins}
    pins = [pin.name for pin in linkage.pins if pin.name in ends]
    # where the ground runs from the pin that is stated later, the side above it is on its right
    back = loop.ground is not None and pins[0] != loop.crank.pivot
    return float(loop.root.reference) + (pi if back else 0.0)


class _Model:
    def __init__(self, scene: Scene) -> None:
        self.scene, self.linkage = scene, scene.linkage
        self.values: list[float] = []
        self.shown: list[dict[str, Any]] = []
        self._numbers: dict[tuple[str, str], int] = {}
        self._first: Pin | None = None
        self._longest = max(
            (abs(length) for joint in self.linkage.joints for _, length in joint.bars), default=1.0
        )

    def joint(self, joint: Joint) -> dict[str, Any] | None:
        """Return a joint with the numbers of its lengths; None for a kind that the solver does not know."""
        match joint:
            case Pin():
                return {"name": joint.name, **self._pin(joint)}
            case Crank():
                ratio, offset = self._gearing(joint)
                return {
                    "name": joint.name,
                    "kind": "crank",
                    "pivot": joint.pivot,
                    "r": self._bar(joint.pivot, joint),
                    "ratio": ratio,
                    "offset": offset,
                }
            case RRR():
                numbers = [self._bar(end, joint, n) for n, end in enumerate(joint.ends)]
                return {
                    "name": joint.name,
                    "kind": "bars",
                    "ends": joint.ends,
                    "r": numbers,
                    "side": self._side(joint),
                }
            case RRP() if joint.line.on is None:
                offset = self._aside(joint, said("offset of its line"), joint.line.offset)
                return {
                    "name": joint.name,
                    "kind": "slider",
                    "end": joint.end,
                    "r": self._bar(joint.end, joint),
                    "way": (cos(joint.line.angle), sin(joint.line.angle)),
                    "through": joint.line.through,
                    "offset": offset,
                    "side": joint.side,
                }
            case RPR():
                offset = self._aside(joint, said("offset of its slot"), joint.offset)
                return {
                    "name": joint.name,
                    "kind": "slot",
                    "pivot": joint.pivot,
                    "through": joint.through,
                    "r": self._bar(joint.pivot, joint),
                    "offset": offset,
                }
            case RPP() if joint.line.on is None:
                offset, angle = (
                    self._aside(joint, said("offset of its line"), joint.line.offset),
                    joint.line.angle,
                )
                return {
                    "name": joint.name,
                    "kind": "yoke",
                    "pin": joint.pin,
                    "way": (cos(angle), sin(angle)),
                    "slot": (cos(angle + joint.slot), sin(angle + joint.slot)),
                    "through": joint.line.through,
                    "offset": offset,
                }
            case Rigid():
                first = said("along {first}–{second}", first=joint.on[0], second=joint.on[1])
                numbers = [
                    self._aside(joint, first, joint.at[0]),
                    self._aside(joint, said("to its left"), joint.at[1]),
                ]
                return {"name": joint.name, "kind": "point", "on": joint.on, "r": numbers}
        return None

    def _pin(self, pin: Pin) -> dict[str, Any]:
        if self._first is None:
            self._first = pin
            return {"kind": "pin", "place": pin.position}
        way = complex(*pin.position) - complex(*self._first.position)
        if not way:
            return {"kind": "pin", "place": pin.position}
        number = self._number(
            f"{self._first.name}–{pin.name}",
            (self._first.name, pin.name),
            abs(way),
            (_LEAST * abs(way), _MOST * abs(way)),
        )
        self._numbers[self._first.name, pin.name] = number
        unit = way / abs(way)
        return {"kind": "pin", "base": self._first.name, "way": (unit.real, unit.imag), "r": number}

    def _gearing(self, crank: Crank) -> tuple[float, float]:
        """Return how a crank turns with the input: its angle is ratio·θ + offset."""
        if crank.gear is None:
            return 1.0, 0.0
        ratio, offset = self._gearing(self.linkage.crank(crank.gear.mate))
        own = float(crank.gear.ratio)
        return own * ratio, own * offset + crank.gear.offset

    def _bar(self, end: str, joint: Joint, which: int = 0) -> int:
        length = joint.bars[which][1]
        number = self._number(
            f"{end}–{joint.name}", (end, joint.name), length, (_LEAST * length, _MOST * length)
        )
        self._numbers[end, joint.name] = number
        return number

    def _aside(self, joint: Joint, label: str, value: float) -> int:
        reach = _ASIDE * self._longest
        label = said("{part}: {measure}", part=joint.name, measure=label)
        ends = min(-reach, value - reach), max(reach, value + reach)
        return self._number(label, (joint.name,), value, ends)

    def _number(self, label: str, at: tuple[str, ...], value: float, ends: tuple[float, float]) -> int:
        """Keep a length, that of a part at or between these joints, and return its number."""
        self.values.append(float(value))
        number = len(self.values) - 1
        self.shown.append({"label": label, "at": at, "number": number, "least": ends[0], "most": ends[1]})
        return number

    def _side(self, joint: RRR) -> int:
        """Return the side of its ends on which a joint lies, 1 left or -1: as stated, or as at the start."""
        if joint.side_of is None:
            return joint.side
        places = self.scene.pose(_JUST_AFTER, 0).position
        one, other, at = (complex(*places[name]) for name in (*joint.ends, joint.name))
        return 1 if ((other - one).conjugate() * (at - one)).imag >= 0 else -1

    def four_bar(self, name: str) -> list[int] | None:
        """Return the numbers of ground, input, coupler and output of a four-bar that closes in a joint."""
        joint = self.linkage.joint(name)
        assert isinstance(joint, RRR)
        pin = self.linkage.drive.joint
        pivot = self.linkage.crank(pin).pivot
        far = next(end for end in joint.ends if end != pin)
        ground = self._numbers.get((pivot, far), self._numbers.get((far, pivot)))
        if ground is None:
            return None
        return [ground, self._numbers[pivot, pin], self._numbers[pin, name], self._numbers[far, name]]
