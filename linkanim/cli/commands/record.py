"""`linkanim record`: a scene's true period, a tape or a lesson, as a file; several scenes as slides."""

from __future__ import annotations

import shutil
import sys
from argparse import Namespace
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from linkanim.cli import main
from linkanim.cli.alternative import alternative, plain
from linkanim.cli.command_table import parse
from linkanim.cli.exits import DONE, FAILED
from linkanim.cli.letters import tell_of_scene
from linkanim.cli.options import inputs_of
from linkanim.cli.picture_arguments import DEFAULT, PRESETS, Preset
from linkanim.cli.picture_options import look_of, refuse_photograph
from linkanim.cli.progress import bar
from linkanim.errors import BadInput
from linkanim.letters import PDF, PIXELS
from linkanim.manifest import Output, checked_output
from linkanim.picture.layout import SMALL, layout
from linkanim.picture.look import TOGGLES, Look
from linkanim.picture.purpose import PURPOSES
from linkanim.picture.quantities import speed_words
from linkanim.recorder.plan import Clip, make_plan, refuse_size
from linkanim.recorder.recording import SUFFIXES, Progress, Recording, record
from linkanim.scenes import load
from linkanim.scenes.files import is_lesson
from linkanim.scenes.scene import Scene

if TYPE_CHECKING:
    from linkanim.player.lesson import LessonStep

_OF_A_SCENE = ("speed", "periods", "seconds", "reverse", "noted", "construction")
"""Options for which a tape has its own values, beside those of the look."""


_DECK, _VECTORS = ".pptx", ".pdf"
_SHARES = (1.0, 0.8, 0.64, 0.5, 0.4, 0.3)
_SLOWER = (20.0, 12.5, 10.0)
"""The sizes, in shares of the one asked for, and the frames a second that `--max-size` tries."""


def run(options: Namespace) -> None:
    """Record what was asked; print the file's path on stdout, and a summary on stderr."""
    preset = PRESETS.get(options.preset, DEFAULT)
    if is_lesson(options.scene):
        _record_lesson(options, preset)
        return
    if options.each:
        raise BadInput("--each is for a lesson, whose steps get a file each")
    usual = f"{_stem(options.scene)}{preset.suffix}"
    suffixes = (*SUFFIXES, _DECK, _VECTORS)
    target = checked_output(options.output, usual, suffixes, inputs_of(options), ours=options.no_clobber)
    suffix = target.path.suffix.lower()
    if suffix != _DECK and (options.more or options.titles):
        what = "several scenes are" if options.more else "--titles is"
        raise BadInput(f"{what} for slides; write them with -o {target.path.stem}.pptx")
    if _is_tape(options) and options.alt:
        raise BadInput("--alt is for a scene; what a tape shows is what was done in it")
    told = alternative(options)
    with bar(shown=options.progress) as progress:
        if suffix == _DECK:
            summary = _slides(options, target, progress)
        elif suffix == _VECTORS:
            summary = _pages(options, target)
        else:
            summary, target = _recorded(options, target, progress)
    print(summary, file=sys.stderr)
    print(target.path)
    if options.alt:
        told(_words(options))


def _recorded(options: Namespace, target: Output, progress: Progress | None) -> tuple[str, Output]:
    """Record a scene or a tape; return the summary, and the output with the path of the first frame."""
    most = options.max_size
    if most is None:
        made = _at(options, target, progress)
        return made.summary, replace(target, path=made.path)
    if target.path.suffix.lower() == ".png":
        raise BadInput("--max-size is for one file; numbered frames are many")
    with TemporaryDirectory() as folder, target.replacing() as part:
        again = Path(folder) / target.path.name
        for tried in _smaller(options):
            made = _at(tried, Output(again), progress)
            if made.file_bytes <= most:
                shutil.copyfile(again, part)
                return replace(made, path=target.path).summary, target
        wide, high = made.size
        raise BadInput(
            f"--max-size: at {wide}x{high} and {float(made.plan.rate):g} frames a second it still has"
            f" {made.file_bytes / 1e6:.2f} MB; raise it, or record a shorter period with --speed"
        )


