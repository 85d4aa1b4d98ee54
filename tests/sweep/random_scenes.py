"""Random scene files: linkages of every kind with all that a file may say, the catalogue changed, extremes.

Each is told by a seed and a number, so that a failure is made again from its own line. Not all of them are
good: who asks keeps those that the reader takes.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from random import Random
from typing import Any

from typed_linkages import SHORTHAND_BARS, Document, linkages

from linkanim.scenes import load, names

CATALOGUE = {name: json.loads(json.dumps(load(name).document)) for name in names()}
CIRCLE = ("0 deg", "90 deg", "30 deg", "-107.47 deg", "180 deg", "1e-300 rad", "600 rad", "36000 deg")
TEXTS = (
    "",
    " ",
    "\u00a0",
    "x",
    "a title as people write them",
    "long " * 199,
    "W" * 1000,
    "机构与机器",
    "שלום עולם",
    "e\u0301\u0323" * 40,
    "🦾👩\u200d🔧",
    "_{}_{x}",
    "<b>&amp;\"'</b>",
    "=1+2",
    r"\input{/etc/passwd} $x^2$ % #1 ~ \\",
    "</script><img src=x onerror=alert(1)>",
    "*bold* `code` [link](javascript:alert(1)) | # $a$",
)
NAMES = (
    *("Q", "机", "é", "שלום", "🦾", "n" * 32, "-1", "a_b", "=A1", "<i>", "P2", "O2'", "G2", "٣", "Ŀħ", "a b"),
    *("constructor", "toString", "__proto__", "hasOwnProperty", "valueOf", "length"),  # JavaScript's
    *(r"\input{x}", "$x$", "%", "#1", "a&b", "~", "^2", "{", "x}", "\\"),  # LaTeX's
    *("con", "AUX", "nul", "COM1", "a/b", "C:x", "a|b", "a?b", "*", '"'),  # Windows'
    *("`x`", "[x](y)", "</g>", "]]>", "None", "nan", "1e5"),
)
NUMBERS = (1e-300, 5e-324, 1e-30, 1e-28, 1e-12, 1e-7, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e7, 1e9, 3e14, 1e20, 1e300)
SCALES = (1e-80, 1e-13, 1e-10, 1e-7, 1e-3, 1e3, 1e6, 1e9, 3e10, 1e12, 1e80)
UNITS = ("mm", "cm", "m", "in")
SPEEDS = ("20 rpm", "-20 rpm", "1e-29 rad/s", "1e9 rpm", "1e29 rad/s", "-0.5 deg/s")
RATIOS = (-3, -2, -1, 2, 3, 5, 12, 100, "1/3", "-5/12", "1/12")


def scene(seed: int, number: int) -> tuple[str, Document]:
    """Return a scene file's document and the words for how it was made."""
    rng = Random(f"{seed}:{number}")
    name, start = rng.choice(tuple(STARTS.items()))
    document = start(rng)
    words = [name]
    for what, change in (("further joints", _joined), ("decorated", _decorated), ("extreme", _pushed)):
        if rng.random() < SHARE[what]:
            change(rng, document)
            words.append(what)
    return ", ".join(words), document


def named(seed: int, number: int) -> Document:
    """Return a scene file's document, of usual sizes, all of whose bars and sliders are named bodies."""
    rng = Random(f"{seed}:{number}")
    document = rng.choice(tuple(STARTS.values()))(rng)
    if rng.random() < SHARE["further joints"]:
        _joined(rng, document)
    if rng.random() < SHARE["comes back as it went"]:
        document.setdefault("drive", {})["returns"] = "same"
    if "bodies" not in document:
        bars = dict.fromkeys(bars_of(document))
        sliding = (name for name, table in document.get("joints", {}).items() if {"line", "slide"} & {*table})
        bodies = {f"{n}": {"joints": list(bar)} for n, bar in enumerate(bars, 2)}
        document["bodies"] = bodies | {f"slider{n}": {"slider": name} for n, name in enumerate(sliding)}
    if rng.random() < SHARE["further joints"]:
        _strut(rng, document)
    return document


