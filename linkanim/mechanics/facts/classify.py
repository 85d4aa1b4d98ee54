"""What kind of linkage it is, how far its input goes, and what a lecturer says of it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from linkanim.digits import degrees, short, significant
from linkanim.mechanics.closing.search import around, in_blocks, sign_changes
from linkanim.mechanics.facts.effort import Demand, demand, usual_effort
from linkanim.mechanics.facts.naming import (
    FourBar,
    class_name,
    four_bar_of,
    link_names,
    turning_bodies,
)
from linkanim.mechanics.facts.register import driven_body, input_symbol
from linkanim.mechanics.facts.transmission import Transmission, transmission
from linkanim.mechanics.formulas.program import Array
from linkanim.mechanics.linkage.pins import DrivenSlider
from linkanim.mechanics.motion.measures import output_body, output_slider
from linkanim.mechanics.motion.mechanism import Mechanism
from linkanim.mechanics.motion.motion import Motion
from linkanim.mechanics.motion.settled import said

SAME_ANGLE = 1e-9


@dataclass(frozen=True)
class Info:
    """What is known of a linkage; angles in radians, lengths in the scene's unit.

    Where a slider drives, its travel stands for the input's angle.

    Each fact is worked out when it is first read: a length that is dragged changes sixty times a second.
    """

    mechanism: Mechanism
    length_unit: str

    @cached_property
    def class_name(self) -> str:
        """The class, in words."""
        return class_name(self.mechanism, self._four_bar)

    @cached_property
    def grashof(self) -> str | None:
        """Grashof's rule with the four-bar's numbers; None for other linkages."""
        if (bar := self._four_bar) is None:
            return None
        s, p, q, longest = sorted(bar.links.values())
        relation = "=" if bar.change_points else "<" if bar.margin > 0 else ">"
        return f"s + l = {significant(s + longest, 6)} {relation} p + q = {significant(p + q, 6)}"

    @property
    def why_swinging(self) -> str | None:
        """What keeps the input from turning fully, lengths or joints; None where nothing does."""
        stops = tuple(dict.fromkeys(filter(None, self.mechanism.assembly.path.ends)))
        if not stops:
            return None
        if self._four_bar is None or stops != (self._four_bar.joint,):
            return f"{' and '.join(stops)} cannot close all the way round"
        if self._four_bar.margin < 0:
            return self.grashof
        return f"{self.grashof}, but the shortest is the {self._four_bar.shortest}"

    @property
    def input_range(self) -> tuple[float, float]:
        """How far the driven angle, or the travel of a slider that drives, goes."""
        return self.mechanism.assembly.path.input_range

    @cached_property
    def ends(self) -> tuple[float, float]:
        """Where an input that does not turn fully turns back: at phase 0, and half a period on."""
        first, last = self.mechanism.assembly.path.coordinates(np.array([0.0, math.pi])).tolist()
        return first, last

    @property
    def full_turn(self) -> bool:
        """Whether the input turns fully."""
        return self.mechanism.assembly.path.full_turn

    @property
    def unreached_start(self) -> float | None:
        """The start that is stated, where the input swings and does not come to it; else None."""
        start, path = self.mechanism.linkage.drive.stated_start, self.mechanism.assembly.path
        return None if start is None or self.full_turn or path.holds(start) else start

    @property
    def toggles(self) -> tuple[float, ...]:
        """The input's limits; an end at which it merely turns back is none."""
        path, touched = self.mechanism.assembly.path, tuple(self.mechanism.assembly.change_points)
        ends = (end for end in path.dead_ends if any(path.same(place, end) for place in touched))
        return (*path.limits, *ends)

    @cached_property
    def change_points(self) -> tuple[float, ...]:
        """The input's places at its change points, angles within one turn, each once, the least first."""
        path, touched = self.mechanism.assembly.path, self.mechanism.assembly.change_points
        return path.distinct(
            place for place in touched if not any(path.same(place, end) for end in path.dead_ends)
        )

    @property
    def circuits(self) -> int | None:
        """How many separate motions the lengths allow, two for Grashof; None for more than one four-bar."""
        if self._four_bar is None or len(self.mechanism.assembly.loops) != 1:
            return None
        return 2 if self._four_bar.margin > 0 else 1

    @property
    def true_period(self) -> int:
        """The drive periods after which every joint is back."""
        return self.mechanism.periods

    @property
    def period_seconds(self) -> float:
        """The true period at the drive's speed, s."""
        return 2 * math.pi * self.mechanism.periods / abs(self.mechanism.linkage.drive.speed)

    @cached_property
    def transmission(self) -> Transmission | None:
        """The worst transmission angle, where it is, and the best; None where there is none."""
        return transmission(self.mechanism)

    @property
    def transmission_angle(self) -> tuple[float, float] | None:
        """The least and the greatest transmission angle, 90° at the most; None where there is none."""
        return self.transmission and self.transmission[:2]

    @property
    def stroke(self) -> float | None:
        """The output slider's stroke; None without a slider."""
        return self._slider.stroke if self._slider else None

    @property
    def time_ratio(self) -> float | None:
        """The output's slow way's time over its quick way's; None where that is no slider and no rocker."""
        found = self.swing or self._slider
        return found.time_ratio if found else None

    @property
    def output_name(self) -> str:
        """What the output is called; empty without one."""
        body = output_body(self.mechanism.linkage)
        return self.link_names[body.name] if body else ""

    @property
    def dead_centres(self) -> tuple[float, float] | None:
        """Phases of the output slider's dead centres, back and then forward; None where it rests."""
        return self._slider.dead_centres if self._slider else None

    @cached_property
    def counts(self) -> Counts:
        """How many links, the ground among them, and joints there are, and the mobility by Grübler.

        A crank or a driven slider is a link and a joint, a dyad or a driving cylinder are two and three.
        """
        linkage = self.mechanism.linkage
        inputs = len(tuple(linkage.cranks)) + isinstance(linkage.joint(linkage.drive.joint), DrivenSlider)
        pairs = sum(joint.dyad for joint in linkage.joints) + (linkage.drive.actuator.along is not None)
        links, joints = 1 + inputs + 2 * pairs, inputs + 3 * pairs
        meshes = sum(crank.gear is not None for crank in linkage.cranks)
        return Counts(links, joints, 3 * (links - 1) - 2 * joints - meshes)

    @cached_property
    def swing(self) -> _ToAndFro | None:
        """How far the output rocker swings (rad), and its time ratio; None where it does not."""
        body = output_body(self.mechanism.linkage)
        if body is None or body.slider is not None or body.name in self.turning_links:
            return None
        found = _to_and_fro(self.mechanism, body.name, "angle", "angular_velocity")
        return found if found.stroke else None

    @cached_property
    def demand(self) -> Demand | None:
        """What a true period at the drive's speed asks of the input; None where nothing has force or mass."""
        if not self.mechanism.linkage.forceful:
            return None
        return demand(self._driven, self.mechanism.phases)

    @cached_property
    def usual_effort(self) -> float | None:
        """The size that the effort at the input has half of the time; None where `demand` is."""
        if not self.mechanism.linkage.forceful:
            return None
        return usual_effort(self._driven, self.mechanism.phases)

    def _driven(self, phases: Array) -> Motion:
        """Return the motion at the drive's speed."""
        return self.mechanism.solve(phase=phases, speed=self.mechanism.linkage.drive.speed)

    @property
    def effort(self) -> tuple[str, str]:
        """What the input delivers, torque or force, and its unit."""
        return self.mechanism.linkage.drive.actuator.effort

    @cached_property
    def turning_links(self) -> tuple[str, ...]:
        """The bodies that turn fully over one true period."""
        return turning_bodies(self.mechanism)

    @cached_property
    def link_names(self) -> Mapping[str, str]:
        """What each body is called by what it does, by the name that it has in the scene."""
        return link_names(self.mechanism, self.turning_links)

    @cached_property
    def input_name(self) -> str:
        """What the driven bar is called: "crank" if it turns, the slider where one drives.

        One that swings goes by its name in the scene; named crank it is the rocker, or the input rocker.
        """
        body, noun = driven_body(self.mechanism.linkage), self.mechanism.linkage.drive.actuator.noun
        if noun is not None:
            return noun
        if self.full_turn:
            return "crank"
        return self.link_names[body.name] if body and not body.name.isdecimal() else "rocker"

    @property
    def input_words(self) -> str:
        """How far the input goes, in words."""
        moves = self.mechanism.linkage.drive.actuator.moves
        return "turns fully" if self.full_turn else f"{moves} {_places(self, self.input_range, '…')}"

    @cached_property
    def lines(self) -> tuple[tuple[str, str], ...]:
        """Label and value of each fact, in words."""
        return tuple((label, value) for label, value in _facts(self) if value)

    @cached_property
    def _four_bar(self) -> FourBar | None:
        return four_bar_of(self.mechanism)

    @cached_property
    def _slider(self) -> _ToAndFro | None:
        slider = output_slider(self.mechanism.linkage)
        return _to_and_fro(self.mechanism, slider.name, "travel", "travel_velocity") if slider else None


