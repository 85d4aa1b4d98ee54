"""Whether pygame can be used as it is installed: pygame-ce and plain pygame are in one folder."""

from __future__ import annotations

import sys
from importlib.util import find_spec
from pathlib import Path

from linkanim.errors import WorkFailed

_DISTRIBUTIONS = ("pygame", "pygame_ce")


def refuse_mixed_pygame() -> None:
    """Raise `WorkFailed` where pygame and pygame-ce lie in one folder, or what is there is not whole.

    Whichever came last works until the other is removed or renewed, which takes files of both.
    """
    spec = find_spec("pygame")
    if spec is None:
        raise WorkFailed(f"pygame is not installed; `{sys.executable} -m pip install pygame-ce` mends it")
    folder = Path(next(iter(spec.submodule_search_locations or ())))
    if all(any(folder.parent.glob(f"{name}-*.dist-info")) for name in _DISTRIBUTIONS):
        raise WorkFailed(f"pygame and pygame-ce are both installed, in one folder: {folder}; {_way_out()}")
    if spec.origin is None:
        raise WorkFailed(f"pygame is not whole in {folder}; {_way_out()}")


def _way_out() -> str:
    pip = f"{sys.executable} -m pip"
    return f"`{pip} uninstall -y pygame pygame-ce`, then `{pip} install pygame-ce` (or pygame) mends it"
