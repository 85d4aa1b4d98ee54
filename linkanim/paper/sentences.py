"""What a chart shows, in sentences: where its curves are greatest, least and zero, and which way they go.

Every number is worked out again at its place, not read off the picture.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from math import radians, tau

import numpy as np

from linkanim.mechanics.measures import output_body, output_slider
from linkanim.mechanics.quantities import called, input_symbol
from linkanim.mechanics.search import sign_changes
from linkanim.paper.curves import Curve, Curves, Pace, curves_of, extremes
from linkanim.picture.quantities import Floats, driven_words, unbounded_places
from linkanim.scenes.scene import Scene
from linkanim.units import rounded, typeset

_CLOSING = ("input", "stroke", "time ratio", "transmission angle", "true period")
"""What of a scene's facts a report ends with."""
_MOST = 3
"""So many curves of a chart are told of; of more the one that goes farthest."""
_MOST_ZEROS = 4
"""So many places at which a curve is zero are listed; of more there is the number."""
_DIGITS = 4
_EVEN = 0.005
"""Two ways whose times differ by less of the period are equally quick."""
_NOTHING = 1e-9
_MOST_TOLD = 8
"""So many links of a pose are told of."""
_LOWERED = re.compile(r"_\{([^}]*)\}")


def about(curves: Curves) -> str:
    """Return what a chart shows, in sentences; of an unbounded one where it is so, of a level one nothing."""
    return " ".join(sentence for curve in _told(curves) for sentence in _sentences(curves, curve))


def closing(scene: Scene, pace: Pace) -> Iterator[str]:
    """Yield what a report comes to: the class, what the output does, its velocity and acceleration."""
    facts = [f"{label}: {value}" for label, value in scene.info.lines if label in _CLOSING]
    yield " ".join(_sentence(text) for text in (scene.info.class_name, *facts))
    output = output_slider(scene.linkage) or output_body(scene.linkage)
    if output is None:
        return
    kinds = ("travel", "travel_velocity", "travel_acceleration")
    if not output.slider:
        kinds = ("angle", "angular_velocity", "angular_acceleration")
    tokens = [token for kind in kinds if (token := f"{output.name}.{kind}") in scene.quantities]
    for token in tokens:
        if said := about(curves_of(scene, (token,), (pace,))):
            yield f"{scene.quantities[token].words}. {said}"


def of_motion(scene: Scene, pace: Pace) -> str:
    """Return what moves, between which values, in a paragraph: for those who do not see it."""
    info = scene.info
    names = [joint.name for joint in scene.linkage.joints if joint.name in scene.trace]
    _, *told = closing(scene, pace)
    traced = f"Traced: {' and '.join(names)}." if names else ""
    parts = [
        _sentence(scene.title),
        _sentence(f"{info.class_name}: the {info.input_name} {info.input_words}, at {pace.words}"),
        *told[:1],
        traced,
        f"One true period lasts {scene.period / abs(pace.speed):.4g} s, and then it begins again.",
    ]
    return plain(" ".join(part for part in parts if part))


def of_pose(scene: Scene, phase: float) -> str:
    """Return how the links of a scene stand at a phase, in a paragraph."""
    pose = scene.pose(phase, 0)
    place = f"{input_symbol(scene.linkage)} = {driven_words(scene, float(pose.coordinate))}"
    stand = []
    for body in scene.linkage.bodies:
        name = called(body, scene.info.link_names)
        name = name[:1].lower() + name[1:]
        if body.slider:
            travel = rounded(float(pose.travel[body.name]), _DIGITS)
            stand.append(f"{name} {travel} {scene.length_unit} along its guide")
        else:
            stand.append(f"{name} at {np.degrees(pose.angle[body.name]) % 360:.1f}°")
    more = f", and {len(stand) - _MOST_TOLD} more" if len(stand) > _MOST_TOLD else ""
    return plain(f"{_sentence(scene.title)} At {place}: {', '.join(stand[:_MOST_TOLD])}{more}.")


def plain(text: str) -> str:
    """Return text in which subscripts are letters like others."""
    return _LOWERED.sub(r"\1", text)


def _sentence(text: str) -> str:
    return f"{text[:1].upper()}{text[1:].rstrip('.')}."


def _told(curves: Curves) -> Sequence[Curve]:
    """Return the curves that are told of: those at the first speed, the farthest one where they are many."""
    first = [curve for curve in curves.curves if curve.pace == curves.curves[0].pace]
    if len(first) <= _MOST:
        return first
    return [max(first, key=lambda curve: float(np.ptp(np.nan_to_num(curve.values))))]