class Counts(NamedTuple):
    """Links, the ground among them, joints of two links each, M = 3 (links - 1) - 2 joints - gear meshes."""

    links: int
    joints: int
    mobility: int


class _ToAndFro(NamedTuple):
    """How a slider or rocker goes to and fro: its time ratio and the phases of its dead centres.

    Both are None where it rests.
    """

    stroke: float
    time_ratio: float | None
    dead_centres: tuple[float, float] | None


def _to_and_fro(mechanism: Mechanism, name: str, place: str, rate: str) -> _ToAndFro:
    """Return how a body goes to and fro; its time ratio is the slow way's over the quick way's.

    In a longer true period it goes so more than once: each way ends at the next dead centre.
    """
    whole = 2 * math.pi * mechanism.periods
    samples = around(mechanism.periods, mechanism.assembly.samples)
    if _rests(mechanism, name, rate, samples):
        return _ToAndFro(0.0, None, None)
    reversals = sign_changes(
        lambda phase: getattr(mechanism.solve(phase=phase, speed=1.0, derivatives=1), rate)[name], samples
    )
    # Among the samples, along which an angle is continuous.
    order = np.argsort(np.concatenate((reversals, samples)))
    phases = np.concatenate((reversals, samples))[order]
    along = getattr(mechanism.solve(phase=phases, speed=1.0, derivatives=0), place)[name]
    travel = along[np.argsort(order)[: len(reversals)]]
    if not len(travel):
        return _ToAndFro(0.0, None, None)
    span = float(np.ptp(travel))
    near = SAME_ANGLE * span
    backs, forwards = (reversals[np.abs(travel - end) <= near] for end in (travel.min(), travel.max()))
    forth = (forwards - backs[:, None]) % whole
    row, column = np.unravel_index(int(forth.argmin()), forth.shape)
    ways = float(forth.min()), float(((backs - forwards[:, None]) % whole).min())
    return _ToAndFro(span, max(ways) / min(ways), (float(backs[row]), float(forwards[column])))


