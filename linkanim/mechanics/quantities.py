"""The register of quantities: what is known of a linkage, in which symbol, words and unit, under which key.

It puts the measures of each part together with what is known of the linkage as a whole; JSON, CSV, tables,
charts, their lists and refusals, the HUD and notebooks read from here.

Symbols are those of the textbooks; their subscripts are Unicode's digits (ω₃) or stand in braces (v_{B}).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from itertools import islice
from types import MappingProxyType
from typing import Any

import numpy as np

from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.mechanics.centres import pole
from linkanim.mechanics.forces import effort_token, input_effort
from linkanim.mechanics.linkage import Body, Damper, Linkage, Pin, Spring, holding
from linkanim.mechanics.measures import (
    CENTRE,
    CENTRE_PATH,
    CORIOLIS,
    DAMPER,
    PATH,
    POINT,
    SLIP,
    SPRING,
    TURNING,
    Measure,
    as_output,
    between,
    components,
    dyads_of,
    input_rate,
    measures_of,
    mechanical_advantage,
    output_body,
    rate_of,
    rounding_of,
    size,
    slips,
    transmission_angle,
    worst_transmission,
)
from linkanim.mechanics.motion import Motion
from linkanim.mechanics.program import Array
from linkanim.mechanics.reactions import GROUND, guided, meeting, meshing
from linkanim.mechanics.search import sign_changes
from linkanim.mechanics.tolerances import LEVEL
from linkanim.units import shown
from linkanim.words import kept_as_said, name_said, said, said_as, to_say

_STANDARD = {
    "crank": "2",
    "coupler": "3",
    "rod": "3",
    "rocker": "4",
    "slider": "4",
    "coupler2": "5",
    "rocker2": "6",
}
"""The numbers that textbooks give the links of the common linkages; the ground is 1."""
_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_NOUN = 3
"""A name of fewer letters is no noun."""
_ADJECTIVES = frozenset({"upper", "lower", "left", "right", "large", "small", "short", "upright"})
"""Names of bodies that are adjectives: "the upper link"."""


def indexed(symbol: str, index: str) -> str:
    """Return a symbol with its subscript: ω₄, v_{B}."""
    lowered = index.isdecimal() and index.isascii()
    return symbol + (index.translate(_SUBSCRIPTS) if lowered else f"_{{{index}}}")


def plain_unit(unit: str, length_unit: str) -> str:
    """Return a unit in plain letters, angles in degrees: "rad/s^2", "deg"."""
    return "deg" if unit == "rad" else unit.format(length_unit).replace("²", "^2")


def link_labels(linkage: Linkage) -> dict[str, str]:
    """Return what each body is called in symbols: its number, by name or by custom; else its name."""
    named = [body.name for body in linkage.bodies]
    taken = {name for name in named if name.isdecimal()}
    labels = {}
    for name in named:
        number = _STANDARD.get(name, name)
        labels[name] = name if name in taken or number in taken else number
        taken.add(labels[name])
    return labels


def called(body: Body, names: Mapping[str, str]) -> str:
    """Return what a body is called in words, by its name in `names`: "Rocker", "Link 3", "Slider C".

    A slider with a number for a name is called after its joint, whose letter stands beside it.

    A body named by one letter is "Link b": the letter alone would be read as a joint's.
    """
    if body.name.isdecimal():
        if body.slider:
            return said("Slider {joint}", joint=body.slider)
        return said("Link {name}", name=body.name)
    name = names.get(body.name, body.name)
    return _begun(name_said(name)) if len(name) >= _NOUN else said("Link {name}", name=name)


def _begun(words: str) -> str:
    """Return words that begin with a capital."""
    return words[:1].upper() + words[1:]


def phrase(body: Body, names: Mapping[str, str]) -> str:
    """Return what a body is called within a sentence: "the rocker", "the upper link", "link 3"."""
    words = names.get(body.name, body.name)
    if words in _ADJECTIVES:
        return said("the {adjective} link", adjective=name_said(words))
    noun = words != body.name or (len(words) >= _NOUN and words.islower())
    return said("the {name}", name=name_said(words)) if noun else said("link {name}", name=words)


def input_symbol(linkage: Linkage) -> str:
    """Return the input's symbol: θ₂, of a four-bar driven at its rocker θ₄, of a slider s.

    Of a motor in a joint B that moves it is θ_B.
    """
    coordinate, body = linkage.drive.coordinate, linkage.driven.body
    if not coordinate.is_angle:
        return coordinate.letter
    if linkage.driven.base is not None:
        return indexed(coordinate.letter, linkage.driven.pivot)
    return indexed(coordinate.letter, link_labels(linkage)[body.name] if body else "2")


NO_NAMES: Mapping[str, str] = MappingProxyType({})
"""Every body by its own name."""
_NEAREST = 10
_LONG = 60
"""Characters of a token: more take long to compare, and none has them."""


Path = tuple[str | int, ...]


@frozen
class Quantity:
    """A quantity of one linkage: `rocker.angular_velocity`, ω₄, "Rocker", "angular velocity", rad/s.

    `computed` takes a Motion (arrays) or a Pose (floats) and works it out, in radians and the scene's unit of
    length: one value an instant, or one in each of `columns`. `unit`, `order` and `divisor` are as in
    `Measure`. `path` is its place in JSON, numbers being places in a list; it is empty for a quantity that
    follows from others in JSON.
    """

    token: str
    symbol: str
    part: str
    measure: str
    unit: str
    order: int
    computed: Callable[[Any], Any]
    columns: tuple[str, ...] = ("",)
    path: Path = ()
    divisor: Callable[[Any], Any] | None = None

    @property
    def words(self) -> str:
        """What it is of, and what it is: "Rocker: angular velocity"; the latter alone of a whole linkage."""
        return said("{part}: {measure}", part=self.part, measure=self.measure) if self.part else self.measure

    def read(self, motion: Any) -> Any:
        """Return what it is: 0.0 is exactly nothing, `inf` unbounded, `nan` no value, None not known."""
        value = self.computed(motion)
        return None if value is None else as_output(motion, value, self.unit, self.order)

    def displayed(self, motion: Any) -> Any:
        """Return the values as people read them: angles in degrees."""
        value = self.read(motion)
        return np.degrees(value) if self.unit == "rad" else value

    def unbounded_between(self, cycle: Motion) -> Array:
        """Return the phases between the instants of a cycle, at equal steps, at which it is not bounded.

        They lie where its divisor changes sign; a quantity that is unbounded throughout is so at the
        instants.
        """
        divisor, phases = self.divisor, cycle.phase
        if divisor is None or len(phases) < 2:
            return np.empty(0)
        solve = partial(cycle.mechanism.solve, speed=1.0)
        around = np.append(phases, 2 * phases[-1] - phases[-2])
        changes = sign_changes(lambda near: np.asarray(divisor(solve(phase=near))), around)
        unbounded: Any = np.isinf(self.read(solve(phase=changes)))
        return np.sort(changes[unbounded.any(axis=1) if unbounded.ndim > 1 else unbounded])

    def rounding(self, cycle: Any) -> float:
        """Return how large rounding errors may be over a cycle, from its extent and the input's speed."""
        return float(np.max(rounding_of(cycle, self.unit, self.order)))

    def changes(self, cycle: Any) -> bool:
        """Return whether it has more than one value over a cycle, rounding errors aside."""
        values = np.asarray(self.read(cycle), float)
        finite = values[np.isfinite(values)]
        return bool(
            finite.size and np.ptp(finite) > max(LEVEL * np.abs(finite).max(), 10 * self.rounding(cycle))
        )

    def display_unit(self, length_unit: str) -> str:
        """Return the unit that goes with `displayed`."""
        return "°" if self.unit == "rad" else self.unit.format(length_unit)

    def title(self, length_unit: str) -> str:
        """Return what an axis is titled: "Rocker: angular velocity ω₄ (rad/s)"."""
        return f"{self.words}{self._comma}{self.headed(length_unit)}"

    @property
    def named(self) -> str:
        """Its words and its symbol: "Rocker: angular velocity ω₄", "B: x-position, x_{B}"."""
        return f"{self.words}{self._comma}{self.symbol}"

    @property
    def _comma(self) -> str:
        """What stands between its words and its symbol: a comma after those of a component."""
        return said_as("list", ", ") if self.token.endswith((".x", ".y")) else " "

    def headed(self, length_unit: str) -> str:
        """Return what a column is headed: "ω₄ (rad/s)", without a unit the symbol alone."""
        unit = self.display_unit(length_unit)
        return f"{self.symbol} ({unit})" if unit else self.symbol


