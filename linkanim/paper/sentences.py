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
from linkanim.paper.curves import Curve, Curves, Pace, Peak, curves_of, extremes, within_a_turn
from linkanim.picture.quantities import Floats, driven_words, unbounded_places
from linkanim.scenes.scene import Scene
from linkanim.units import rounded, short, stepped, typeset
from linkanim.words import row_said, said, said_as, sentences

_CLOSING = ("input", "stroke", "time ratio", "transmission angle", "true period")
"""The labels of the scene's facts with which a report ends."""
_MOST = 3
"""The most curves of a chart that are described; of more, only the one of greatest range."""
_MOST_ZEROS = 4
"""The most zeros of a curve that are listed; of more, only their number."""
_DIGITS = 4
_EVEN = 2e-4
"""A share of the period: ways that differ less take the same time, as a flat extreme is no more exact."""
_NEARLY_EVEN = 1.1
"""The time ratio below which a third decimal is shown."""
_PLACES = (".angle", ".travel")
"""The quantities that have a time ratio: where a link or a slider is on its way to and fro."""
_NOTHING = 1e-9
_ROUNDING = 1e-7
"""A share of a curve's greatest size, below which a value is zero: its place is found no more exactly."""
_MOST_TOLD = 8
"""The most links of a pose that are described."""
_LASTS = re.compile(r"[\d.]+ s$")
_LOWERED = re.compile(r"_\{([^}]*)\}")


def about(curves: Curves) -> str:
    """Return what a chart shows, in sentences: extremes and zeros, or where a curve is unbounded.

    A level curve has no sentence. Where several curves share a chart each has a short one.
    """
    told = _described(curves)
    brief = len(told) > 1
    return sentences(*(sentence for curve in told for sentence in _sentences(curves, curve, brief=brief)))


def closing(scene: Scene, pace: Pace) -> Iterator[str]:
    """Yield the summary of a report: the class, what the output does, its velocity and acceleration."""
    lasts = f"{short(scene.period / abs(pace.speed))} s"
    facts = [
        # the scene's own say how long it lasts at its own speed
        said(
            "{label}: {words}",
            label=said(label),
            words=_LASTS.sub(lasts, value) if label == "true period" else value,
        )
        for label, value in scene.info.lines
        if label in _CLOSING
    ]
    yield sentences(*map(_sentence, (scene.info.class_said, *facts)))
    output = output_slider(scene.linkage) or output_body(scene.linkage)
    if output is None:
        return
    kinds = ("travel", "travel_velocity", "travel_acceleration")
    if not output.slider:
        kinds = ("angle", "angular_velocity", "angular_acceleration")
    tokens = [token for kind in kinds if (token := f"{output.name}.{kind}") in scene.quantities]
    for token in tokens:
        if found := about(within_a_turn(curves_of(scene, (token,), (pace,)))):
            yield sentences(said("{found}.", found=scene.quantities[token].words), found)


def of_motion(scene: Scene, pace: Pace) -> str:
    """Return what moves, between which values, in a paragraph: for those who do not see it."""
    info = scene.info
    names = [joint.name for joint in scene.linkage.joints if joint.name in scene.trace]
    _, *told = closing(scene, pace)
    parts = [
        _sentence(said(scene.title)),
        _sentence(
            said(
                "{class_name}: the {link} {moves}, at {speed}",
                class_name=info.class_said,
                link=info.input_said,
                moves=info.input_words,
                speed=pace.words,
            )
        ),
        *told[:1],
        said("Traced: {joints}.", joints=row_said(names)) if names else "",
        said(
            "One true period lasts {time} s, and then it begins again.",
            time=f"{scene.period / abs(pace.speed):.4g}",
        ),
    ]
    return without_subscripts(sentences(*parts))


