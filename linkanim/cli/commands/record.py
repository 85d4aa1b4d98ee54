"""`linkanim record`: a scene's true period, or a tape, as a file."""

from __future__ import annotations

import sys
from argparse import Namespace
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

from linkanim.cli import main
from linkanim.cli.alternative import alternative
from linkanim.cli.command_table import parse
from linkanim.cli.exits import DONE, FAILED
from linkanim.cli.letters import tell_of_scene
from linkanim.cli.options import DEFAULT, PRESETS, Preset, inputs_of
from linkanim.cli.picture_options import look_of, refuse_photograph
from linkanim.cli.progress import bar
from linkanim.errors import BadInput
from linkanim.letters import PIXELS
from linkanim.manifest import checked_output
from linkanim.picture.layout import SMALL, layout
from linkanim.picture.look import TOGGLES
from linkanim.picture.purpose import PURPOSES
from linkanim.picture.quantities import speed_words
from linkanim.recorder.recording import SUFFIXES, Recording, record
from linkanim.scenes import load
from linkanim.scenes.scene import Scene

_OF_A_SCENE = ("speed", "periods", "seconds", "reverse", "noted", "construction")
"""Options for which a tape has its own values, beside those of the look."""


def run(options: Namespace) -> None:
    """Record what was asked; print the file's path on stdout, and a summary on stderr."""
    preset = PRESETS.get(options.preset, DEFAULT)
    is_tape = options.scene.lower().endswith(".json")
    usual = f"{_stem(options.scene)}{preset.suffix}"
    target = checked_output(options.output, usual, SUFFIXES, inputs_of(options), ours=options.no_clobber)
    if is_tape and options.alt:
        raise BadInput("--alt is for a scene; what a tape shows is what was done in it")
    told = alternative(options)
    size = None if is_tape and not options.preset else preset.size
    pixels: tuple[int, int] | None = options.size or size
    with bar(shown=options.progress) as progress:
        scale = letters_for(preset, pixels or preset.size)
        work = _of_tape(options) if is_tape else _of_scene(options, target.path, scale)
        recording = work(target, size=pixels, fps=options.fps or preset.fps, progress=progress)
    print(recording.summary, file=sys.stderr)
    print(recording.path)
    if options.alt:
        told(_words(options))


def letters_for(preset: Preset, size: tuple[int, int]) -> float:
    """Return how many times larger than usual letters are for a purpose: on a slide as its figures' are."""
    if not preset.projected:
        return 1.0
    usual = SMALL * layout(size).unit
    return max(PURPOSES["slide"]._replace(pixels=size[0]).type_scale(usual), 1.0)


def _words(options: Namespace) -> str:
    """Return what a recording of a scene shows, in a paragraph."""
    from linkanim.paper.curves import Pace
    from linkanim.paper.sentences import of_motion

    scene = load(options.scene)
    speed = scene.linkage.drive.speed if options.speed is None else options.speed
    speed = -speed if options.reverse else speed
    return of_motion(scene, Pace(speed, speed_words(scene, speed)))


def _stem(source: str) -> str:
    """Return the name of a scene, a scene file or a tape without its folder and ending."""
    return Path(source).name.removesuffix(".json").removesuffix(".tape").removesuffix(".toml")


def _of_scene(options: Namespace, target: Path, type_scale: float) -> Callable[..., Recording]:
    if options.photo:
        raise BadInput("--photo is for a tape, whose sheet has a photograph behind it")
    scene = load(options.scene)
    refuse_photograph(scene, target)
    asked = {name: getattr(options, name) for name in _OF_A_SCENE}
    look = replace(look_of(scene, options), type_scale=type_scale)
    tell_of_scene(scene, PIXELS, title=look.hud, names=look.names > 0)
    asked |= {"periods": options.periods or 1, "look": look}
    if options.construction:
        asked |= _construction(scene, options)
    return partial(record, scene, **asked)


def _construction(scene: Scene, options: Namespace) -> dict[str, object]:
    """Return the arguments of `record` for a construction; `BadInput` for options of a motion."""
    from linkanim.picture.constructed import clear_phase, usual_kind

    for name in ("periods", "seconds", "reverse"):
        if getattr(options, name):
            raise BadInput(f"--{name} is for a motion; a construction takes a second for each of its steps")
    kind, steps = options.construction
    kind = kind or usual_kind(scene)
    start = clear_phase(scene) if kind == "centres" else 0.0
    return {"construction": kind, "steps": steps, "start": start}


def _of_tape(options: Namespace) -> Callable[..., Recording]:
    """Return the function that records a tape; `BadInput` for an option that the tape itself settles."""
    usual = parse(["record", options.scene])
    for name in (*_OF_A_SCENE, *TOGGLES):
        found = getattr(options, name, None)
        if found != getattr(usual, name, None):
            word = _word(name, found)
            raise BadInput(f"{word} is for a scene; a tape keeps its own (--size, --fps and --for are free)")
    # It imports the player, building and the games, which a scene without a tape does not need.
    from linkanim.recorder.tape_frames import record_tape

    return partial(record_tape, options.scene, photo=options.photo)


def _word(name: str, found: object) -> str:
    """Return the option that gives a field this value."""
    options = TOGGLES[name].options if name in TOGGLES else ()
    option = next((option.name for option in options if option.step in (None, found)), name)
    return f"--no-{option}" if found is False and option == name else f"--{option}"


def record_all(words: list[str]) -> int:
    """Record TAPE TARGET SIZE TAPE TARGET SIZE ... in turn, the recordings that a closing window leaves.

    An empty size is that of the tape. A tape that cannot be recorded does not stop the others; a signal does.
    Returns the last exit code.
    """
    code = DONE
    for tape, target, size in zip(words[::3], words[1::3], words[2::3], strict=True):
        code = main(["record", tape, "--no-clobber", "-o", target, *(["--size", size] if size else [])])
        if code not in (DONE, FAILED, BadInput.exit_code):
            break
    return code


if __name__ == "__main__":
    sys.exit(record_all(sys.argv[1:]))
