"""A scene: a linkage with its title, its source and what to trace, ready to be solved."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from linkanim.mechanics.linkage import Linkage


@dataclass(frozen=True)
class Scene:
    """A linkage to show; lengths in `length_unit`, angles in radians."""

    name: str
    title: str
    source: str
    length_unit: str
    linkage: Linkage
    trace: tuple[str, ...] = ()
    document: Mapping[str, Any] = field(default_factory=dict, repr=False, compare=False)
    """The scene file as it was read, for editing and writing it back."""
