"""Recordings: frames to GIF, MP4 and numbered PNG. Modules are imported when first asked for."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from linkanim.recorder.recording import Recording
    from linkanim.recorder.scene_frames import record

__all__ = ["Recording", "record"]

_HOME = {"Recording": "linkanim.recorder.recording", "record": "linkanim.recorder.scene_frames"}


def __getattr__(name: str) -> object:
    """Import a public name from the module it lives in; AttributeError for any other."""
    if name not in _HOME:
        raise AttributeError(f"module 'linkanim.recorder' has no attribute {name!r}")
    return getattr(import_module(_HOME[name]), name)
