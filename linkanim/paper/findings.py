"""Collect what a report says of a scene: facts, tables at chosen instants, and which charts it shows.

The tables are those of links, sliders, joints, centres of mass and struts. The charts are in the order in
which a report on a mechanism goes.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from itertools import chain
from math import degrees, isinf, isnan, nan, pi, remainder, tau
from typing import NamedTuple

import numpy as np

from linkanim.errors import OutOfRange
from linkanim.mechanics.analysis import reversals
from linkanim.mechanics.forces import effort_token
from linkanim.mechanics.linkage import Linkage
from linkanim.mechanics.measures import TRAVELLING, TURNING, coefficients_of, output_body, output_slider
from linkanim.mechanics.quantities import Quantity, bodies_in_chain, called, input_symbol, phrase
from linkanim.mechanics.reactions import GROUND
from linkanim.paper.curves import SAMPLES, Pace, curves_of, extremes
from linkanim.scenes.scene import Scene
from linkanim.units import rounded
from linkanim.words import row_said, said, said_as, to_say

# What a report says of a scene: its facts, its quantities at chosen angles, and which charts it shows.

_SAMPLES = 180
_BESIDE = tau / SAMPLES
"""The most that the zero of a rate is off the extreme that is read off a curve, in radians of phase."""
_SAME = 1e-9
"""Radians of phase below which two instants are the same."""


class Instant(NamedTuple):
    """A phase that the report looks at, and why."""

    phase: float
    words: str = ""

    def place(self, scene: Scene) -> str:
        """Return where the input is, and why that is looked at: θ₂ = 0.00° (start)."""
        symbol, angle = input_symbol(scene.linkage), scene.pose(self.phase, 0).coordinate
        turned = angle % tau if scene.info.full_turn else angle
        place = f"{symbol} = {scene.linkage.drive.coordinate.text(turned, scene.length_unit, 0.01)}"
        return said("{place} ({words})", place=place, words=self.words) if self.words else place


Sheet = Mapping[str, Sequence[tuple[Quantity, Sequence[str]]]]
"""Quantities with their values at each speed, under the heading of their part."""


def instants_at(scene: Scene, angles: tuple[float, ...]) -> tuple[Instant, ...]:
    """Return the instants at angles of the input (rad); OutOfRange for an angle that it does not reach."""
    mechanism = scene.mechanism
    if angles:
        scene.linkage.drive.check_angle(scene.name, "leave --angles out")
    for angle in angles:
        if not mechanism.comes_to(angle):
            raise OutOfRange(
                f"{scene.name}: --angles {_in_degrees(angle)} cannot be reached; "
                f"the {scene.info.input_name} angle goes {scene.info.ranges('from {} to {}', _in_degrees)}"
            )
    return tuple(Instant(mechanism.phase_of(angle, 0.0)) for angle in angles)


def _in_degrees(angle: float) -> str:
    return f"{degrees(angle):.6g} deg"


def usual_instants(scene: Scene) -> tuple[Instant, ...]:
    """Return the start, and where the output is furthest either way, if it turns back at all.

    For an input that swings, half-way takes the place of the start, at which it rests.
    """
    full = scene.info.full_turn
    instants = [Instant(0.0, said("start")) if full else Instant(pi / 2, said("half-way"))]
    output = output_slider(scene.linkage) or output_body(scene.linkage)
    if output and (output.slider or output.name not in scene.info.turning_links):
        coordinate, rate = ("travel", "travel_velocity") if output.slider else ("angle", "angular_velocity")
        pace = Pace(abs(scene.linkage.drive.speed), "")
        curve = curves_of(scene, (f"{output.name}.{coordinate}",), (pace,), "phase").curves[0]
        for peak, words in zip(extremes(scene, curve), _EXTREMES[coordinate], strict=False):
            phase = _at_rest(scene, (rate, output.name), float(np.radians(peak.x)))
            instants.append(Instant(phase, said(words, link=phrase(output, scene.info.link_names))))
    return tuple(_together(instants, scene.period))


_EXTREMES = {
    "travel": (to_say("greatest travel of {link}"), to_say("least travel of {link}")),
    "angle": (to_say("greatest angle of {link}"), to_say("least angle of {link}")),
}


def _together(instants: list[Instant], period: float) -> Iterator[Instant]:
    """Yield instants; those at the phase of the first are merged with it."""
    start, *others = instants
    same = [one for one in others if abs(remainder(one.phase - start.phase, period)) < _SAME]
    yield start._replace(words=said_as("list", ", ").join(one.words for one in (start, *same)))
    yield from (one for one in others if one not in same)


def _at_rest(scene: Scene, rate: tuple[str, str], near: float) -> float:
    """Return the phase (rad) next to an extreme at which its rate is zero; `near` where there is none.

    `rate` is a rate's name in a motion, and the part that has it.
    """
    kind, part = rate
    rests = reversals(scene.mechanism, part, kind, near + _BESIDE * np.array([-1.0, 1.0]))
    return float(rests[0]) if len(rests) else near


class Values:
    """Quantities at an instant, and whether they change over the cycle."""

    def __init__(self, scene: Scene) -> None:
        self.scene, self._cycle = scene, scene.cycle(scene.mechanism.count(_SAMPLES))
        # one motion serves every quantity
        self._motion = cache(lambda phase, pace: pace.motion(scene, phase))

    def of(self, quantity: Quantity, instant: Instant, pace: Pace) -> float:
        """Return the value of a quantity in the unit that is shown (degrees), NaN where it has none."""
        return float(quantity.displayed(self._motion(instant.phase, pace)))

    def changes(self, quantity: Quantity) -> bool:
        """Return whether a quantity has more than one value over the cycle, rounding errors aside."""
        return quantity.changes(self._cycle)


def sheet(values: Values, instant: Instant, paces: tuple[Pace, ...], digits: int) -> Sheet:
    """Return every quantity of a scene at one instant, at each speed, under the heading of its part.

    A vector is given by its components, which have tokens of their own.
    """
    sections: dict[str, list[tuple[Quantity, list[str]]]] = {}
    for quantity in values.scene.quantities.values():
        rows = sections.setdefault(quantity.part or said("Whole mechanism"), [])
        if len(quantity.columns) == 1:
            rows.append((quantity, [rounded(values.of(quantity, instant, pace), digits) for pace in paces]))
    return sections


def charted(values: Values) -> Iterator[str]:
    """Yield the token of each quantity that has a chart: of those that change over the motion.

    They are those of bodies, springs and dampers, centres of mass, traced joints and the whole mechanism; the
    other joints are in the tables, and so are forces, of which those on the ground are charted by their size.
    A vector is charted by its components, and a velocity and an acceleration by its size, too.
    """
    scene = values.scene
    joints = {joint.name for joint in scene.linkage.joints} - set(scene.trace)
    bodies = {body.name for body in scene.linkage.bodies}
    for token, quantity in scene.quantities.items():
        owner, _, rest = token.partition(".")
        in_tables = owner in joints - bodies or rest.startswith("pole")
        in_tables |= ".force" in rest and (owner != GROUND or rest.endswith((".x", ".y")))
        if not in_tables and rest not in ("position", "com_position") and values.changes(quantity):
            yield token


def paces_of(scene: Scene, token: str, paces: tuple[Pace, ...]) -> tuple[Pace, ...]:
    """Return the speeds at which a quantity is charted: one where the speed makes no difference."""
    return paces if scene.quantities[token].order else paces[:1]


def table(scene: Scene, pace: Pace) -> tuple[list[str], np.ndarray]:
    """Return the names and columns of every quantity over one true period: phase, angle, time, then all.

    A row for each degree of phase. Angles in radians, lengths in the scene's unit, time in seconds from the
    start of the drive.
    """
    count = round(degrees(scene.period))
    motion = pace.motion(scene, np.arange(count + 1) * (scene.period / count))
    names = ["phase", scene.linkage.drive.coordinate.name, "time"]
    columns = [motion.phase, motion.coordinate, motion.phase / abs(pace.speed)]
    for token, quantity in scene.quantities.items():
        if len(quantity.columns) == 1:
            names.append(token)
            columns.append(np.asarray(quantity.read(motion), float))
    return names, np.array(columns)


# The tables of a hand-out: links, sliders, joints, centres of mass and struts at chosen instants.

_MOST_SPEEDS = 4
"""The most speeds side by side in a table; a further table has the rest."""
_MOST_JOINTS = 10
"""The most joints in a table: traced ones first. The table of every quantity has them all."""

_POINT = {"position.x": "x", "position.y": "y", "velocity": "v", "acceleration": "a"}
_CENTRE = {f"com_{name}": symbol for name, symbol in _POINT.items()}
_PULL = {"force.x": "Fx", "force.y": "Fy", "force": "F"}
_GUIDE = {"guide_force": "N", "guide_moment": "M"}
_STRUT = {"length": "L", "direction": "θ", "rate": "v", "force": "F"}


_LINKS = to_say("angle θ, kinematic coefficients h and h′, angular velocity ω and acceleration α")
_SLIDERS = to_say("travel s, kinematic coefficients f and f′, velocity v and acceleration a")
_POINTS = to_say("place x, y, sizes of velocity v and acceleration a")
_PULLS = to_say("the force on each body: components Fx and Fy, size F")
_GUIDES = to_say("the force N to the left of the guide's line, the moment M about the joint")
_STRUTS = to_say("length L, direction θ, rate of length v and force F")


class Column(NamedTuple):
    """A column of numbers: its symbol and unit, the measure, and the speed that it is at, None for any."""

    symbol: str
    unit: str
    measure: str
    pace: Pace | None


class ValueTable(NamedTuple):
    """A table: its title, its content, its columns, and under each instant a row for each part."""

    title: str
    about: str
    head: str
    columns: tuple[Column, ...]
    groups: tuple[tuple[str, tuple[tuple[str, tuple[str, ...]], ...]], ...]
    notes: tuple[str, ...]


class Family(NamedTuple):
    """The subject of a table: title, content, what a row is called, its parts, symbols by measure."""

    title: str
    about: str
    head: str
    parts: tuple[tuple[str, str], ...]
    measures: dict[str, str]

    def columns(self, values: Values, paces: tuple[Pace, ...], *, first: bool) -> Iterator[Column]:
        """Yield the columns: a measure that is the same at every speed once, if `first`; others at each."""
        for measure, symbol in self.measures.items():
            quantities = [one for _, part in self.parts if (one := _quantity(values, part, measure))]
            if quantities:
                unit = quantities[0].display_unit(values.scene.length_unit)
                order = max(one.order for one in quantities)
                if order or first:
                    yield from (Column(symbol, unit, measure, pace) for pace in (paces if order else (None,)))

    def table(
        self, values: Values, columns: tuple[Column, ...], instants: tuple[Instant, ...], digits: int
    ) -> ValueTable:
        """Return the table of these columns, with all instants; of one part it has a row for each."""
        unbounded, unknown = [], False
        groups: list[tuple[str, tuple[tuple[str, tuple[str, ...]], ...]]] = []
        for instant in instants:
            values_of = {
                label: [_value(values, part, column, instant) for column in columns]
                for label, part in self.parts
            }
            if any(isinf(value) for row in values_of.values() for value in row):
                unbounded.append(Instant(instant.phase).place(values.scene))
            unknown |= any(isnan(value) for row in values_of.values() for value in row)
            rows = tuple(
                (label, tuple(rounded(one, digits) for one in row)) for label, row in values_of.items()
            )
            groups.append((instant.place(values.scene), rows))
        places = said_as("list", ", ").join(unbounded)
        notes = [said("∞: unbounded at {places}.", places=places)] if unbounded else []
        notes += [said("–: has no value there, or is not given.")] if unknown else []
        if len(self.parts) > 1:
            return ValueTable(self.title, self.about, self.head, columns, tuple(groups), tuple(notes))
        (title, _), *_ = self.parts
        alone = tuple((place, cells) for place, rows in groups for _, cells in rows)
        return ValueTable(title or self.title, self.about, said("at"), columns, (("", alone),), tuple(notes))


def value_tables(
    values: Values, instants: tuple[Instant, ...], paces: tuple[Pace, ...], digits: int
) -> Iterator[ValueTable]:
    """Yield the tables of a scene's values to `digits` significant digits, each with all instants."""
    for family in _families(values):
        for start in range(0, len(paces), _MOST_SPEEDS):
            some = paces[start : start + _MOST_SPEEDS]
            columns = tuple(family.columns(values, some, first=not start))
            if columns:
                yield family.table(values, columns, instants, digits)