def _smaller(options: Namespace) -> Iterator[Namespace]:
    """Yield the options with ever smaller pictures, and for each ever fewer frames a second."""
    preset = PRESETS.get(options.preset, DEFAULT)
    (width, height), fps = options.size or preset.size, options.fps or preset.fps
    for share in _SHARES:
        size = (2 * round(share * width / 2), 2 * round(share * height / 2))
        for rate in (fps, *(slower for slower in _SLOWER if slower < fps)):
            yield Namespace(**{**vars(options), "size": size, "fps": rate})


def _at(options: Namespace, target: Output, progress: Progress | None) -> Recording:
    """Record a scene or a tape at the size and the rate of the options."""
    preset = PRESETS.get(options.preset, DEFAULT)
    size = None if _is_tape(options) and not options.preset else preset.size
    pixels: tuple[int, int] | None = options.size or size
    scale = letters_for(preset, pixels or preset.size)
    work = _of_tape(options) if _is_tape(options) else _of_scene(options, target.path, scale)
    return work(target, size=pixels, fps=options.fps or preset.fps, progress=progress)


def _slides(options: Namespace, target: Output, progress: Progress | None) -> str:
    """Write a slide for each scene or tape; return what was written."""
    from linkanim.paper.deck import DeckSlide, below_title, deck

    shape = options.size or PRESETS["slides"].size
    size = below_title(shape) if options.titles else shape
    scenes = [scene for scene in (options.scene, *options.more) if not scene.lower().endswith(".json")]
    titles, slides = {scene: load(scene).title for scene in scenes}, []
    with TemporaryDirectory() as folder:
        for n, scene in enumerate((options.scene, *options.more)):
            how = {"scene": scene, "size": size, "preset": options.preset or "slides"}
            how |= {"hud": False} if options.titles else {}
            asked = Namespace(**{**vars(options), **how})
            made, _ = _recorded(asked, Output(gif := Path(folder) / f"{n}.gif"), progress)
            notes = made if _is_tape(asked) else plain(_words(asked))
            slides.append(DeckSlide(gif.read_bytes(), size, titles.get(scene, _stem(scene)), notes))
    with target.replacing() as part:
        part.write_bytes(deck(slides, shape, titled=options.titles))
    count = f"{len(slides)} slides" if len(slides) > 1 else "one slide"
    return f"{target.path}: {count}, {target.path.stat().st_size / 1e6:.2f} MB; each loops by itself"


def _pages(options: Namespace, target: Output) -> str:
    """Write the frames of a period as the pages of a PDF, in vectors; return what LaTeX is to be told."""
    from linkanim.paper.figure import moving

    if _is_tape(options) or options.construction or options.max_size:
        raise BadInput("the pages of a PDF are a scene's motion; record a tape as a GIF, or leave that out")
    preset = PRESETS.get(options.preset, DEFAULT)
    size = options.size or preset.size
    scene = load(options.scene)
    refuse_size(size)
    speed = scene.linkage.drive.speed if options.speed is None else options.speed
    fps = options.fps or preset.fps
    length = (options.periods or 1, options.seconds, options.reverse)
    plan = make_plan(Clip(speed, scene.period, fps, *length), "pdf")
    look = replace(look_of(scene, options), type_scale=letters_for(preset, size), material="flat")
    tell_of_scene(scene, PDF, title=look.hud, names=look.names > 0)
    with target.replacing() as part:
        part.write_bytes(moving(scene, size, look, map(plan.phase, range(plan.frames)), plan.speed))
    return (
        f"{target.path}: {plan.frames} pages, {target.path.stat().st_size / 1e6:.2f} MB; in LaTeX, with the"
        f" package animate: \\animategraphics[loop,autoplay,width=\\linewidth]{{{float(plan.rate):g}}}"
        f"{{{target.path.stem}}}{{}}{{}}"
    )


