"""What the commands that write pictures are asked alike: of which scene, how large, where to, what on it."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from linkanim.errors import BadInput
from linkanim.mechanics.motion.derived import coupler_body
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


def centres_of(scene: Scene, options: Namespace) -> int:
    """Return what of the instant centres the options ask for, as `Look.centres` says it.

    `BadInput` for centrodes where every link turns about a fixed pin, or slides.
    """
    if options.centrodes and coupler_body(scene.linkage) is None:
        raise BadInput(f"--centrodes: {scene.name} has no coupler; --instant-centres marks what there is")
    return 2 if options.centrodes else int(options.instant_centres)