SHARE = {"comes back as it went": 0.2, "further joints": 0.3, "decorated": 0.7, "extreme": 0.4}


def _typed(rng: Random) -> Document:
    document = next(linkages(rng.getrandbits(32), 1))[1]
    return json_copy(document)


def _from_the_catalogue(rng: Random) -> Document:
    return json_copy(CATALOGUE[rng.choice(sorted(CATALOGUE))])


def _by_a_cylinder(rng: Random) -> Document:
    arm, ground = rng.randint(1, 100), rng.randint(1, 100)
    low, high = abs(ground - arm), ground + arm
    first, last = (low + (high - low) * rng.choice((0, 0.1, 0.5, 0.7, 1)) for _ in range(2))
    return {
        "drive": {
            "cylinder": {"between": ["G", "A"], "from": first, "to": last},
            "start": rng.choice(CIRCLE),
        },
        "ground": {"O2": [0, 0], "G": {"length": ground, "angle": rng.choice(CIRCLE)}},
        "joints": {"A": {"crank": "O2", "length": arm}},
    }


def _by_a_slider(rng: Random) -> Document:
    crank, rod = rng.randint(1, 60), rng.randint(1, 150)
    near, far = abs(rod - crank), rod + crank
    first, last = (near + (far - near) * rng.choice((0, 0.1, 0.5, 0.7, 1)) for _ in range(2))
    dyad = {"from": ["C", "O2"], "length": [rod, crank], "side": rng.choice(("left", "right"))}
    return {
        "drive": {"slider": {"joint": "C", "from": first, "to": last}},
        "ground": {"O2": [0, 0]},
        "joints": {"C": {"line": {"through": "O2", "angle": rng.choice(CIRCLE)}}, "A": dyad},
    }


def _gears(rng: Random) -> Document:
    joints: Document = {"A": {"crank": "O2", "length": rng.choice((1, 30, 1e-6))}}
    for k in range(rng.randint(1, 4)):
        ratio, pivot = rng.choice(RATIOS), rng.choice(("O2", "O4", *joints))
        gear = {"with": rng.choice(tuple(joints)), "ratio": ratio, "offset": rng.choice(CIRCLE)}
        joints[f"B{k}"] = {"crank": pivot, "length": rng.choice((1, 20, 1e-6, 1e3)), "gear": gear}
    return {"ground": {"O2": [0, 0], "O4": [rng.choice((0, 50, 1e-28, 1e-9)), 0]}, "joints": joints}


def chain(dyads: int, *, weighed: bool = False) -> Document:
    """Return a crank that moves so many rockers, each by the one before, each with a pin of its own.

    If `weighed` each link between them has a mass, an inertia and its centre of mass beside it.
    """
    ground: Document = {"O2": [0, 0]}
    joints: Document = {"A": {"crank": "O2", "length": 10}}
    bodies, before = {}, "A"
    for n in range(1, dyads + 1):
        name, pin = f"D{n}", f"O{n + 2}"
        ground[pin] = [40 * n, 0]
        joints[name] = {"from": [before, pin], "length": [42 if n == 1 else 40, 25], "side": "left"}
        bodies[f"b{n}"] = {"joints": [before, name], "com": [20, 3], "mass": "1 kg", "inertia": "0.01 kg m^2"}
        before = name
    more: Document = {"gravity": "9.81 m/s^2", "bodies": bodies} if weighed and dyads else {}
    return {"ground": ground, "joints": joints, **more}


def _chain(rng: Random) -> Document:
    return chain(rng.choice((0, 1, 2, 5, 10, 20, 40, 62)), weighed=rng.random() < 0.5)


STARTS: Mapping[str, Callable[[Random], Document]] = {
    "typed": _typed,
    "typed again": _typed,
    "catalogue": _from_the_catalogue,
    "catalogue again": _from_the_catalogue,
    "cylinder": _by_a_cylinder,
    "slider": _by_a_slider,
    "gears": _gears,
    "chain": _chain,
}


def json_copy(document: Document) -> Document:
    """Return a copy of plain tables, lists and values."""
    copied: Document = json.loads(json.dumps(document))
    return copied


