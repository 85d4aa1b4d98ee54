"""Random linkages of every kind a scene file can say, with lengths as people type them.

Integers, fives and tenths, and the ties that typed lengths have: s + l = p + q, kites, parallelograms,
rhombs, rods as long as their crank. Each is a plain document, as a scene file's text would give it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from random import Random
from typing import Any

Document = dict[str, Any]
Four = tuple[float, float, float, float]

STARTS = ("0 deg", "0 deg", "0 deg", "30 deg", "90 deg", "180 deg", "-60 deg", "87 deg", "200 deg")
ANGLES = ("0 deg", "0 deg", "90 deg", "180 deg", "-30 deg", "45 deg", "-107.47 deg")
RATIOS = (1, -1, 2, -2, 3, 0.5, -0.5, "1/3", "-2/3", 1.5)


@dataclass
class Draft:
    """A document being written: its kind, how its lengths are typed, and which joints move."""

    rng: Random
    kind: str
    document: Document
    length: Callable[[], float]
    moving: list[str] = field(default_factory=list)
    pins: list[str] = field(default_factory=lambda: ["O2"])

    def signed(self) -> float:
        """Return a length with either sign, or none at all."""
        return self.rng.choice((-1, 1, 0)) * self.length()

    def fresh(self, letter: str) -> str:
        """Return a name that the document does not have yet."""
        taken = {*self.moving, *self.pins}
        return next(f"{letter}{i}" for i in range(1, 99) if f"{letter}{i}" not in taken)

    def joint(self, name: str, table: Document) -> None:
        """Add a joint that later ones may stand on."""
        self.document.setdefault("joints", {})[name] = table
        self.moving.append(name)

    def pin(self, name: str, place: object) -> str:
        """Add a fixed pin."""
        self.document.setdefault("ground", {})[name] = place
        self.pins.append(name)
        return name

    def further_pin(self) -> str:
        """Return a fixed pin: one that is there, or a new one at typed coordinates."""
        if self.rng.random() < 0.4:
            return self.rng.choice(self.pins)
        if self.rng.random() < 0.3:
            return self.pin(self.fresh("G"), {"length": self.length(), "angle": self.rng.choice(ANGLES)})
        return self.pin(self.fresh("G"), [self.signed(), self.signed()])


def linkages(
    seed: int,
    count: int,
    *,
    extras: tuple[int, ...] = (0, 0, 1, 1, 2),
    weights: Mapping[str, float] | None = None,
) -> Iterator[tuple[str, Document]]:
    """Yield `count` linkages, each as its kind and its document; the same ones for the same seed.

    `extras` are how many joints more a linkage may have, each as likely as the others; `weights` say
    how likely a kind is beside the others.
    """
    rng = Random(seed)
    shares = [(weights or {}).get(kind, 1.0) for kind in BASES]
    for _ in range(count):
        draft = _begun(rng, rng.choices(tuple(BASES), shares)[0])
        for _ in range(rng.choice(extras)):
            extra = rng.choice(tuple(EXTRAS))
            draft.kind += f" + {extra}"
            EXTRAS[extra](draft)
        yield draft.kind, draft.document


def _begun(rng: Random, kind: str) -> Draft:
    document: Document = {
        "drive": {"speed": rng.choice(("20 rpm", "-20 rpm", "3 rad/s")), "start": rng.choice(STARTS)}
    }
    draft = Draft(rng, kind, document, rng.choice(STYLES)(rng))
    BASES[kind](draft)
    return draft


def _integers(rng: Random) -> Callable[[], float]:
    most = rng.choice((5, 10, 30, 100))
    return lambda: rng.randint(1, most)


def _fives(rng: Random) -> Callable[[], float]:
    return lambda: 5 * rng.randint(1, 30)


def _tenths(rng: Random) -> Callable[[], float]:
    most = rng.choice((20, 100, 1000))
    return lambda: rng.randint(1, most) / 10


STYLES = (_integers, _fives, _tenths)


def _four(draft: Draft) -> Four:
    """Return ground, crank, coupler and rocker, tied as often as not."""
    a, b, c, d = sorted(draft.length() for _ in range(4))
    ties: tuple[Four, ...] = (
        (a, b, round(b + c - a, 1), c),
        (a, b, a, b),
        (a, a, b, b),
        (a, a, a, a),
        (d, a, c, c),
    )
    four = list(draft.rng.choice(ties)) if draft.rng.random() < 0.5 else [a, b, c, d]
    if draft.rng.random() < 0.8:
        draft.rng.shuffle(four)
    return four[0], four[1], four[2], four[3]


def _side(draft: Draft, words: tuple[str, str]) -> str:
    return draft.rng.choice(words)


def _point(draft: Draft) -> list[float]:
    x = draft.signed()
    return [x, draft.signed() if x else draft.length()]


def _four_bar(draft: Draft) -> None:
    ground, crank, coupler, rocker = _four(draft)
    table: Document = {"ground": ground, "crank": crank, "coupler": coupler, "rocker": rocker}
    table["ground_angle"] = draft.rng.choice(ANGLES)
    table["assembly"] = _side(draft, ("open", "crossed"))
    draft.document["four-bar"] = table
    draft.moving += ["A", "B"]
    draft.pins += ["O4"]
    if draft.rng.random() < 0.3:
        table["coupler_point"] = _point(draft)
        draft.moving.append("P")


def _four_bar_by_rocker(draft: Draft) -> None:
    _four_bar(draft)
    draft.document["four-bar"]["driver"] = "rocker"


def _slider_crank(draft: Draft) -> None:
    crank = draft.length()
    rod = draft.rng.choice((crank, draft.length(), crank + draft.length()))
    offset = draft.rng.choice((0, 0, draft.signed(), round(rod - crank, 1)))
    table: Document = {"crank": crank, "rod": round(rod, 1), "offset": offset}
    table["line_angle"] = draft.rng.choice(ANGLES)
    table["assembly"] = _side(draft, ("forward", "backward"))
    draft.document["slider-crank"] = table
    draft.moving += ["A", "B"]


def _six_bar(draft: Draft) -> None:
    first, second = _four(draft), _four(draft)
    table: Document = {"lengths": [*first, *second]}
    table["ground_angle"] = draft.rng.choice(ANGLES)
    table["link_angle"] = draft.rng.choice(ANGLES)
    table["assembly"] = _side(draft, ("open", "crossed"))
    table["assembly2"] = _side(draft, ("open", "crossed"))
    draft.document["six-bar"] = table
    draft.moving += ["A", "B", "C", "D"]
    draft.pins += ["O4", "O6"]


def _crank(draft: Draft) -> None:
    draft.pin("O2", [0, 0])
    draft.pins.remove("O2")
    draft.joint("A", {"crank": "O2", "length": draft.length()})


def _crank_and_dyad(draft: Draft) -> None:
    _crank(draft)
    _dyad(draft)


def _crank_and_slider(draft: Draft) -> None:
    _crank(draft)
    _slider(draft)


def _crank_and_slot(draft: Draft) -> None:
    _crank(draft)
    _slot(draft)


def _geared(draft: Draft) -> None:
    _crank(draft)
    _gear(draft)
    lengths = [round(draft.length() + draft.length(), 1) for _ in range(2)]
    table = {"from": draft.moving[-2:], "length": lengths, "side": _side(draft, LEFT)}
    draft.joint(draft.fresh("D"), table)


LEFT = ("left", "right")


def _gear(draft: Draft) -> None:
    gear = {"with": "A", "ratio": draft.rng.choice(RATIOS), "offset": draft.rng.choice(ANGLES)}
    if "A" not in draft.document.get("joints", {}) and "four-bar" in draft.document:
        gear["with"] = "B" if draft.document["four-bar"].get("driver") == "rocker" else "A"
    draft.joint(draft.fresh("C"), {"crank": draft.further_pin(), "length": draft.length(), "gear": gear})


def _dyad(draft: Draft) -> None:
    first = draft.rng.choice(draft.moving)
    others = [name for name in draft.moving if name != first]
    second = draft.rng.choice(others) if others and draft.rng.random() < 0.4 else draft.further_pin()
    ends = [first, second]
    draft.rng.shuffle(ends)
    near = draft.length()
    far = draft.rng.choice((near, draft.length(), round(near + draft.length(), 1)))
    draft.joint(draft.fresh("D"), {"from": ends, "length": [near, far], "side": _side(draft, LEFT)})


def _slider(draft: Draft) -> None:
    line: Document = {"through": draft.further_pin(), "angle": draft.rng.choice(ANGLES)}
    if draft.rng.random() < 0.4:
        line["offset"] = draft.signed()
    table: Document = {"from": draft.rng.choice(draft.moving), "length": draft.length(), "line": line}
    if draft.rng.random() < 0.3 and "crank" in draft.document.get("joints", {}).get(table["from"], {}):
        table["length"] = draft.document["joints"][table["from"]]["length"]
    table["side"] = _side(draft, ("forward", "backward"))
    draft.joint(draft.fresh("S"), table)


def _slot(draft: Draft) -> None:
    slot: Document = {"pivot": draft.further_pin(), "through": draft.rng.choice(draft.moving)}
    if draft.rng.random() < 0.4:
        slot["offset"] = draft.signed()
    draft.joint(draft.fresh("E"), {"slot": slot, "length": draft.length()})


def _rigid(draft: Draft) -> None:
    pairs = list(_bars(draft.document))
    draft.joint(draft.fresh("P"), {"on": list(draft.rng.choice(pairs)), "at": _point(draft)})


def _bars(document: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield pairs of joints that lie on one body each."""
    for shorthand, pairs in SHORTHAND_BARS.items():
        if shorthand in document:
            yield from pairs
    for name, table in document.get("joints", {}).items():
        match table:
            case {"crank": pivot} | {"slot": {"pivot": pivot}}:
                yield pivot, name
            case {"from": [first, second]}:
                yield from ((first, name), (second, name))
            case {"from": end}:
                yield end, name
            case {"on": [first, _]}:
                yield first, name


SHORTHAND_BARS = {
    "four-bar": (("O2", "A"), ("A", "B"), ("O4", "B")),
    "slider-crank": (("O2", "A"), ("A", "B")),
    "six-bar": (("O2", "A"), ("A", "B"), ("O4", "B"), ("O4", "C"), ("C", "D"), ("O6", "D")),
}
BASES: Mapping[str, Callable[[Draft], None]] = {
    "four-bar": _four_bar,
    "four-bar by its rocker": _four_bar_by_rocker,
    "slider-crank": _slider_crank,
    "six-bar": _six_bar,
    "dyad": _crank_and_dyad,
    "slider": _crank_and_slider,
    "slot": _crank_and_slot,
    "geared five-bar": _geared,
}
EXTRAS: Mapping[str, Callable[[Draft], None]] = {
    "dyad": _dyad,
    "slider": _slider,
    "slot": _slot,
    "gear": _gear,
    "point": _rigid,
}