def of_pose(scene: Scene, phase: float) -> str:
    """Return how the links of a scene stand at a phase, in a paragraph."""
    pose = scene.pose(phase, 0)
    pose_words = f"{input_symbol(scene.linkage)} = {driven_words(scene, float(pose.coordinate))}"
    stand = []
    for body in scene.linkage.bodies:
        name = called(body, scene.info.link_names)
        name = name[:1].lower() + name[1:]
        if body.slider:
            travel = rounded(float(pose.travel[body.name]), _DIGITS)
            length = f"{travel} {scene.length_unit}"
            stand.append(said("{link} {length} along its guide", link=name, length=length))
        else:
            angle = f"{np.degrees(pose.angle[body.name]) % 360:.1f}°"
            stand.append(said("{link} at {angle}", link=name, angle=angle))
    if not stand:  # no link has a name
        for joint in scene.linkage.joints:
            if not joint.fixed:
                x, y = (stepped(float(value), scene.length_step) for value in pose.position[joint.name])
                place = f"({x}, {y}) {scene.length_unit}"
                stand.append(said("{joint} at {place}", joint=joint.name, place=place))
    links = said_as("list", ", ").join(stand[:_MOST_TOLD])
    if len(stand) > _MOST_TOLD:
        links = said("{links}, and {count} more", links=links, count=len(stand) - _MOST_TOLD)
    told = said("At {place}: {links}.", place=pose_words, links=links)
    return without_subscripts(sentences(_sentence(said(scene.title)), told))


def without_subscripts(text: str) -> str:
    """Return text with its subscripts as plain letters."""
    return _LOWERED.sub(r"\1", text)


def _sentence(text: str) -> str:
    return said("{found}.", found=f"{text[:1].upper()}{text[1:].rstrip('.。')}")


def _described(curves: Curves) -> Sequence[Curve]:
    """Return the curves that are described: those at the speed of the curve of greatest range, as marked.

    Of many it is that curve alone.
    """
    widest = max(curves.curves, key=lambda curve: float(np.ptp(np.nan_to_num(curve.values))))
    same = [curve for curve in curves.curves if curve.pace == widest.pace]
    return same if len(same) <= _MOST else [widest]


def _sentences(curves: Curves, curve: Curve, *, brief: bool) -> Iterator[str]:
    peaks = extremes(curves.scene, curve)
    if not peaks:
        yield from _unbounded(curves, curve)
        return
    high, low = peaks
    symbol = ", ".join(part for part in (curve.quantity.symbol, curve.label) if part)
    several = len({one.pace for one in curves.curves}) > 1 and curve.quantity.order
    name = said("At {speed} {symbol}", speed=curve.pace.words, symbol=symbol) if several else symbol
    zeros = _zeros(curves, curve)
    if brief:
        known = {"name": name, "ends": _ends(curves, curve, (low, high))}
        if zeros:
            yield said("{name} goes from {ends}, and {zeros}.", **known, zeros=_zero_words(zeros))
        else:
            yield said("{name} goes from {ends}.", **known)
        return
    if curve.quantity.order == 0 and (way := _way_up(curves, curve)) is not None:
        yield _to_and_fro(curves, curve, name, (low, high), way)
        return
    most, least = (
        said("{value}, {place}", value=_value(curves, curve, peak.value), place=_at(curves, peak))
        for peak in peaks
    )
    known = {"name": name, "most": most, "least": least}
    if zeros:
        yield said(
            "{name} is greatest, {most}, and least, {least}; it {zeros}.", **known, zeros=_zero_words(zeros)
        )
    else:
        yield said("{name} is greatest, {most}, and least, {least}.", **known)


def _unbounded(curves: Curves, curve: Curve) -> Iterator[str]:
    """Yield where a curve goes to infinity, if it does so at a few places."""
    phases = unbounded_places(curve.phases, curve.values)
    places = list(dict.fromkeys(_input_places(curves, phases)))
    if 0 < len(places) <= _MOST_ZEROS:
        symbol = ", ".join(part for part in (curve.quantity.symbol, curve.label) if part)
        at = f"{input_symbol(curves.scene.linkage)} = {row_said(places)}"
        yield said("{symbol} goes to infinity at {place}.", symbol=symbol, place=at)