def register(linkage: Linkage, names: Mapping[str, str] = NO_NAMES) -> Mapping[str, Quantity]:
    """Return all quantities of a linkage by their tokens: bodies, joints, centres of mass, struts.

    Tokens go by the bodies' own names; words by what `names` has for them. Lengths are read from the motion.
    """
    return _registered(linkage.unsized, tuple(names.items()), _carriers(linkage))


@kept_as_said(16)
def _registered(
    linkage: Linkage, names: tuple[tuple[str, str], ...], carriers: _Carriers
) -> Mapping[str, Quantity]:
    quantities = _quantities(linkage, dict(names), carriers, still=False)
    return MappingProxyType({quantity.token: quantity for quantity in quantities})


def recorded(linkage: Linkage) -> tuple[Quantity, ...]:
    """Return the quantities of JSON and CSV, with those of fixed pins and with forces that are not known."""
    return _recorded(linkage.unsized, _carriers(linkage))


@kept_as_said(16)
def _recorded(linkage: Linkage, carriers: _Carriers) -> tuple[Quantity, ...]:
    quantities = _quantities(linkage, NO_NAMES, carriers, still=True)
    return tuple(quantity for quantity in quantities if quantity.path)


def look_up(known: Mapping[str, Quantity], token: str, of: str) -> Quantity:
    """Return the quantity of that token; BadInput with the nearest ones where there is none.

    `of` says whose quantities they are.
    """
    if token in known:
        return known[token]
    near = ", ".join(_nearest(known, token[:_LONG]))
    listed = f"; `linkanim chart SCENE --quantity list` has all {len(known)}" if len(known) > _NEAREST else ""
    raise BadInput(f"quantity {shown(token)}: {of} has none of this name; nearest are {near}{listed}")


