"""JSON that every reader takes: what is not a finite number is null."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence


def json_text(value: object, *, indent: int | None = None) -> str:
    """Return the value as strict JSON; NaN and infinities, at any depth, are null."""
    return json.dumps(finite(value), indent=indent, allow_nan=False, ensure_ascii=False)


def finite(value: object) -> object:
    """Return the value with None in the place of every float that is not finite."""
    if isinstance(value, float):
        return float(value) if math.isfinite(value) else None
    if isinstance(value, Mapping):
        return {key: finite(part) for key, part in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [finite(part) for part in value]
    return value
