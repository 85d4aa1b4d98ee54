"""Symbols as the textbooks on mechanisms write them, and what links are called in them.

Subscripts are Unicode's digits (ω₃) or stand in braces (v_{B}).
"""

from __future__ import annotations

from collections.abc import Mapping

from linkanim.mechanics.linkage.linkage import Body, Linkage

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
    """Return what a body is called in words, by its name in `names`: "Rocker", "Link 3", "Slider 5"."""
    if not body.name.isdecimal():
        words = names.get(body.name, body.name)
        return words[:1].upper() + words[1:]
    return f"{'Slider' if body.slider else 'Link'} {body.name}"


def driven_body(linkage: Linkage) -> Body | None:
    """Return the body that the drive turns: the one of the crank pin and its pivot; None without a name."""
    ends = {linkage.drive.joint, getattr(linkage.joint(linkage.drive.joint), "pivot", None)}
    return next((body for body in linkage.bodies if ends <= set(body.joints)), None)


def input_symbol(linkage: Linkage) -> str:
    """Return the input's symbol: θ₂, of a four-bar driven at its rocker θ₄, of a slider s."""
    coordinate, body = linkage.drive.coordinate, driven_body(linkage)
    if not coordinate.is_angle:
        return coordinate.letter
    return indexed(coordinate.letter, link_labels(linkage)[body.name] if body else "2")
