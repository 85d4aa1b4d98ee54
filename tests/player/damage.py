"""Files that were good once: a document with something changed in it, or its text cut and spoilt."""

from __future__ import annotations

import copy
import json
import math
from collections.abc import Iterator
from random import Random
from typing import Any

_ODD: tuple[Any, ...] = (
    *(None, True, 0, -1, 7, 1e-300, -1e15, 1e29, 10**400, math.nan, math.inf, [], {}, "", "x", "A", "\ud800"),
    *("\x1b[31m", "1e400 mm", "nan deg", "9" * 2_000, [0, 0], ["A", "A"], {"joint": "A"}, {"length": "0 mm"}),
    *("90 deg", "-5 mm", [1, 2, 3], ["O2", "A"], "\u202eevil", "a" * 3_000),
)
"""Values of every kind that may stand where they do not belong."""


def _places(value: Any) -> Iterator[tuple[Any, Any]]:
    """Yield every table and list of a document with each of its keys."""
    keys = value.keys() if isinstance(value, dict) else range(len(value)) if isinstance(value, list) else ()
    for key in keys:
        yield value, key
        yield from _places(value[key])


def damaged(document: Any, random: Random) -> bytes:
    """Return the text of a document in which up to three things are others, or its text is spoilt."""
    spoilt = copy.deepcopy(document)
    for _ in range(random.choice((1, 1, 2, 3))):
        places = list(_places(spoilt))
        if not places:
            break
        holder, key = random.choice(places)
        match random.randrange(6):
            case 0:
                del holder[key]
            case 1:
                other, where = random.choice(places)
                holder[key] = copy.deepcopy(other[where]) if where in _keys(other) else None
            case 2 if isinstance(holder, dict):
                holder[random.choice(("", "A", "O2", "x" * 300, "\ud800", "joint"))] = holder.pop(key)
            case 3 if isinstance(holder, list):
                holder.append(copy.deepcopy(holder[key]))
            case _:
                holder[key] = copy.deepcopy(random.choice(_ODD))
    text = json.dumps(spoilt).encode()
    if random.random() < 0.1:
        at = random.randrange(len(text))
        return random.choice(
            (text[:at], text[:at] + random.randbytes(3) + text[at + 3 :], b"\xff\xfe" + text)
        )
    return text


def _keys(value: Any) -> Any:
    return value.keys() if isinstance(value, dict) else range(len(value))