def _moving(document: Document) -> list[str]:
    short = (name for key, pairs in SHORTHAND_BARS.items() if key in document for _, name in pairs)
    return [*dict.fromkeys((*short, *document.get("joints", {})))]


def _known(document: Document) -> list[str]:
    pins = {"four-bar": ["O2", "O4"], "six-bar": ["O2", "O4", "O6"], "slider-crank": ["O2"]}
    short = [name for key, found in pins.items() if key in document for name in found]
    return [*dict.fromkeys((*short, *document.get("ground", {}), *_moving(document)))]


def bars_of(document: Document) -> list[tuple[str, str]]:
    short = [pair for key, pairs in SHORTHAND_BARS.items() if key in document for pair in pairs]
    for name, table in document.get("joints", {}).items():
        match table:
            case {"crank": pivot} | {"slot": {"pivot": pivot}}:
                short.append((pivot, name))
            case {"from": [first, second]}:
                short += [(first, name), (second, name)]
            case {"from": str(end)}:
                short.append((end, name))
            case {"on": [first, _]}:
                short.append((first, name))
    return short


def _joined(rng: Random, document: Document) -> None:
    """Add a joint of a kind that typed linkages lack; a form of points and links has its own."""
    if "points" in document:
        return
    known, moving, bars = _known(document), _moving(document), bars_of(document)
    name, length = rng.choice(NAMES), rng.choice((1, 10, 40, 200, 1e7, 1e-6))
    line: Document = {"through": rng.choice(known), "angle": rng.choice(CIRCLE), "offset": rng.choice((0, 3))}
    if rng.random() < 0.5:
        line["on"] = list(rng.choice(bars))
    tables: tuple[Document, ...] = (
        {"from": rng.choice(known), "length": length, "line": line},
        {"slide": {"pin": rng.choice(moving), "line": line, "slot": rng.choice(("90 deg", "60 deg"))}},
        {"slot": {"pivot": rng.choice(known), "through": rng.choice(known)}, "length": length},
        {
            "crank": rng.choice(known),
            "length": length,
            "gear": {"with": rng.choice(moving), "ratio": rng.choice(RATIOS)},
        },
        {"on": list(rng.choice(bars)), "at": [rng.choice((0, length)), length]},
    )
    document.setdefault("joints", {})[name] = rng.choice(tables)


def _decorated(rng: Random, document: Document) -> None:
    """Add what is drawn, named and weighed: bodies, struts, traces, texts, units, speeds."""
    for _ in range(rng.randint(1, 5)):
        rng.choice(DECORATIONS)(rng, document)


def _text(rng: Random, document: Document) -> None:
    document[rng.choice(("title", "source", "chapter", "look_at"))] = rng.choice(TEXTS)
    document["notes"] = [rng.choice(TEXTS) for _ in range(rng.randint(0, 3))]


def _trace(rng: Random, document: Document) -> None:
    known = _known(document)
    document["trace"] = {"joints": rng.sample(known, rng.randint(0, min(3, len(known))))}


def _strut(rng: Random, document: Document) -> None:
    known = _known(document)
    if len(known) > 1:
        between = rng.sample(known, 2)
        stiff: Document = {
            "stiffness": rng.choice(("4 N/mm", "1e29 N/m")),
            "free_length": rng.choice((30, 1e11)),
        }
        damping: Document = {"coefficient": rng.choice(("200 N s/m", "1e-29 N s/m"))}
        kind, more = rng.choice((("springs", stiff), ("dampers", damping), ("springs", {}), ("dampers", {})))
        document.setdefault(kind, {})[rng.choice(NAMES)] = {"between": between, **more}


def _meeting(rng: Random, document: Document) -> None:
    """Put a strut between joints that are one place, now and then or always."""
    known = _known(document)
    name = rng.choice(NAMES)
    ground = document.setdefault("ground", {})
    place = ground.get(rng.choice(tuple(ground) or ("",)), [0, 0])
    if name not in known and known:
        ground[name] = place
        kind = rng.choice(("springs", "dampers"))
        document.setdefault(kind, {})["meets"] = {"between": [name, rng.choice(known)]}


