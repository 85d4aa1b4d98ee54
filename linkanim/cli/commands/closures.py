"""`linkanim closures`: all ways in which a scene's lengths can be put together."""

from __future__ import annotations

import sys
from argparse import Namespace
from collections.abc import Sequence
from pathlib import Path

from linkanim.cli.answers import target_of
from linkanim.cli.options import inputs_of
from linkanim.cli.progress import bar
from linkanim.errors import BadInput
from linkanim.export import columns, json_text
from linkanim.manifest import Output, checked_output
from linkanim.recorder.recording import SUFFIXES
from linkanim.scenes import load
from linkanim.scenes.closures import SceneClosure, closures, described
from linkanim.synthesis.answers import write
from linkanim.words import said, to_say

_TITLES = to_say("closure"), to_say("put together"), to_say("input"), to_say("class"), to_say("curve")


def run(options: Namespace) -> None:
    """Print a row, or a JSON object, for each closure; write their files, or a picture in which all run."""
    scene = load(options.scene)
    picture, files = _targets(options)
    with bar(unit=" tried") as progress:
        choices = closures(scene, progress)
    paths: list[str] = []
    if files:
        paths = [str(path) for path in write([one.scene for one in choices], files)]
    if options.json:
        print(json_text([_object(one, n) for n, one in enumerate(choices, start=1)], indent=2))
    else:
        rows = [described(choices, n) for n in range(len(choices))]
        print(columns([[*map(said, _TITLES)], *rows]))
    for path in paths:
        print(path)
    if picture:
        _draw(choices, picture)


def _targets(options: Namespace) -> tuple[Output | None, Path | None]:
    """Return the picture and the first scene file that `-o` names; BadInput for what is neither."""
    if options.output is None:
        return None, None
    if options.output.suffix.lower() == ".toml":
        return None, target_of(options.output, "", 1)
    return checked_output(options.output, "", (".toml", *SUFFIXES), inputs_of(options)), None


def _draw(choices: Sequence[SceneClosure], picture: Output) -> None:
    from linkanim.recorder.sheet import MOST_TILES, record_sheet, still_sheet

    if len(choices) > MOST_TILES:
        raise BadInput(f"a picture shows {MOST_TILES} closures at the most, and there are {len(choices)}")
    scenes = [one.scene for one in choices]
    if picture.path.suffix.lower() == ".png":
        with picture.replacing() as part:
            part.write_bytes(still_sheet(scenes))
    else:
        with bar(unit=" frames") as progress:
            print(record_sheet(scenes, picture, progress).summary, file=sys.stderr)
    print(picture.path)


def _object(one: SceneClosure, number: int) -> dict[str, object]:
    info = one.scene.info
    same = None if one.curve == number else one.curve
    facts: dict[str, object] = {"sides": one.sides, "same_curve_as": same, "class": info.class_name}
    return facts | {"full_turn": info.full_turn, "input_range": info.input_range, "joints": one.pose}