def _families(values: Values) -> Iterator[Family]:
    linkage, scene = values.scene.linkage, values.scene
    names = scene.info.link_names
    turning = tuple((called(body, names), body.name) for body in linkage.bodies if not body.slider)
    sliding = tuple((called(body, names), body.name) for body in linkage.bodies if body.slider)
    massive = tuple((called(body, names), body.name) for body in linkage.bodies if body.com is not None)
    moving = [joint.name for joint in linkage.joints if not joint.fixed]
    moving.sort(key=lambda name: name not in scene.trace)
    kept = moving[:_MOST_JOINTS]
    in_order = tuple((joint.name, joint.name) for joint in linkage.joints if joint.name in kept)
    struts = tuple((strut.name, strut.name) for strut in linkage.springs + linkage.dampers)
    yield Family(said("Links"), said(_LINKS), said("link"), turning, _symbols(linkage, turning=True))
    yield Family(said("Sliders"), said(_SLIDERS), said("slider"), sliding, _symbols(linkage, turning=False))
    yield Family(said("Joints"), said(_POINTS), said("joint"), in_order, _POINT)
    yield Family(said("Centres of mass"), said(_POINTS), said("link"), massive, _CENTRE)
    yield Family(said("Springs and dampers"), said(_STRUTS), said("element"), struts, _STRUT)
    yield from _forces(scene, names)
    whole = {"transmission_angle": "μ", "mechanical_advantage": "MA", effort_token(linkage): "T"}
    symbols = {token: scene.quantities[token].symbol for token in whole if token in scene.quantities}
    measures = (scene.quantities[token].measure for token in symbols)
    about = said_as("list", ", ").join(measure[:1].lower() + measure[1:] for measure in measures)
    yield Family(said("The whole mechanism"), about, "", (("", ""),) if symbols else (), symbols)


