"""The packages that only the comparison needs."""

from __future__ import annotations

from collections.abc import Callable
from importlib.util import find_spec

from linkanim.errors import BadInput

NEEDED = ("mpmath", "pylinkage", "numba", "scipy", "matplotlib")


def require_extra(found: Callable[[str], object] = find_spec) -> None:
    """Raise BadInput where a package of the extra is not installed, naming what installs it."""
    missing = [name for name in NEEDED if found(name) is None]
    if missing:
        raise BadInput(
            f"bench compares with {', '.join(missing)}, which {'is' if len(missing) == 1 else 'are'} not "
            'installed; install with: pip install "linkanim[bench]"'
        )
