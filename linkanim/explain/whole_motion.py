"""Work out the whole motion by hand: how far the input goes, and where the output turns back.

Its parts, in reading order:

- How far the input goes: whether the bars of each dyad reach over the whole motion.
- Dead centres and time ratio: where the output turns back, how far it goes, and how long each way takes.

What has a closed form is derived: four-bars and slider-cranks on the driven crank. For other dyads the
lengths give the bounds, and a search over the motion gives how near it comes to them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np

from linkanim.explain.formula import (
    TWO,
    Formula,
    Symbol,
    arccos,
    arcsin,
    number,
    sqrt,
    square,
)
from linkanim.explain.joints import KINDS, Reach
from linkanim.explain.steps import (
    ANGLE,
    LENGTH,
    RATIO,
    Chapter,
    Given,
    Item,
    Powers,
    Step,
    Work,
    marked,
    rounded,
)
from linkanim.mechanics.analysis import FourBar, four_bar_of
from linkanim.mechanics.linkage import RRP, RRR, Body, Crank, Joint
from linkanim.mechanics.measures import output_body, output_slider
from linkanim.mechanics.quantities import called
from linkanim.mechanics.search import highest
from linkanim.scenes.scene import Scene
from linkanim.units import significant
from linkanim.words import said, sentences, to_say

_STRAIGHT, _ROUND = number("180", in_degrees=True), number("360", in_degrees=True)
_TOUCHES = 1e-9
"""A share of the rod: a distance that is less off its bound reaches it."""
_NEAR = 1e-6
"""A share of the longest bar: an extreme that is less off a bound by search reaches it."""
_ONE = 1e-9
"""How near to 1 a cosine, or a sine, counts as 1."""
_ALIKE = 1e-4
"""The share below which two time ratios are the same."""
_DIGITS = 6
_ENDS = ("back", "front")
"""The ends of a swing or a stroke."""
_LEFT = to_say(
    "{joint} always lies to the left of the line from {pin} to {fixed}, so the crank's angles at the two "
    "dead centres are:"
)
_RIGHT = to_say(
    "{joint} always lies to the right of the line from {pin} to {fixed}, so the crank's angles at the two "
    "dead centres are:"
)
_AT_END = {
    "input": {"back": to_say("input at its back end"), "front": to_say("input at its front end")},
    "phase": {"back": to_say("phase at its back end"), "front": to_say("phase at its front end")},
    "travel": {"back": to_say("travel at its back end"), "front": to_say("travel at its front end")},
    "angle": {"back": to_say("angle at its back end"), "front": to_say("angle at its front end")},
}
_IN_LINE = {
    "stretched": (
        to_say("With the bars stretched, the input can turn back at these two angles."),
        to_say(
            "The cosine is {cosine}: with the bars stretched, all four links lie in one line, a change point."
        ),
        to_say("The cosine would be below −1: the bars are never stretched."),
    ),
    "folded": (
        to_say("With the bars folded, the input can turn back at these two angles."),
        to_say(
            "The cosine is {cosine}: with the bars folded, all four links lie in one line, a change point."
        ),
        to_say("The cosine would be above 1: the bars are never folded."),
    ),
}
"""What is said where the cosine is within its bounds, on them, and beyond."""


def whole_motion(scene: Scene, work: Work) -> tuple[Chapter, ...]:
    """Return the chapters on the whole motion; empty where no dyad has to close and no output turns back.

    `work` has the positions of a pose, whose symbols are used.
    """
    motion = _WholeMotion(scene, work)
    chapters = [
        Chapter(said("Range of the input"), tuple(motion.reach())),
        Chapter(said("Dead centres and time ratio"), tuple(motion.dead_centres())),
    ]
    return tuple(chapter for chapter in chapters if chapter.steps)


_Bars = tuple[tuple[str, str, str, str], tuple[Formula, Formula, Formula, Formula], Formula]
"""A four-bar on the driven crank: its joints, its links from the ground on, and the ground's angle."""
_SliderCrank = tuple[Formula, Formula, Formula, Formula]
"""Of a slider-crank on the driven crank: crank, rod, the pivot's distance to the guide's left, its angle."""