def _nearest(known: Iterable[str], token: str) -> list[str]:
    """Return the tokens most like another: first those of the same part with similar words, then the rest."""
    from difflib import SequenceMatcher

    token = token.casefold().replace("speed", "velocity")
    part, _, measure = token.partition(".")
    sought = measure or part

    def likeness(candidate: str) -> float:
        other, _, named = candidate.casefold().partition(".")
        whole = SequenceMatcher(None, token, candidate.casefold()).ratio()
        words = SequenceMatcher(None, sought, named or other).ratio()
        within = bool(sought) and sought in (named or other)
        return whole + words + within + (other == part)

    return sorted(known, key=likeness, reverse=True)[:_NEAREST]


def _quantities(
    linkage: Linkage, names: Mapping[str, str], carriers: _Carriers, *, still: bool
) -> Iterator[Quantity]:
    """Yield all quantities, those of fixed pins and unknown forces where `still`."""
    labels = link_labels(linkage)
    for body in linkage.bodies:
        yield from _of_body(linkage, body, labels[body.name], called(body, names))
    for link, slide in slips(linkage).items():
        yield from _of_slip(link, slide.point, labels[link], called(linkage.body(link), names))
    for joint in linkage.joints:
        moves, name = not isinstance(joint, Pin), joint.name
        own, bent = POINT if moves or still else (), PATH if moves else ()
        yield from _of_point(own, bent, (name, name, name), ("joints", name))
    for link, slide in slips(linkage).items():
        yield _of_coriolis(link, slide.point)
    for body in linkage.bodies:
        if body.com is not None:
            centre = said("{part}, centre of mass", part=called(body, names))
            called_ = body.name, f"G{labels[body.name]}", centre
            yield from _of_point(CENTRE, CENTRE_PATH, called_, ("bodies", body.name, "com"))
    for strut in linkage.springs + linkage.dampers:
        words = linkage.strut_words(strut)
        index = words if strut.name in labels else strut.name
        yield from _of_strut(strut, index, _begun(words), every=still)
    for body in linkage.bodies:
        if body.slider is None:
            called_ = body.name, f"P1{labels[body.name]}", called(body, names)
            yield from _vector(_POLE, called_, ("bodies", body.name))
    yield from _of_whole(linkage)
    yield from _of_forces(linkage, names, carriers)


