"""`linkanim closures`: every way in which a linkage can be put together, as a list and as pictures."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator, Mapping

from linkanim.atomic_files import checked_target, replacing
from linkanim.cli.options import inputs_of
from linkanim.export import columns, json_text
from linkanim.scenes import load
from linkanim.scenes.closures import FoundClosure, closures


def run(options: Namespace) -> None:
    """Print the closures in words or JSON, and draw their sheet."""
    target = checked_target(options.output, (".png", ".gif"), inputs_of(options)) if options.output else None
    scene = load(options.scene)
    found = closures(scene)
    if target is not None:
        with replacing(target) as part:
            part.write_bytes(_sheet(found, target.suffix.lower()))
    if options.json:
        print(json_text([_object(one) for one in found], indent=2))
    else:
        print(columns([["closure", "input", "sides", "motion"], *_rows(found)]))
        if target is not None:
            print(target)


def _rows(found: list[FoundClosure]) -> Iterator[list[str]]:
    for number, one in enumerate(found, start=1):
        sides = ", ".join(f"{name} {side}" for name, side in one.sides.items()) or "-"
        motion = f"that of closure {one.same_as}" if one.same_as else "its own"
        yield [str(number), one.scene.info.motion_words, sides, motion]


def _object(one: FoundClosure) -> Mapping[str, object]:
    joints = {name: [place.real, place.imag] for name, place in one.places.items()}
    info = one.scene.info
    told = {"joints": joints, "input_range": info.input_range, "class": info.class_name}
    return told | {"sides": dict(one.sides), "same_as": one.same_as}


def _sheet(found: list[FoundClosure], suffix: str) -> bytes:
    from linkanim.recorder.gallery import contact_sheet, running_sheet

    scenes = [one.scene for one in found]
    return contact_sheet(scenes) if suffix == ".png" else running_sheet(scenes)