def _rests(mechanism: Mechanism, name: str, rate: str, phases: Array) -> bool:
    """Return whether a body stands still all along, rounding errors aside."""
    for part in in_blocks(phases):
        motion = mechanism.solve(phase=part, speed=1.0, derivatives=1)
        unit = "{}/s" if rate.startswith("travel") else "rad/s"
        if np.any(said(motion, getattr(motion, rate)[name], unit, 1)):
            return False
    return True


def _facts(info: Info) -> Iterator[tuple[str, str | None]]:
    """Yield label and value of each fact, in words; None where there is none."""
    links, joints, mobility = info.counts
    turning = (info.link_names[name] for name in info.turning_links)
    yield "class", info.class_name
    yield "links, joints", f"{links}, {joints}; mobility {mobility}"
    yield "Grashof", info.grashof
    yield "input", info.input_words
    start = info.unreached_start
    yield "start", None if start is None else f"{degrees(start)} is not reached"
    kept = "on the same closure; velocities change sign at the limits"
    yield "returns", kept if info.mechanism.retraced else None
    yield "turns fully", ", ".join(f"link {name}" if name.isdecimal() else name for name in turning)
    yield "toggles at", _places(info, info.toggles)
    yield "change points", _places(info, info.change_points)
    yield "circuits", str(info.circuits or "")
    yield "transmission angle", info.transmission and _worst(info, info.transmission)
    yield "stroke", None if info.stroke is None else f"{significant(info.stroke, 6)} {info.length_unit}"
    yield "swing", info.swing and f"{degrees(info.swing.stroke)} of the {info.output_name}"
    yield "time ratio", None if info.time_ratio is None else f"{info.time_ratio:.4f}"
    if info.demand is not None:
        (work, *efforts), (name, unit) = info.demand, info.effort
        yield "work per period", f"{significant(work, 6)} J"
        unknown = ("unbounded", f"undefined, since the {name} is unbounded at a limit")
        for word, value, without in zip(("peak", "mean"), efforts, unknown, strict=True):
            yield f"{word} {name}", without if value is None else f"{significant(value, 6)} {unit}"
    turns = "one drive period" if info.true_period == 1 else f"{info.true_period} drive periods"
    yield "true period", f"{turns}, {short(info.period_seconds)} s"


def _worst(info: Info, found: Transmission) -> str:
    """Return the least transmission angle in words, its dyad and where the input is then."""
    least = f"{significant(math.degrees(found.least), 3)}° at {found.dyad}"
    if found.greatest - found.least <= SAME_ANGLE:
        return f"μ = {least}, all the way"
    linkage = info.mechanism.linkage
    place = float(info.mechanism.solve(phase=found.phase, speed=1.0, derivatives=0).coordinate)
    if not linkage.drive.coordinate.is_angle:
        where = f"{significant(place, 4)} {info.length_unit}"
    else:
        turned = round(math.degrees(place), 1) % 360 if info.full_turn else math.degrees(place)
        told = significant(turned, 3)
        where = "0°" if info.full_turn and told == "360" else f"{told}°"
    symbol = input_symbol(linkage).translate({ord("{"): None, ord("}"): None})
    return f"μ ≥ {least}, {symbol} = {where}"


def _places(info: Info, places: tuple[float, ...], between: str = ", ") -> str:
    """Return places of the input in words: its angles, or how far a slider has travelled; "" for none."""
    if info.mechanism.linkage.drive.coordinate.is_angle:
        return between.join(map(degrees, places))
    return f"{between.join(significant(place, 6) for place in places)} {info.length_unit}" if places else ""