class _WholeMotion:
    """The chapters on the whole motion, while they are written."""

    def __init__(self, scene: Scene, work: Work) -> None:
        self.scene, self.work, self.info = scene, work, scene.info
        self.dyads = [joint for joint in scene.linkage.joints if joint.dyad]
        drive = scene.linkage.drive
        turned = drive.actuator.along is None and isinstance(scene.linkage.driven.joint, Crank)
        self.four_bar = four_bar_of(scene.mechanism) if turned else None
        self.cranked = turned

    def _step(self, title: str, write: Callable[[], object]) -> Step:
        return self.work.step(title, write, with_given=True)

    # How far the input goes: whether the bars of each dyad reach over the whole motion.

    def reach(self) -> Iterator[Step]:
        """Yield a step for each dyad that may fail to close, and the conclusion for the input."""
        steps = [
            self._step(said("Closure at {joint}", joint=marked(one.name)), partial(self._of, one))
            for one in self.dyads
        ]
        taken = [step for step in steps if step.items]
        yield from taken
        if taken or not self.info.full_turn:
            yield self.work.step("", partial(self._conclude, bool(taken)))

    def _conclude(self, closes: bool) -> None:
        goes = self.info.motion_said
        self.work.say(said("{found}.", found=goes) if closes else said("{found}, as is given.", found=goes))
        if self.info.grashof:
            known = {"sums": self.info.grashof, "class_name": self.info.class_said}
            self.work.say(said("Grashof: {sums}; class: {class_name}.", **known))

    def _of(self, joint: Joint) -> None:
        if self.four_bar is not None and joint.name == self.four_bar.joint:
            self._limits_of_bars(self._bars(self.four_bar))
        elif (bars := self._slider_crank(joint)) is not None:
            self._limits_of_slider(joint, bars)
        elif (reach := KINDS[type(joint)].reach) is not None:
            self._bounded(joint, reach)

    def _bars(self, four_bar: FourBar) -> _Bars:
        work, linkage = self.work, self.scene.linkage
        joint, pivot = linkage.joint(four_bar.joint), linkage.driven.pivot
        assert isinstance(joint, RRR)
        pin = linkage.drive.joint
        fixed = next(end for end in joint.ends if end != pin)
        names = (pivot, pin, joint.name, fixed)
        pairs = {"ground": (pivot, fixed), "input": (pivot, pin), "coupler": (pin, joint.name)}
        pairs["output"] = fixed, joint.name
        ground, crank, coupler, output = (
            work.known(Symbol("r", work.names.length(*ends)), four_bar.links[part], LENGTH)
            for part, ends in pairs.items()
        )
        ground_line = work.points[fixed] - work.points[pivot]
        level = ground_line.y.constant == 0 and ground_line.x.value > 0
        stated = work.given.get(Symbol("θ", work.names.length(pivot, fixed)))
        tilt = (
            number("0", in_degrees=True) if level else stated.value if stated else work.angle_of(pivot, fixed)
        )
        return names, (ground, crank, coupler, output), tilt

    def _limits_of_bars(self, bars: _Bars) -> None:
        """Add where coupler and output lie in one line, by the cosine rule with ground and crank."""
        work, ((pivot, pin, joint, fixed), (g, r, coupler, output), tilt) = self.work, bars
        if g.value * r.value == 0:
            work.say(
                said(
                    "In the digits shown {pin} is equally far from {fixed} at every crank angle: the "
                    "bars that meet at {joint} can be assembled at all of them or at none.",
                    pin=marked(pin),
                    fixed=marked(fixed),
                    joint=marked(joint),
                )
            )
            return
        work.say(
            said(
                "At a limit of the input the two bars that meet at {joint} lie in one line, "
                "stretched or folded, and the distance from {pin} to {fixed} is the sum or the "
                "difference of their lengths. With this distance the cosine rule in the triangle "
                "{pivot}, {pin}, {fixed} gives the crank's angle ψ from the ground line, and its "
                "cosine k:",
                joint=marked(joint),
                pin=marked(pin),
                fixed=marked(fixed),
                pivot=marked(pivot),
            )
        )
        for name, reach in (
            ("stretched", coupler + output),
            ("folded", coupler - output),
        ):
            index = name[0]
            turns, change, never = _IN_LINE[name]
            cosine = work.let(
                Symbol("k", index), (square(g) + square(r) - square(reach)) / (TWO * g * r), RATIO
            )
            if 1 - abs(cosine.value) > _ONE:
                corner = work.let(Symbol("ψ", index), arccos(cosine), ANGLE)
                for sign, angle in (("1", tilt + corner), ("2", tilt - corner)):
                    work.let(Symbol("θ", f"{index}{sign}"), angle, ANGLE)
                work.say(said(turns))
            elif abs(abs(cosine.value) - 1) <= _ONE:
                work.say(said(change, cosine=round(cosine.value)))
            else:
                work.say(said(never))

    def _slider_crank(self, joint: Joint) -> _SliderCrank | None:
        """Return the slider-crank that a joint closes on the driven crank; None where it closes none."""
        work, linkage = self.work, self.scene.linkage
        if not (isinstance(joint, RRP) and self.cranked and joint.end == linkage.drive.joint):
            return None
        if joint.line.on is not None or not linkage.joint(joint.line.through).fixed:
            return None
        pivot = linkage.driven.pivot
        crank = work.length(pivot, joint.end, dict(linkage.joint(joint.end).bars)[pivot])
        guide = work.guide(joint.line, joint.name)
        to_pivot, u = work.points[pivot] - work.points[guide.through], guide.direction
        beside = to_pivot.y * u.x - to_pivot.x * u.y - guide.offset
        return crank, work.length(joint.end, joint.name, joint.length), beside, guide.angle

    def _beside(self, joint: Joint, beside: Formula) -> Formula:
        """Add how far the pivot lies left of the guide, and return its symbol."""
        return self.work.let(Symbol("c", joint.name), beside, LENGTH)

    @staticmethod
    def _where_beside(beside: Formula) -> str:
        if beside.constant == 0:
            return said("The crank's pivot lies on the line of the guide.")
        return said("c is the distance of the crank's pivot from the guide, positive to its left.")

    def _limits_of_slider(self, joint: Joint, bars: _SliderCrank) -> None:
        """Add whether the rod reaches the guide from everywhere on the crank's circle."""
        work, end, (crank, rod, aside, guide) = self.work, self.scene.linkage.drive.joint, bars
        work.say(
            sentences(
                said(
                    "The rod reaches the guide as long as {end} is no farther from the guide than the "
                    "rod's length.",
                    end=marked(end),
                ),
                self._where_beside(aside),
                said("The greatest distance of {end} from the guide is:", end=marked(end)),
            )
        )
        beside = self._beside(joint, aside)
        farthest = work.let(Symbol("n", "max"), crank + (beside if beside.value >= 0 else -beside), LENGTH)
        if rod.value - farthest.value > _TOUCHES * rod.value:
            work.say(
                said(
                    "This is less than the rod's length, {rod} {unit}: the rod always reaches.",
                    rod=rod.shown,
                    unit=work.scale.unit,
                )
            )
            return
        if self.info.full_turn:
            work.say(
                said(
                    "This is the rod's length: where the rod is perpendicular to the guide there is a "
                    "change point."
                )
            )
            return
        work.say(
            said(
                "This is more than the rod's length: the input can turn back where the rod is "
                "perpendicular to it:"
            )
        )
        for index, reach in (("l", rod), ("r", -rod)):
            sine = (reach - beside) / crank
            if abs(sine.value) <= 1 - _ONE:
                corner = work.let(Symbol("ψ", index), arcsin(sine), ANGLE)
                for sign, angle in (("1", guide + corner), ("2", guide + _STRAIGHT - corner)):
                    work.let(Symbol("θ", f"{index}{sign}"), angle, ANGLE)

    def _bounded(self, joint: Joint, reach: Callable[[Any, Work], Reach | None]) -> None:
        """Add the bounds within which a dyad closes, and how near the motion comes to them."""
        if (reached := reach(joint, self.work)) is None:
            return
        distance, *bounds = reached

        def apart(phases: np.ndarray) -> np.ndarray:
            at = self.scene.solve(phase=phases, derivatives=0).position
            return distance({name: place[:, 0] + 1j * place[:, 1] for name, place in at.items()})

        self._say_bounds(joint.name, bounds, self._ends(apart))

    def _ends(self, function: Callable[[np.ndarray], np.ndarray]) -> tuple[float, float]:
        """Return the least and the greatest value over one true period."""
        mechanism = self.scene.mechanism
        places, step = mechanism.sampled, math.tau / mechanism.assembly.samples
        values = function(places)
        ends = []
        for sign in (-1, 1):
            at = float(places[np.nanargmax(sign * values)])
            best = highest(partial(_signed, function, sign), at, step)
            ends.append(float(function(np.array([best]))[0]))
        return ends[0], ends[1]

    def _say_bounds(self, joint: str, bounds: list[float], ends: tuple[float, float]) -> None:
        unit, least = self.work.scale.unit, _NEAR * self.scene.linkage.longest
        lowest, highest_ = bounds
        low, high = (significant(end, _DIGITS) for end in ends)
        runs = said(
            "Over the motion this distance lies between {low} {unit} and {high} {unit}",
            low=low,
            unit=unit,
            high=high,
        )
        if lowest <= 0:
            runs = said("Over the motion this distance is at most {high} {unit}", high=high, unit=unit)
        elif math.isinf(highest_):
            runs = said("Over the motion this distance is at least {low} {unit}", low=low, unit=unit)
        if ends[0] - lowest > least and highest_ - ends[1] > least:
            self.work.say(said("{found}, so it never comes to its bound.", found=runs))
        elif joint in self.scene.mechanism.stops:
            self.work.say(said("{found}. It comes to its bound where the input turns back.", found=runs))
        else:
            self.work.say(
                said(
                    "{found}. It comes to its bound at a change point, through which the motion continues.",
                    found=runs,
                )
            )

    # Dead centres and time ratio: where the output turns back, how far it goes, and how long each way takes.

    def dead_centres(self) -> Iterator[Step]:
        """Yield the step on the output's two dead centres; none where the output does not turn back."""
        slider, body = output_slider(self.scene.linkage), output_body(self.scene.linkage)
        if slider is not None and self.info.stroke:
            step = self._step(called(slider, self.info.link_names), partial(self._of_slider, slider))
        elif slider is None and body is not None and self.info.swing is not None:
            step = self._step(called(body, self.info.link_names), partial(self._of_rocker, body))
        else:
            return
        if step.items:
            yield step

    def _of_slider(self, slider: Body) -> None:
        joint = self.scene.linkage.joint(str(slider.slider))
        bars = self._slider_crank(joint) if self._steady and not self.info.change_points else None
        if bars is not None:
            self._dead_centres_of_slider(joint, bars)
        else:
            self._searched(slider, self.info.dead_centres, self.info.stroke or 0.0)

    def _of_rocker(self, body: Body) -> None:
        bars = self._bars(self.four_bar) if self.four_bar is not None else None
        if (
            bars is not None
            and self._steady
            and self._is_crank_rocker
            and set(bars[0][2:]) <= set(body.joints)
        ):
            self._dead_centres_of_rocker(bars)
        elif self.info.swing is not None:
            self._searched(body, self.info.swing.dead_centres, self.info.swing.stroke)

    @property
    def _steady(self) -> bool:
        """Whether the crank turns fully once in a true period, so that angles of the crank are times."""
        return self.info.full_turn and self.info.true_period == 1

    @property
    def _is_crank_rocker(self) -> bool:
        bar = self.four_bar
        return bar is not None and bar.margin > 0 and bar.shortest == "input" and not bar.change_points

    def _dead_centres_of_slider(self, joint: Joint, bars: _SliderCrank) -> None:
        """Add stroke and time ratio of a slider-crank whose crank turns fully."""
        work, (crank, rod, aside, _) = self.work, bars
        work.say(
            sentences(
                said("The slider turns back where crank and rod lie in one line, stretched and folded."),
                self._where_beside(aside),
                said(
                    "Its two extreme positions s, the stroke H, and the angles λ of crank and rod to the "
                    "guide there:"
                ),
            )
        )
        beside = self._beside(joint, aside)
        square_ = square(beside)
        ends = [
            work.let(Symbol("s", index), sqrt(square(reach) - square_), LENGTH)
            for index, reach in (("max", rod + crank), ("min", rod - crank))
        ]
        work.let(Symbol("H"), ends[0] - ends[1], LENGTH)
        away = beside if beside.value >= 0 else -beside
        leans = [
            work.let(Symbol("λ", index), arcsin(away / reach), ANGLE)
            for index, reach in (("1", rod + crank), ("2", rod - crank))
        ]
        self._ratio(_STRAIGHT + leans[1] - leans[0])

    def _dead_centres_of_rocker(self, bars: _Bars) -> None:
        """Add swing and time ratio of a crank-rocker."""
        work, ((pivot, pin, joint, fixed), (g, crank, coupler, r), tilt) = self.work, bars
        work.say(
            said(
                "The rocker turns back where crank and coupler lie in one line, stretched and "
                "folded: the distance ℓ from {pivot} to {joint} is then the sum or the difference of "
                "their lengths. The cosine rule in the triangle {pivot}, {joint}, {fixed} gives its "
                "angles β at {pivot} and ψ at {fixed}:",
                pivot=marked(pivot),
                joint=marked(joint),
                fixed=marked(fixed),
            )
        )
        at_pivot, at_fixed = [], []
        for index, reach in (("1", coupler + crank), ("2", coupler - crank)):
            long = work.let(Symbol("ℓ", index), reach, LENGTH)
            at_pivot.append(
                work.let(
                    Symbol("β", index),
                    arccos((square(g) + square(long) - square(r)) / (TWO * g * long)),
                    ANGLE,
                )
            )
            at_fixed.append(
                work.let(
                    Symbol("ψ", index), arccos((square(g) + square(r) - square(long)) / (TWO * g * r)), ANGLE
                )
            )
        places = self.work.pose.position
        corners = [complex(*places[name]) for name in (pin, fixed, joint)]
        is_left = ((corners[1] - corners[0]).conjugate() * (corners[2] - corners[0])).imag > 0
        work.say(
            said(
                _LEFT if is_left else _RIGHT,
                joint=marked(joint),
                pin=marked(pin),
                fixed=marked(fixed),
            )
        )
        turned = [angle if is_left else -angle for angle in at_pivot]
        work.let(Symbol("θ", "stretched"), tilt + turned[0], ANGLE)
        work.let(Symbol("θ", "folded"), tilt + _STRAIGHT + turned[1], ANGLE)
        work.say(
            said("The swing of the rocker, the crank's angle during the slow stroke, and the time ratio:")
        )
        work.let(Symbol("ψ", "swing"), at_fixed[0] - at_fixed[1], ANGLE)
        lean = at_pivot[0] - at_pivot[1]
        self._ratio(_STRAIGHT + (lean if lean.value >= 0 else at_pivot[1] - at_pivot[0]))

    def _searched(self, body: Body, phases: tuple[float, float] | None, stroke: float) -> None:
        """Add what follows from dead centres that are found by search, where no closed form gives them."""
        if phases is None:
            return
        work, scene, sliding = self.work, self.scene, body.slider is not None
        work.say(
            said("It turns back where its velocity is zero, found here by numerical search:")
            if sliding
            else said("It turns back where its angular velocity is zero, found here by numerical search:")
        )
        motion = scene.solve(phase=np.array(phases), derivatives=0)
        # the first angle is given within one turn, the second by the swing from there
        first = (
            float(motion.travel[body.name][0])
            if sliding
            else float(scene.pose(phases[0], 0).angle[body.name])
        )
        first = first if sliding else math.remainder(first, math.tau)
        measure, letter, of = (LENGTH, "s", "travel") if sliding else (ANGLE, "ψ", "angle")
        by_angle = self._steady and scene.linkage.drive.coordinate.is_angle
        inputs = motion.coordinate if by_angle else phases
        places = [
            self._numeric(
                Symbol("θ" if by_angle else "φ", end),
                float(at) % math.tau,
                ANGLE,
                said(_AT_END["input" if by_angle else "phase"][end]),
            )
            for at, end in zip(inputs, _ENDS, strict=True)
        ]
        ends = [
            self._numeric(Symbol(letter, end), value, measure, said(_AT_END[of][end]))
            for end, value in zip(_ENDS, (first, first + stroke), strict=True)
        ]
        work.let(Symbol("H") if sliding else Symbol("ψ", "swing"), ends[1] - ends[0], measure)
        forth = places[1] - places[0]
        forth = forth if forth.value >= 0 else forth + _ROUND
        slow = forth if forth.value >= _STRAIGHT.value else _ROUND - forth
        ratio, quick = self.info.time_ratio or 0.0, _ROUND.value - slow.value
        if self.info.true_period == 1 and math.isclose(ratio * quick, slow.value, rel_tol=_ALIKE):
            self._ratio(slow)
        elif self.info.true_period > 1:
            work.say(
                said(
                    "The motion repeats after {true_period} periods of the input. The slow stroke takes "
                    "{ratio} times as long as the quick one.",
                    true_period=self.info.true_period,
                    ratio=f"{ratio:.4f}",
                )
            )
        elif quick < _ALIKE * _ROUND.value:
            work.say(
                said(
                    "The quick stroke is too short for the digits shown; the slow one takes {ratio} "
                    "times as long.",
                    ratio=f"{ratio:.4g}",
                )
            )
        else:
            work.say(
                said(
                    "It comes to one of them more than once before the motion repeats. From one to the "
                    "next the slow stroke takes {ratio} times as long as the quick one.",
                    ratio=f"{ratio:.4f}",
                )
            )

    def _numeric(self, symbol: Symbol, value: float, measure: Powers, words: str) -> Formula:
        """Add a number found by search as a symbol's value, and return it."""
        shown = rounded(math.degrees(value) if measure.angle else value, self.work.scale.decimals(measure))
        leaf = Formula("leaf", symbol=symbol, shown=shown, in_degrees=measure.angle)
        self.work.items.append(Given(leaf, self.work.scale.unit_of(measure), words))
        return leaf

    def _ratio(self, slow: Formula) -> None:
        """Add the angle of the slow way, and how much longer it takes than the quick one."""
        slow_angle = self.work.let(Symbol("θ", "slow"), slow, ANGLE)
        self.work.let(Symbol("T", "R"), slow_angle / (_ROUND - slow_angle), RATIO)


def is_searched(item: Item) -> bool:
    """Return whether an item is a number found by search: an end of a swing or a stroke."""
    return isinstance(item, Given) and item.value.symbol is not None and item.value.symbol.sub in _ENDS


def _signed(function: Callable[[np.ndarray], np.ndarray], sign: int, places: np.ndarray) -> np.ndarray:
    return sign * function(places)