def _forces(scene: Scene, names: Mapping[str, str]) -> Iterator[Family]:
    """Yield the tables of the forces in joints, and of those of guides."""
    words = {body.name: called(body, names) for body in scene.linkage.bodies}
    pulls, guides = [], []
    for token in scene.quantities:
        body, _, rest = token.partition(".")
        joint, _, kind = rest.partition(".")
        if kind == "force":
            on = said("{joint} on {link}", joint=joint, link=words.get(body, body))
            pulls.append((on, f"{body}.{joint}"))
        elif rest == "guide_force":
            guides.append((said("Guide on {link}", link=words.get(body, body)), body))
    yield Family(said("Forces in joints"), said(_PULLS), said("joint"), tuple(pulls), _PULL)
    yield Family(said("Forces of guides"), said(_GUIDES), said("slider"), tuple(guides), _GUIDE)


def _symbols(linkage: Linkage, *, turning: bool) -> dict[str, str]:
    """Return the symbols of the measures of bodies that turn, or slide; coefficients come second."""
    place, *rates = TURNING if turning else TRAVELLING
    return {one.name: one.symbol for one in (place, *coefficients_of(linkage, turning=turning), *rates)}


def _quantity(values: Values, part: str, measure: str) -> Quantity | None:
    return values.scene.quantities.get(f"{part}.{measure}" if part else measure)