def _slipping(measure: Measure, link: str, motion: Any) -> Any:
    return measure.read(motion, link)


def _of_slip(link: str, joint: str, label: str, words: str) -> Iterator[Quantity]:
    """Yield how what slides on a moving link slips along it."""
    for one in SLIP:
        symbol = indexed(one.symbol, f"{joint}/{label}")
        told = words, said("{measure} of {joint}", measure=said(one.words), joint=joint)
        read, path = partial(_slipping, one, link), ("bodies", link, one.name)
        yield Quantity(f"{link}.{one.name}", symbol, *told, one.unit, one.order, read, path=path)


def _of_coriolis(link: str, joint: str) -> Quantity:
    """Return the Coriolis acceleration of what slides on a moving link."""
    read, path = partial(_slipping, CORIOLIS, link), ("joints", joint, CORIOLIS.name)
    symbol, words = indexed(CORIOLIS.symbol, joint), (joint, said(CORIOLIS.words))
    return Quantity(f"{joint}.coriolis", symbol, *words, CORIOLIS.unit, CORIOLIS.order, read, path=path)


def _pole(motion: Any, name: str) -> Any:
    place = pole(motion, motion.mechanism.linkage.body(name))
    return place if isinstance(motion.phase, float) else np.stack(place, axis=-1)


def _turning(motion: Any, name: str) -> Any:
    return motion.angular_velocity[name]


_POLE = Measure("pole", "pole", "r", to_say("instant centre to the ground"), "{}", 0, "", _pole, _turning)


def _of_whole(linkage: Linkage) -> Iterator[Quantity]:
    """Yield what is known of the linkage as a whole: its input, transmission and advantage."""
    yield from _of_input(linkage)
    dyads = dyads_of(linkage)
    if dyads:
        read: Callable[[Any], Any] = partial(worst_transmission, dyads=dyads)
        yield _whole("transmission_angle", "μ", ("", said("Transmission angle")), "rad", 0, read)
    for dyad in dyads if len(dyads) > 1 else ():
        read, words = partial(transmission_angle, dyad=dyad), (dyad, said("transmission angle"))
        whole = _whole(f"{dyad}.transmission_angle", indexed("μ", dyad), words, "rad", 0, read)
        yield replace(whole, path=("joints", dyad, "transmission_angle"))
    output = output_body(linkage)
    if output is not None and (output.slider or linkage.drive.coordinate.is_angle):
        read = partial(mechanical_advantage, output=output)
        whole = _whole("mechanical_advantage", "MA", ("", said("Mechanical advantage")), "", 0, read)
        yield replace(whole, divisor=partial(rate_of, body=output))


# What joints, guides and gears carry, of a linkage with forces.


_Carriers = tuple[tuple[tuple[str, tuple[str, ...]], ...], tuple[str, ...], tuple[tuple[str, bool], ...]]
"""What carries forces: the bodies that meet in each joint, what slides, geared cranks and if by teeth."""


