"""How a quantity follows from the motion of joints: what a page works out where lengths are changed.

A law names joints and an order of derivatives; a quantity is `gain` times what it gives, and `shift`.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linkanim.mechanics.quantities import Quantity
from linkanim.scenes.scene import Scene
from linkanim.share.movers import centre, link_words

Law = dict[str, Any]
"""`of` is "point", "turn", "span" or "travel", of the joints `at`, by the `order` of derivatives."""
_PHASES = np.linspace(0.05, 6.2, 41)
_SAME = 1e-7
"""The share of its greatest value by which a quantity may be off its law."""
_ORDERS = ("position", "velocity", "acceleration")
_TURNS = ("angle", "angular_velocity", "angular_acceleration")
_TRAVELS = ("travel", "travel_velocity", "travel_acceleration")
_SPANS = ("length", "rate")


def law_of(scene: Scene, quantity: Quantity) -> Law | None:
    """Return how a quantity follows from joints; None where it does not, as one of forces does not."""
    motion = scene.solve(phase=_PHASES, speed=1.0)
    true = np.asarray(quantity.displayed(motion), float)
    for law in _candidates(scene, quantity.token):
        values = _read(law, motion)
        gain, shift = degrees(1.0) if quantity.unit == "rad" else 1.0, 0.0
        if law["of"] == "span" and quantity.unit == "N" and np.ptp(values) > 0:
            gain, shift = np.polyfit(values, true, 1).tolist()
        off = np.abs(true - gain * values - shift)
        if quantity.unit == "rad":
            off = np.abs((off + 180.0) % 360.0 - 180.0)
        if (off <= _SAME * max(float(np.abs(true).max()), 1e-9)).all():
            return {**law, "gain": gain, "shift": shift}
    return None


def parts_of(scene: Scene, quantity: Quantity) -> list[str]:
    """Return what of a picture a quantity is of, as the page's script calls it: "v B", "l crank"."""
    linkage, links = scene.linkage, link_words(scene)
    name, *kinds = quantity.token.split(".")
    if strut := next((one for one in linkage.springs + linkage.dampers if one.name == name), None):
        return [f"s {' '.join(strut.between)}"]
    if quantity.unit == "N" and kinds and kinds[0] != "com_position" and name != "input":
        return [f"f {quantity.symbol}"]
    rate = next((word[0] for word in ("velocity", "acceleration") if kinds and kinds[0].endswith(word)), "j")
    if any(joint.name == name for joint in linkage.joints):
        return [f"{rate} {name}"]
    if name == "input" and linkage.driven.body:
        name = linkage.driven.body.name
    if kinds and kinds[0].startswith("com_"):
        return [f"{rate} {centre(name)}"]
    return [f"l {links[name]}"] if name in links else []


def _candidates(scene: Scene, token: str) -> Iterator[Law]:
    linkage = scene.linkage
    names = {joint.name: joint.name for joint in linkage.joints}
    names |= {body.name: centre(body.name) for body in linkage.bodies if body.com is not None}
    for order, word in enumerate(_ORDERS):
        for part, name in names.items():
            for axis, end in ((None, ""), (0, ".x"), (1, ".y")):
                if token in (f"{part}.{word}{end}", f"{part}.com_{word}{end}"):
                    yield {"of": "point", "at": [name], "order": order, "axis": axis}
    for body in linkage.bodies:
        for order, word in enumerate(_TURNS):
            if token == f"{body.name}.{word}" and len(body.joints) > 1:
                yield {"of": "turn", "at": list(body.joints[:2]), "order": order}
        for order, word in enumerate(_TRAVELS):
            slider = body.slider and linkage.joint(body.slider)
            if token == f"{body.name}.{word}" and slider:
                for slide in slider.slides:
                    way = [float(np.cos(slide.angle)), float(np.sin(slide.angle))]
                    yield {
                        "of": "travel",
                        "at": [slide.line.through, slider.name],
                        "order": order,
                        "way": way,
                    }
    for strut in linkage.springs + linkage.dampers:
        for order, word in enumerate(_SPANS):
            if token in (f"{strut.name}.{word}", f"{strut.name}.force"):
                yield {"of": "span", "at": list(strut.between), "order": order}


def _read(law: Law, motion: Any) -> NDArray[np.float64]:
    """Return what a law gives of a motion, as the page's script does."""

    def places(name: str) -> list[NDArray[np.complex128]]:
        own = (motion.position, motion.velocity, motion.acceleration)
        masses = (motion.com_position, motion.com_velocity, motion.com_acceleration)
        body = name.removesuffix(centre(""))
        values = (kind[name] for kind in own) if name in own[0] else (kind[body] for kind in masses)
        return [np.broadcast_to(np.asarray(one) @ [1, 1j], motion.phase.shape) for one in values]

    first, order = places(law["at"][0]), law["order"]
    if law["of"] == "point":
        return _component(first[order], law["axis"])
    p, v, a = (other - one for one, other in zip(first, places(law["at"][1]), strict=True))
    if law["of"] == "travel":
        values: NDArray[np.float64] = ((p, v, a)[order] * complex(*law["way"]).conjugate()).real
        return values
    rates = (np.abs(p), (p.conj() * v).real / np.abs(p))
    if law["of"] == "span":
        return rates[order]
    square = np.abs(p) ** 2
    turned = (np.angle(p), (p.conj() * v).imag / square, (p.conj() * a).imag / square)
    return turned[order]


def _component(vector: NDArray[np.complex128], axis: int | None) -> NDArray[np.float64]:
    if axis is None:
        return np.abs(vector)
    return vector.imag if axis else vector.real