def _value(values: Values, part: str, column: Column, instant: Instant) -> float:
    quantity = _quantity(values, part, column.measure)
    if quantity is None:
        return nan
    value = values.of(quantity, instant, column.pace or Pace(values.scene.linkage.drive.speed, ""))
    # an angle is told within one turn
    return value % 360 if quantity.unit == "rad" and quantity.order == 0 else value


# Which charts a hand-out has, in the order in which a report on a mechanism goes.

_MOST_CURVES = 6
"""On one chart."""
_SHORT_NAME = 2
"""The most letters of a name that stands behind a noun: link 3, slider C."""


Chart = tuple[tuple[str, ...], str]
"""A chart's quantities, and what it is called."""


def topics(values: Values, paces: tuple[Pace, ...]) -> dict[str, list[Chart]]:
    """Return the charts by topic; nothing of what does not change, no topic without a chart.

    At several speeds each quantity that they change has a chart of its own.
    """
    several = len(paces) > 1

    def of(*planned: tuple[str, list[str]]) -> Iterator[Chart]:
        for measure, parts in planned:
            yield from _charts(values, [f"{part}.{measure}" for part in parts], several=several)

    linkage = values.scene.linkage
    # a crank that is driven itself turns as the input does
    driven = linkage.drive.actuator.along is None
    cranks = {body.name for body in linkage.bodies if driven and linkage.crank_of(body)}
    turning = [body.name for body in bodies_in_chain(linkage) if body.name not in cranks]
    sliding = [body.name for body in linkage.bodies if body.slider]
    massive = [body.name for body in linkage.bodies if body.com is not None and body.name not in cranks]
    struts = [strut.name for strut in linkage.springs + linkage.dampers]
    traced = [] if several and turning else [*values.scene.trace]
    links, whole = [*turning, *sliding], _charts(values, ["transmission_angle"], several=several)
    effort = _charts(values, [effort_token(linkage)], several=several)
    rates = ("angular_{}", turning), ("travel_{}", sliding), ("{}", traced)
    velocities, accelerations = (
        [(form.format(rate), parts) for form, parts in rates] for rate in ("velocity", "acceleration")
    )
    positions = chain(of(("angle", turning), ("travel", sliding)), whole, of(("coefficient", links)))
    of_struts = of(("length", struts), ("rate", struts), ("force", struts))
    charts = {
        said("Positions"): positions,
        said("Velocities"): of(*velocities),
        said("Accelerations"): of(("second_coefficient", links), *accelerations),
        said("Centres of mass"): of(("com_velocity", massive), ("com_acceleration", massive)),
        said("Springs, dampers and input") if struts else said("Input"): chain(of_struts, effort),
    }
    return {title: some for title, planned in charts.items() if (some := [*planned])}


