"""What the commands that write a single picture are asked alike: of which scene, how large, and where to."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from linkanim.recorder.plan import refuse_size
from linkanim.scenes import load
from linkanim.scenes.scene import Scene
from linkanim.whole import checked_target

_SIZE = (1280, 720)


def scene_size_target(
    options: Namespace, suffixes: tuple[str, ...], usual: str
) -> tuple[Scene, tuple[int, int], Path]:
    """Return the scene, the size in pixels, and the file, by default named after the scene.

    `BadInput` for a size or a file that cannot be.
    """
    target = checked_target(options.output or f"{Path(options.scene).stem}{usual}", suffixes)
    size = options.size or _SIZE
    refuse_size(size)
    return load(options.scene), size, target
