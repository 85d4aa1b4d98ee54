"""`linkanim convert`: a linkage of another program, or a scene, as a scene file of points and links."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import replace

from linkanim.atomic_files import checked_target, replacing
from linkanim.scenes.files import foreign_document, load, with_points
from linkanim.scenes.foreign import is_link
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import text


def run(options: Namespace) -> None:
    """Write the scene file, and print its name and what was left out."""
    target = checked_target(options.output, (".toml",), [options.file])
    scene, left_out = _converted(options.file, target.stem)
    with replacing(target) as part:
        part.write_text(text(scene), encoding="utf-8")
    print(target)
    for one in left_out:
        print(f"left out: {one}")


def _converted(name: str, title: str) -> tuple[Scene, tuple[str, ...]]:
    foreign = foreign_document(name)
    if foreign is None:
        return with_points(load(name)), ()
    document, where, left_out = foreign
    if is_link(name):
        document["title"] = title
    made = scene_from(document, name=title, where=where)
    return replace(made, document=document), left_out