def _carriers(linkage: Linkage) -> _Carriers:
    """Return what carries forces, nothing of a linkage without any."""
    if not linkage.reacting:
        return (), (), ()
    return tuple(meeting(linkage).items()), guided(linkage), tuple(meshing(linkage).items())


def _of_forces(linkage: Linkage, names: Mapping[str, str], carriers: _Carriers) -> Iterator[Quantity]:
    """Yield the force of each joint on each body, those of guides and gears, and that on the ground."""
    if not linkage.reacting:
        return
    order, (meetings, guides, gears) = force_order(linkage), carriers
    labels = {GROUND: "1", **link_labels(linkage)}
    words = {body.name: called(body, names) for body in linkage.bodies} | {GROUND: said("Ground")}

    def whose(body: str) -> str:
        usual = said("Bar {name}", name=body) if "–" in body else _begun(name_said(body))
        return words.get(body, usual)

    for joint, bodies in meetings:
        for body in bodies:
            index, read = f"{joint},{labels.get(body, body)}", partial(_in_joint, joint=joint, body=body)
            told = whose(body), said("force in {joint}", joint=joint)
            yield from _pull(f"{body}.{joint}.force", index, told, order, ("reactions", joint, body), read)
    for name in guides:
        for kind, symbol, unit, measure in (
            ("force", "N", "N", said("force of its guide")),
            ("moment", "M", "N m", said("moment of its guide")),
        ):
            guide = f"{name}.guide_{kind}", indexed(symbol, labels.get(name, name)), whose(name), measure
            read = partial(_in_guide, name=name, kind=kind)
            yield Quantity(*guide, unit, order, read, path=("guides", name, kind))
    for name, toothed in gears:
        for kind in ("tangential", "radial") if toothed else ():
            teeth = f"{name}.{kind}_force", f"F_{{g{name}{kind[0]}}}", name, said(_OF_TEETH[kind])
            read = partial(_in_gear, name=name, kind=kind)
            yield Quantity(*teeth, "N", order, read, path=("gears", name, kind))
        turning = f"{name}.gear_moment", f"M_{{g{name}}}", name, said("moment of its gear")
        read = partial(_in_gear, name=name, kind="moment")
        yield Quantity(*turning, "N m", order, read, path=("gears", name, "moment"))
    shaking = said("Ground"), said("shaking force")
    yield from _pull("ground.force", "s", shaking, order, ("ground", "force"), _on_ground)
    moment = "ground.moment", "M_{s}", said("Ground"), said("shaking moment"), "N m", order
    yield Quantity(*moment, _moment_on_ground, path=("ground", "moment"))


_OF_TEETH = {
    "tangential": to_say("tangential force of its teeth"),
    "radial": to_say("radial force of its teeth"),
}


def force_order(linkage: Linkage) -> int:
    """Return which derivative forces depend on: 2 with inertia, 1 with damping."""
    if any(body.forceful for body in linkage.bodies) and not linkage.static:
        return 2
    return int(
        any(damper.forceful for damper in linkage.dampers)
        or any(load.against or load.way for load in linkage.loads)
    )


def _pull(
    token: str, index: str, words: tuple[str, str], order: int, path: Path, read: Callable[[Any], Any]
) -> Iterator[Quantity]:
    """Yield a force, its size and its two components."""
    whose, what = words
    yield Quantity(token, f"F_{{{index}}}", whose, what, "N", order, lambda motion: size(read(motion)))
    for n, axis in enumerate("xy"):
        along = said("{axis} of the {measure}", axis=axis, measure=what)
        yield Quantity(
            f"{token}.{axis}",
            f"F_{{{index}{axis}}}",
            whose,
            along,
            "N",
            order,
            _component(read, n),
            path=(*path, n),
        )


def _in_joint(motion: Any, joint: str, body: str) -> Any:
    return motion.reactions.joints[joint][body]


def _on_ground(motion: Any) -> Any:
    return motion.reactions.ground


