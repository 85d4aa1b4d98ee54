"""Whether a linkage can be put together and driven."""

from __future__ import annotations

from .linkage import Linkage
from .mechanism import mechanism


def check(linkage: Linkage) -> None:
    """Raise AssemblyError where the linkage cannot be assembled or its input cannot move."""
    mechanism(linkage)