def _body(rng: Random, document: Document) -> None:
    bars = bars_of(document)
    if not bars:
        return
    table: Document = {"joints": list(rng.choice(bars))}
    if rng.random() < 0.6:
        table |= {
            "com": [rng.choice((0, 10, 1e-28, 1e6)), rng.choice((0, -5))],
            "mass": rng.choice(("3 kg", "1e26 t")),
        }
        table |= {"inertia": "0.02 kg m^2"} if rng.random() < 0.5 else {}
        document["gravity"] = rng.choice(("9.81 m/s^2", "1e-29 m/s^2"))
    if rng.random() < 0.6:
        table["look"] = rng.choice(("bar", "plate", "wheel", "slot", "none"))
    if rng.random() < 0.3:
        table["colour"] = rng.choice(("#000000", "#ffffff", "#d55e00"))
    name = rng.choice(("2", "3", *NAMES))
    document.setdefault("bodies", {})[name] = table
    _load(name, document)


def _load(body: str, document: Document) -> None:
    """Load a body in every other scene, some without end."""
    size = ("50 N", "-1e29 N", "1e-28 kN")[len(document["bodies"]) % 3]
    if len(document.get("joints", {})) % 2:
        load = {"on": body, "at": [5, -3], "force": [size, "2 N"], "torque": "-0.3 N m"}
        document.setdefault("loads", {})[f"on {body}"[:32]] = load


def _slider_body(rng: Random, document: Document) -> None:
    sliding = [name for name, table in document.get("joints", {}).items() if {"line", "slide"} & table.keys()]
    if sliding:
        # the value first, as it is first in the order of random numbers
        slider, name = rng.choice(sliding), rng.choice(NAMES)
        document.setdefault("bodies", {})[name] = {"slider": slider}
        _load(name, document)


def _unit(rng: Random, document: Document) -> None:
    document["length_unit"] = rng.choice(UNITS)


def _photo(rng: Random, document: Document) -> None:
    document["photo"] = {
        "file": rng.choice(("photo.png", "photo.png", "none.png", "a folder/of mine/é.png")),
        "place": [rng.choice((0, -50, 1e6)), 0],
        "width": rng.choice((100, 1e-3, 1e6)),
        "turn": rng.choice(CIRCLE),
    }


def _drive(rng: Random, document: Document) -> None:
    drive = document.setdefault("drive", {})
    drive["speed"] = rng.choice(SPEEDS)
    if "slider" not in drive:
        drive["start"] = rng.choice(CIRCLE)


DECORATIONS = (
    _text,
    _trace,
    _trace,
    _strut,
    _strut,
    _meeting,
    _body,
    _body,
    _slider_body,
    _unit,
    _drive,
    _photo,
)


def _pushed(rng: Random, document: Document) -> None:
    """Push numbers to extremes: all by one factor, one alone, one made as another, one made nothing."""
    for _ in range(rng.randint(1, 2)):
        places = list(_numbers(document))
        if not places:
            return
        holder, key = rng.choice(places)
        match rng.randrange(5):
            case 0 | 1:
                factor = rng.choice(SCALES)
                for table, name in places:
                    table[name] *= factor
            case 2:
                holder[key] = rng.choice((-1, 1, 1, 1)) * rng.choice(NUMBERS)
            case 3:
                other, name = rng.choice(places)
                holder[key] = other[name]
            case _:
                holder[key] = rng.choice((0, 0.0, holder[key] * (1 + 2**-52), holder[key] * 1e-15))


def _numbers(inside: Any) -> Iterator[tuple[Any, Any]]:
    """Yield (table or list, key) of each number that is a length or a coordinate."""
    pairs = list(inside.items() if isinstance(inside, dict) else enumerate(inside))
    for key, value in pairs:
        if isinstance(value, dict | list):
            yield from _numbers(value)
        elif isinstance(value, int | float) and not isinstance(value, bool) and key != "ratio":
            yield inside, key
