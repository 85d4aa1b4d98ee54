"""What the commands that write a single picture are asked alike: of which scene, how large, and where to."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path
from typing import NamedTuple

from linkanim.recorder.plan import refuse_size
from linkanim.scenes import load
from linkanim.scenes.scene import Scene
from linkanim.whole import checked_target

_SIZE = (1280, 720)


class Sheet(NamedTuple):
    """A picture to be written: its scene, its size in pixels, and the file."""

    scene: Scene
    size: tuple[int, int]
    target: Path


def sheet(options: Namespace, suffixes: tuple[str, ...], usual: str) -> Sheet:
    """Return the picture asked for, by default named after its scene; `BadInput` for a bad size or file."""
    target = checked_target(options.output or f"{Path(options.scene).stem}{usual}", suffixes)
    size = options.size or _SIZE
    refuse_size(size)
    return Sheet(load(options.scene), size, target)