def _is_tape(options: Namespace) -> bool:
    return bool(options.scene.lower().endswith(".json"))


def _record_lesson(options: Namespace, preset: Preset) -> None:
    """Record a lesson: in one file, in one for each step, or as a slide for each; print the paths."""
    from linkanim.player.lesson import read
    from linkanim.recorder.lessons import record_lesson, record_step

    _refuse_fixed_options(options, "a lesson", ("theme", "material"))
    for name in ("more", "titles", "max_size", "alt", "photo"):
        if getattr(options, name):
            word = "a further scene" if name == "more" else f"--{name.replace('_', '-')}"
            raise BadInput(f"{word} is not for a lesson; leave it out")
    steps, usual = read(Path(options.scene)), f"{_stem(options.scene)}{preset.suffix}"
    how: dict[str, Any] = {"size": options.size or preset.size, "fps": options.fps or preset.fps}
    how["look"] = Look(theme=options.theme, material=options.material)

    def target(name: Path) -> Output:
        named = None if options.output is None else str(name)
        suffixes = (*SUFFIXES, *(() if options.each else (_DECK,)))
        return checked_output(named, name.name, suffixes, [options.scene], ours=options.no_clobber)

    whole = Path(options.output or usual)
    if not options.each:
        output = target(whole)
        with bar(shown=options.progress) as progress:
            if output.path.suffix.lower() == _DECK:
                summary = _deck_of(steps, output, how)
            else:
                summary = record_lesson(steps, output, **how, progress=progress).summary
        print(summary, file=sys.stderr)
        print(output.path)
        return
    targets = [target(whole.with_stem(f"{whole.stem}-{n}")) for n in range(1, len(steps) + 1)]
    for step, one in zip(steps, targets, strict=True):
        with bar(shown=options.progress) as progress:
            recording = record_step(step, one, **how, progress=progress)
        print(recording.summary, file=sys.stderr)
        print(recording.path)


def _deck_of(steps: Sequence[LessonStep], target: Output, how: dict[str, Any]) -> str:
    """Write a slide for each step, its caption as the notes; return what was written."""
    from linkanim.paper.deck import DeckSlide, deck
    from linkanim.recorder.lessons import record_step

    slides = []
    with TemporaryDirectory() as folder:
        for n, step in enumerate(steps):
            record_step(step, Output(gif := Path(folder) / f"{n}.gif"), **how)
            notes = step.scene.look_at if step.look.caption else ""
            slides.append(DeckSlide(gif.read_bytes(), how["size"], step.scene.title, notes))
    with target.replacing() as part:
        part.write_bytes(deck(slides, how["size"]))
    return f"{target.path}: {len(slides)} slides, {target.path.stat().st_size / 1e6:.2f} MB"


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
    _refuse_fixed_options(options, "a tape")
    # It imports the player, building and the games, which a scene without a tape does not need.
    from linkanim.recorder.tape_frames import record_tape

    return partial(record_tape, options.scene, photo=options.photo)


def _refuse_fixed_options(options: Namespace, what: str, free: Collection[str] = ()) -> None:
    """Refuse an option that a tape or a lesson fixes."""
    usual = parse(["record", options.scene])
    for name in (*_OF_A_SCENE, *TOGGLES):
        value = getattr(options, name, None)
        if name not in free and value != getattr(usual, name, None):
            word = _word(name, value)
            raise BadInput(f"{word} is for a scene; {what} keeps its own (--size, --fps and --for are free)")


def _word(name: str, value: object) -> str:
    """Return the option that gives a field this value."""
    options = TOGGLES[name].options if name in TOGGLES else ()
    option = next((option.name for option in options if option.step in (None, value)), name)
    return f"--no-{option}" if value is False and option == name else f"--{option}"


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