def _moment_on_ground(motion: Any) -> Any:
    return motion.reactions.moment


def _in_guide(motion: Any, name: str, kind: str) -> Any:
    return getattr(motion.reactions.guides[name], kind)


def _in_gear(motion: Any, name: str, kind: str) -> Any:
    return getattr(motion.reactions.gears[name], kind)


def _of_input(linkage: Linkage) -> Iterator[Quantity]:
    """Yield the input's velocity, its cylinder's length, and the torque or force that it delivers."""
    coordinate, actuator = linkage.drive.coordinate, linkage.drive.actuator
    of_input = said("Input")
    symbol, words = "ω_{in}" if coordinate.is_angle else "v_{in}", (of_input, said(coordinate.velocity))
    yield _whole(coordinate.rate_token, symbol, words, f"{coordinate.unit}/s", 1, input_rate)
    if (ends := actuator.along) is not None:

        def length(motion: Any) -> Any:
            return size(between(motion.position, ends))

        yield _whole("input.length", "L_{in}", (of_input, said("length of the cylinder")), "{}", 0, length)
    if linkage.forceful:
        order = force_order(linkage)
        name, unit = actuator.effort
        symbol = f"{name[0].upper()}_{{in}}"
        yield _whole(effort_token(linkage), symbol, (of_input, said(name)), unit, order, input_effort)


def _whole(
    token: str, symbol: str, words: tuple[str, str], unit: str, order: int, read: Callable[[Any], Any]
) -> Quantity:
    """Return a quantity of the linkage as a whole, which stands in JSON under its own token."""
    return Quantity(token, symbol, *words, unit, order, read, path=tuple(token.split(".")))


def _of_body(linkage: Linkage, body: Body, label: str, words: str) -> Iterator[Quantity]:
    own, slopes = measures_of(linkage, body)
    path = ("bodies", body.name)
    for measure in own:
        yield _bound(measure, body.name, indexed(measure.symbol, label), words, (*path, measure.key))
    for place, measure in enumerate(slopes):
        symbol = indexed(measure.symbol, label)
        yield _bound(measure, body.name, symbol, words, (*path, "coefficients", place))


def _bound(measure: Measure, part: str, symbol: str, words: str, path: Path) -> Quantity:
    """Return a measure of one part as a quantity."""
    known = (f"{part}.{measure.name}", symbol, words, said(measure.words), measure.unit, measure.order)
    divisor = measure.divisor_of(part)
    return Quantity(*known, lambda motion: measure.read(motion, part), path=path, divisor=divisor)


def _of_point(
    own: Iterable[Measure], bent: Iterable[Measure], names: tuple[str, str, str], path: Path
) -> Iterator[Quantity]:
    """Yield the vectors of a joint or centre of mass, and how its path bends; `names` as in `_vector`."""
    part, label, words = names
    for measure in own:
        yield from _vector(measure, names, path)
    for measure in bent:
        yield _bound(measure, part, indexed(measure.symbol, label), words, (*path, measure.key))


def _vector(measure: Measure, names: tuple[str, str, str], path: Path) -> Iterator[Quantity]:
    """Yield a vector, a position as its two components and else its magnitude, and each component.

    `names` are those of the part, in symbols and in words.
    """
    part, label, called_ = names
    token, words = f"{part}.{measure.name}", said(measure.words)

    def vector(motion: Any) -> Any:
        return measure.read(motion, part)

    divisor = measure.divisor_of(part)
    whole = (indexed(measure.symbol, label), called_, words, measure.unit, measure.order)
    if measure.order:
        yield Quantity(token, *whole, lambda motion: size(components(vector(motion))))
    else:
        yield Quantity(token, *whole, vector, ("x", "y"), divisor=divisor)
    for n, axis in enumerate("xy"):
        symbol = indexed(measure.symbol, f"{label}{axis}") if measure.order else indexed(axis, label)
        one = said("{axis}-{measure}", axis=axis, measure=words)
        along = one if " " not in measure.words else said("{axis} of the {measure}", axis=axis, measure=words)
        part_of = f"{token}.{axis}", symbol, called_, along, measure.unit, measure.order
        yield Quantity(*part_of, _component(vector, n), path=(*path, measure.key, n), divisor=divisor)