def _sentences(curves: Curves, curve: Curve) -> Iterator[str]:
    peaks = extremes(curves.scene, curve)
    if not peaks:
        yield from _unbounded(curves, curve)
        return
    high, low = ((_value(curves, curve, peak.value), _at(curves, peak.angle)) for peak in peaks)
    symbol = ", ".join(part for part in (curve.quantity.symbol, curve.label) if part)
    several = len({one.pace for one in curves.curves}) > 1 and curve.quantity.order
    name = f"At {curve.pace.words} {symbol}" if several else symbol
    if curve.quantity.order == 0 and (way := _way_up(curves, curve)) is not None:
        yield _to_and_fro(curves, curve, name, (low, high), way)
        return
    zeros = _zeros(curves, curve)
    there = f"; {_zero_words(zeros)}" if zeros else ""
    yield f"{name} is greatest, {high[0]}, {high[1]}, and least, {low[0]}, {low[1]}{there}."


def _unbounded(curves: Curves, curve: Curve) -> Iterator[str]:
    """Yield where a curve goes to infinity, if it does so at a few places."""
    phases = unbounded_places(curve.phases, curve.values)
    places = list(dict.fromkeys(_input_places(curves, phases)))
    if 0 < len(places) <= _MOST_ZEROS:
        symbol = ", ".join(part for part in (curve.quantity.symbol, curve.label) if part)
        yield f"{symbol} goes to infinity at {input_symbol(curves.scene.linkage)} = {_listed(places)}."


def _to_and_fro(
    curves: Curves, curve: Curve, name: str, ends: tuple[tuple[str, str], tuple[str, str]], up: float
) -> str:
    """Return how what goes to and fro once in a period does so; `up` is the share of the way up."""
    (low, low_at), (high, high_at) = ends
    between = f"{name} rises from {low} {low_at} to {high} {high_at} and falls again"
    if abs(up - 0.5) < _EVEN:
        return f"{between}; both ways take the same time."
    slow, share = ("way up", up) if up > 0.5 else ("way down", 1 - up)
    turned = ""
    if curves.scene.info.full_turn and abs(curves.scene.period - tau) < _NOTHING:
        turned = f" ({360 * share:.1f}° of the input)"
    return f"{between}; the {slow} is the slow one{turned}, time ratio {share / (1 - share):.2f}."


def _way_up(curves: Curves, curve: Curve) -> float | None:
    """Return the share of the period in which a curve rises; None where it does so more or less than once."""
    order = np.argsort(curve.phases)
    values, phases = curve.values[order], curve.phases[order]
    if np.isnan(values).any() or abs(values[-1] - values[0]) > 1e-6 * np.ptp(values):
        return None
    steps = np.sign(np.round(np.diff(values) / np.ptp(values), 12))
    steps = steps[steps != 0]
    if np.count_nonzero(steps != np.roll(steps, 1)) != 2:
        return None
    places = (peak.x for peak in extremes(curves.scene, curve))
    peaks = [float(np.interp(place, *_rising(curve.x, curve.phases))) for place in places]
    period = float(phases[-1] - phases[0])
    forward = (peaks[0] - peaks[1]) % period / period
    return forward if curve.pace.speed > 0 else 1 - forward


def _rising(x: Floats, values: Floats) -> tuple[Floats, Floats]:
    order = np.argsort(x, kind="stable")
    return x[order], values[order]


def _zeros(curves: Curves, curve: Curve) -> list[str]:
    """Return the places at which a curve changes its sign."""
    if not (np.nanmin(curve.values) < 0 < np.nanmax(curve.values)) or np.isnan(curve.values).any():
        return []
    phases = np.sort(curve.phases)
    # from between two samples round to there: many are zero at the start itself
    shifted = np.linspace(phases[0], phases[-1], len(phases)) + 0.5 * (phases[1] - phases[0])
    found = sign_changes(lambda near: curve.solved(curves.scene, near), shifted)
    return _input_places(curves, found)


def _input_places(curves: Curves, phases: Floats) -> list[str]:
    """Return where the input is at phases, in words, in its order."""
    angles = (float(curves.scene.pose(float(phase), 0).coordinate) for phase in phases)
    shown = sorted(curves.scene.linkage.drive.coordinate.shown(angle) for angle in angles)
    return [_at(curves, angle % 360 if curves.scene.info.full_turn else angle, bare=True) for angle in shown]


def _zero_words(zeros: list[str]) -> str:
    if len(zeros) > _MOST_ZEROS:
        return f"it changes its sign {len(zeros)} times"
    return f"it changes its sign at {_listed(zeros)}"


def _listed(places: list[str]) -> str:
    return " and ".join(part for part in (", ".join(places[:-1]), places[-1]) if part)


def _at(curves: Curves, angle: float, *, bare: bool = False) -> str:
    """Return a place of the input in words: "at θ₂ = 71.0°"; `bare` without the first two."""
    drive = curves.scene.linkage.drive
    value = driven_words(curves.scene, radians(angle) if drive.coordinate.is_angle else angle)
    return value if bare else f"at {input_symbol(curves.scene.linkage)} = {value}"


def _value(curves: Curves, curve: Curve, value: float) -> str:
    unit = curve.quantity.shown_unit(curves.scene.length_unit)
    number = typeset(rounded(0.0 if abs(value) < _NOTHING else value, _DIGITS))
    return f"{number}{'' if unit == '°' else ' '}{unit}".rstrip()