def _charts(values: Values, tokens: list[str], *, several: bool) -> Iterator[Chart]:
    """Yield one chart of the quantities that no speed changes, and one of each that it changes."""
    known = values.scene.quantities
    changing = [token for token in tokens if token in known and values.changes(known[token])]
    fixed = [token for token in changing if not (several and known[token].order)]
    apart = [token for token in changing if token not in fixed]
    for some in (fixed[:_MOST_CURVES], *([token] for token in apart[:_MOST_CURVES])):
        if some:
            yield tuple(some), _caption(values.scene, some)


def _caption(scene: Scene, tokens: list[str]) -> str:
    """Return what is charted of which parts: "Angular velocity of link 3, link 4"."""
    known = [scene.quantities[token] for token in tokens]
    if not known[0].part:
        return known[0].measure
    parts = [one.part for one in known]
    what = said_as("list", " and ").join(dict.fromkeys(one.measure for one in known))
    if parts == [said("Input")]:
        return said("Input {measure}", measure=what)
    form = to_say("{measure} of {parts}")
    if all(".com_" in token for token in tokens):
        links = (scene.linkage.body(token.partition(".")[0]) for token in tokens)
        parts = [called(link, scene.info.link_names) for link in links]
        form = to_say("{measure} of the centres of mass of {parts}")
        if len(parts) == 1:
            form = to_say("{measure} of the centre of mass of {parts}")
    caption = said(form, measure=what, parts=row_said([*map(_in_sentence, parts)]))
    return caption[:1].upper() + caption[1:]


def _in_sentence(part: str) -> str:
    """Return what a part is called within a sentence: link 3, slider C, the rocker, B."""
    if not part[1:2].islower():
        return part
    name = f"{part[:1].lower()}{part[1:]}"
    return name if len(name.rpartition(" ")[2]) <= _SHORT_NAME else said("the {name}", name=name)