def _component(vector: Callable[[Any], Any], index: int) -> Callable[[Any], Any]:
    return lambda motion: components(vector(motion))[index]


def _of_strut(strut: Spring | Damper, index: str, words: str, *, every: bool) -> Iterator[Quantity]:
    """Yield a strut's quantities, a force that is not known where `every` is meant.

    `index` is what it is called in symbols.
    """
    kind, measures = ("damper", DAMPER) if isinstance(strut, Damper) else ("spring", SPRING)
    for measure in measures:
        if measure.name != "force" or strut.forceful or every:
            symbol = indexed(measure.symbol, index)
            path = (f"{kind}s", strut.name, measure.key)
            yield _bound(measure, strut.name, symbol, words, path)


_LEAST, _MOST = 6, 10


def key_quantities(cycle: Motion, traced: tuple[str, ...] = ()) -> tuple[str, ...]:
    """Return the tokens of six to ten quantities that say most of a linkage, the most important first.

    What it is there to move, the forces, how its links turn, the torque at its input, the first of the
    `traced` joints whose speed changes, how well it transmits; nothing that stands still over the cycle.
    """
    linkage = cycle.mechanism.linkage
    known = register(linkage)

    def changes(token: str) -> bool:
        return token in known and known[token].changes(cycle)

    point = tuple(islice((name for name in traced if changes(f"{name}.velocity")), 1))
    candidates = [*islice(filter(changes, _candidates(linkage, point)), _MOST)]
    others = sorted(known, key=lambda token: token.partition(".")[0] not in traced)
    rest = (token for token in others if token not in candidates and changes(token))
    return tuple(dict.fromkeys((*candidates, *islice(rest, max(_LEAST - len(candidates), 0)))))


def _candidates(linkage: Linkage, traced: tuple[str, ...]) -> Iterator[str]:
    output = output_body(linkage)
    bodies = sorted(linkage.bodies, key=lambda body: body is not output)
    sliders = [body.name for body in bodies if body.slider is not None]
    for name in sliders:
        yield from (f"{name}.travel_velocity", f"{name}.travel_acceleration")
    struts: tuple[Spring | Damper, ...] = (*linkage.springs, *linkage.dampers)
    for strut in struts:
        yield f"{strut.name}.{'force' if strut.forceful else 'length'}"
    if output and not sliders:
        yield from (f"{output.name}.{measure.name}" for measure in TURNING)
    for body in bodies_in_chain(linkage):
        if not linkage.crank_of(body) and not (output and not sliders and _rigid(linkage, body, output)):
            yield f"{body.name}.angular_velocity"
    yield effort_token(linkage)
    for name in traced:
        yield from (f"{name}.velocity", f"{name}.acceleration")
    yield from (f"{name}.travel" for name in sliders)
    yield from ("transmission_angle", "mechanical_advantage")


def bodies_in_chain(linkage: Linkage) -> tuple[Body, ...]:
    """Return the bodies that turn, in the order in which the joints that move them are solved.

    Of those that cannot move against each other it is the first.
    """
    moving = [joint.name for joint in linkage.joints if not isinstance(joint, Pin)]
    bodies = {body.name: body for name in moving for body in linkage.bodies if name in body.joints}
    chain: list[Body] = []
    for body in bodies.values():
        if not any(_rigid(linkage, body, other) for other in chain):
            chain.append(body)
    return tuple(chain)


def _rigid(linkage: Linkage, body: Body, other: Body) -> bool:
    """Tell whether two bodies that turn cannot move against each other."""
    return holding(linkage.rigid_bodies, body.joints) == holding(linkage.rigid_bodies, other.joints)