def _ends(curves: Curves, curve: Curve, ends: tuple[Peak, Peak]) -> str:
    """Return between which values a curve goes: −611.0 mm at θ₂ = 316.7° to −543.8 mm at θ₂ = 70.9°."""
    low, high = (
        said("{value} {place}", value=_value(curves, curve, end.value), place=_at(curves, end))
        for end in ends
    )
    return said("{low} to {high}", low=low, high=high)


def _to_and_fro(curves: Curves, curve: Curve, name: str, ends: tuple[Peak, Peak], up: float) -> str:
    """Return the sentence on a curve that rises and falls once in a period; `up` is the share of the rise."""
    between = said("{name} rises from {ends} and falls again", name=name, ends=_ends(curves, curve, ends))
    if not curve.quantity.token.endswith(_PLACES):
        return said("{found}.", found=between)
    if abs(up - 0.5) < _EVEN:
        return said("{found}; both ways take the same time.", found=between)
    share = max(up, 1 - up)
    turned = ""
    if curves.scene.info.full_turn and abs(curves.scene.period - tau) < _NOTHING:
        turned = said(" ({angle}° of the input)", angle=f"{360 * share:.1f}")
    ratio = share / (1 - share)
    known = {"found": between, "turned": turned, "ratio": f"{ratio:.{3 if ratio < _NEARLY_EVEN else 2}f}"}
    if up > 0.5:
        return said("{found}; the way up is the slow one{turned}, time ratio {ratio}.", **known)
    return said("{found}; the way down is the slow one{turned}, time ratio {ratio}.", **known)


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
    peaks = [float(np.interp(coordinate, *_rising(curve.x, curve.phases))) for coordinate in places]
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
    # round the period from between two samples: many curves are zero at the start itself
    shifted = np.linspace(phases[0], phases[-1], len(phases)) + 0.5 * (phases[1] - phases[0])
    zeros = sign_changes(lambda near: curve.solved(curves.scene, near), shifted)
    if curves.in_time:
        return [_seconds(curves, time) for time in sorted(_times(curve, zeros))]
    return _input_places(curves, zeros)


def _input_places(curves: Curves, phases: Floats) -> list[str]:
    """Return where the input is at phases, in words, in its order."""
    angles = (float(curves.scene.pose(float(phase), 0).coordinate) for phase in phases)
    shown = sorted(curves.scene.linkage.drive.coordinate.displayed(angle) for angle in angles)
    return [_place(curves, angle % 360 if curves.scene.info.full_turn else angle) for angle in shown]


def _times(curve: Curve, phases: Floats) -> list[float]:
    """Return when a curve comes to phases of its period, on its chart's axis of time."""
    known, x = _rising(curve.phases, curve.x)
    period = known[-1] - known[0]
    times: list[float] = np.interp(known[0] + (phases - known[0]) % period, known, x).tolist()
    return times


def _zero_words(zeros: list[str]) -> str:
    if len(zeros) > _MOST_ZEROS:
        return said("changes its sign {count} times", count=len(zeros))
    return said("changes its sign at {places}", places=row_said(zeros))


def _at(curves: Curves, peak: Peak) -> str:
    """Return where the input is, in words: "at θ₂ = 71.0°"; for curves over time "at t = 2 s"."""
    if curves.in_time:
        return said("at {place}", place=f"t = {_seconds(curves, peak.x)}")
    place = f"{input_symbol(curves.scene.linkage)} = {_place(curves, peak.angle)}"
    return said("at {place}", place=place)


def _seconds(curves: Curves, time: float) -> str:
    return curves.place_words(0.0 if abs(time) < _NOTHING else time)


def _place(curves: Curves, angle: float) -> str:
    drive = curves.scene.linkage.drive
    return driven_words(curves.scene, radians(angle) if drive.coordinate.is_angle else angle)


def _value(curves: Curves, curve: Curve, value: float) -> str:
    unit = curve.quantity.display_unit(curves.scene.length_unit)
    most = float(np.abs(curve.values).max())
    number = typeset(rounded(0.0 if abs(value) <= _ROUNDING * most else value, _DIGITS))
    return f"{number}{'' if unit == '°' else ' '}{unit}".rstrip()
