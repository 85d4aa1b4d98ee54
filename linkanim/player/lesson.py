"""A lesson: states that are worth showing, one after the other, and the file in which they are kept.

A step has a mechanism, its pose or that it runs, its speed, what is shown beside it, and a caption. To show
one is a single action, which has the whole step in it, so that a tape needs no other file.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from linkanim import atomic_files, intake
from linkanim.errors import BadInput, LinkanimError
from linkanim.frozen import frozen
from linkanim.intake import Intake, Section, meant
from linkanim.picture.look import ConstructionKind, Look
from linkanim.picture.quantities import chart_tokens
from linkanim.player import rules, stored
from linkanim.player.action import Action, Value
from linkanim.player.clock import Clock
from linkanim.player.edits import put_scene
from linkanim.player.keys import BACK_BAR, BarEntry, KeyRow, ModeKeys, TypedKeys, enter, on
from linkanim.player.making import Construction
from linkanim.player.state import Mode, Resolver, Rule, State, fresh, with_effect
from linkanim.scenes import load, names
from linkanim.scenes.files import in_its_form, path_of
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import content, parse
from linkanim.units import angle, length, shown, significant
from linkanim.words import said

if TYPE_CHECKING:
    from linkanim.player.hand import Outside

LESSON_FILE = Intake("a lesson", most_bytes=1_000_000, most_values=100_000)
MOST_STEPS = 200
"""The most steps of a lesson."""
_LONGEST, _MOST_SECONDS = 300, 600.0
"""The longest caption, in characters, and the longest that a step lasts in a recording."""
_KEYS = ("scene", "pose", "phase", "running", "speed", "seconds", "caption", "shown")
_OF_THE_WINDOW = ("theme", "material", "background", "caption")
"""Fields of the look that no step has: the lecturer's choice for a room, and what follows from a caption."""
_SAME = 1e-9
"""By how much (rad) a phase may be off the one that its input's place gives."""


@frozen
class LessonStep:
    """A step of a lesson: its scene with its speed and caption, and how that is shown.

    `construction` is how many steps of the scene's constructions are drawn. In a recording it lasts so many
    `seconds`; None for one period, or a few seconds where it stands.
    """

    scene: Scene
    phase: float = 0.0
    running: bool = True
    look: Look = Look()
    construction: int = 0
    seconds: float | None = None

    def text(self, number: int, count: int) -> str:
        """Return the step, the `number`-th of `count`, as the value of the action that shows it."""
        scene = {"name": self.scene.name, "document": self.scene.document}
        values: dict[str, Any] = {
            "step": [number, count],
            "scene": scene,
            "look": stored.written_look(self.look),
        }
        values |= {"phase": self.phase, "running": self.running, "construction": self.construction}
        import json

        return json.dumps(values, ensure_ascii=False)


# To show a step.


def stage(state: State, text: str) -> State:
    """Show a step, in the theme that is on; BadInput for a text that is none."""
    number, count, step = _staged(text)
    state = _shelved(replace(state, modes=()), step.scene, step.phase)
    clock = fresh(state.scene).go(state.frame, step.phase, paused=not step.running)
    own = {name: getattr(state.look, name) for name in ("theme", "material", "background")}
    look = replace(step.look, **own)
    modes = (Construction(state.scene, step.construction),) if step.construction else ()
    return replace(state, clock=clock, look=look, modes=modes, lesson=(number, count), toast=None)


def _shelved(state: State, scene: Scene, phase: float) -> State:
    """Return the state with a scene put on as it is: at its place on the shelf, else at a new first one."""
    place = next((n for n, one in enumerate(state.shelf) if one in (scene.name, scene)), None)
    if place is None:
        kept = tuple(one._replace(place=one.place + 1) for one in state.kept)
        state = replace(state, shelf=(scene, *state.shelf), place=state.place + 1, kept=kept)
    return put_scene(state, scene, place or 0, phase)


@lru_cache(maxsize=64)
def _staged(text: str) -> tuple[int, int, LessonStep]:
    """Read the value of the action: the step's number, how many there are, and the step."""
    values = LESSON_FILE.parsed(text, "the step", "is no step of a lesson")
    top = Section("the step", values if isinstance(values, dict) else {})
    number, count = (top.listed("step", 2).whole(key, 1, MOST_STEPS) for key in ("step[0]", "step[1]"))
    scene = stored.scene(top, "scene")
    step = LessonStep(
        scene,
        top.number("phase"),
        top.flag("running"),
        stored.look(top.table("look")),
        top.whole("construction", 0, 1_000),
    )
    return number, count, step


def answer(_: State, after: State) -> str | None:
    """Say which step is shown, where no caption stands in that place."""
    return "{} / {}".format(*after.lesson) if after.lesson and not after.look.caption else None


def leave(state: State, _: None) -> State:
    """Leave the lesson; what is shown stays."""
    return replace(state, lesson=None)


# The file.


def read(path: Path) -> tuple[LessonStep, ...]:
    """Read a lesson's steps; BadInput, naming the step and the key, for what is none."""
    where = intake.named(path)
    return _steps(parse(LESSON_FILE.read(path, where), where), where, path.parent)


def _steps(document: Mapping[str, Any], where: str, folder: Path) -> tuple[LessonStep, ...]:
    top = Section(where, document)
    for key in document:
        if key not in ("title", "step"):
            near = meant(key, ("title", "step"))
            raise top.error(key, f"is not known{near}; a lesson has a title and steps")
    entries = top.listed("step")
    if not 1 <= len(entries.values) <= MOST_STEPS:
        raise top.wrong(f"has {len(entries.values)} steps; a lesson has 1 to {MOST_STEPS}")
    return tuple(_step(entries.table(key), folder) for key in entries.values)


def _step(part: Section, folder: Path) -> LessonStep:
    for key in part.values:
        if key not in _KEYS:
            raise part.error(key, f"is not known{meant(key, _KEYS)}; a step has {', '.join(_KEYS)}")
    scene = _scene(part, folder)
    phase = _phase(part, scene)
    look, construction = _look(part.table("shown"), scene)
    caption = part.text("caption", "")
    seconds = part.number("seconds") if "seconds" in part else None
    if seconds is not None and not 0.0 < seconds <= _MOST_SECONDS:
        raise part.error("seconds", f"must be more than 0, and at most {_MOST_SECONDS:g}")
    running = part.flag("running") if "running" in part else not {"pose", "phase"} & part.values.keys()
    return LessonStep(scene, phase, running, replace(look, caption=bool(caption)), construction, seconds)


def _scene(part: Section, folder: Path) -> Scene:
    """Return the scene of a step, with its speed and its caption."""
    name = part.text("scene")
    path = path_of(name)
    try:
        scene = load(name if path is None else folder / path)
        document: dict[str, Any] = dict(scene.document)
        if "speed" in part:
            document["drive"] = {**document.get("drive", {}), "speed": part.text("speed")}
        if "caption" in part:
            document["look_at"] = part.text("caption")
        same = document == scene.document
        return scene if same else scene_from(document, name=scene.name, where=scene.name)
    except LinkanimError as error:
        raise part.wrong(str(error)) from None


def _phase(part: Section, scene: Scene) -> float:
    """Return the phase at which a step stands, or begins to run."""
    try:
        if "phase" in part:
            return float(angle(part.need("phase")))
        if "pose" not in part:
            return 0.0
        is_angle = scene.linkage.drive.coordinate.is_angle
        text = part.need("pose")
        coordinate = float(angle(text)) if is_angle else length(text, unit=scene.length_unit)
    except LinkanimError as error:
        raise part.error("phase" if "phase" in part else "pose", str(error)) from None
    if not scene.mechanism.comes_to(coordinate):
        info = scene.info
        raise part.error("pose", f"the {info.input_name} does not come there; it {info.motion_words}")
    return scene.mechanism.phase_of(coordinate, 0.0)


def _look(part: Section, scene: Scene) -> tuple[Look, int]:
    """Return what a step shows, and how many steps of the scene's constructions are drawn."""
    from linkanim.picture.constructed import KINDS, kinds_of, steps_before, steps_of

    stored.refuse_unknown(part, "construction", "construction_steps")
    look = stored.look(part)
    for token in chart_tokens(scene, look.chart):
        if token not in scene.quantities:
            raise part.error("chart", f"{scene.name} has no quantity {shown(token)}; K lists all that it has")
    if "construction" not in part:
        return look, 0
    kind: ConstructionKind = part.choice("construction", KINDS)
    if kind not in kinds_of(scene):
        raise part.error("construction", f"{scene.name} does not have it")
    most = len(steps_of(scene, kind))
    steps = part.whole("construction_steps", 1, most) if "construction_steps" in part else most
    return look, steps_before(scene, kind) + steps


# To keep what is shown as a further step.


def block(state: State, source: str, own: Scene, caption: str = "") -> str:
    """Return what is shown as a step's text, whose scene is read from a `source` as `own`."""
    scene, clock = state.scene, state.clock
    values: dict[str, Any] = {"scene": source}
    if clock.speed != own.linkage.drive.speed:
        values["speed"] = f"{significant(_rpm(clock), 10)} rpm"
    phase = state.phase % scene.period
    coordinate = scene.pose(phase, 0).coordinate
    if abs(math.remainder(scene.mechanism.phase_of(coordinate, 0.0) - phase, scene.period)) > _SAME:
        values["phase"] = f"{significant(phase, 12)} rad"
    elif scene.linkage.drive.coordinate.is_angle:
        values["pose"] = f"{significant(math.degrees(coordinate), 12)} deg"
    else:
        values["pose"] = f"{significant(coordinate, 12)} {scene.length_unit}"
    values["running"] = not clock.paused
    told = {name: one for name, one in stored.written_look(state.look).items() if name not in _OF_THE_WINDOW}
    if state.constructed:
        told |= _constructed(scene, state.constructed)
    if told:
        values["shown"] = told
    caption = caption or (scene.look_at if state.look.caption else "")
    if caption:
        values["caption"] = caption
    return "[[step]]\n" + "".join(f"{key} = {_toml(value)}\n" for key, value in values.items())


def _rpm(clock: Clock) -> float:
    """Return a clock's speed in turns a minute."""
    return clock.speed * 30.0 / math.pi


def _constructed(scene: Scene, steps: int) -> dict[str, Any]:
    from linkanim.picture.constructed import kinds_of, steps_before

    kind = next(one for one in reversed(kinds_of(scene)) if steps_before(scene, one) < steps)
    return {"construction": kind, "construction_steps": steps - steps_before(scene, kind)}


def _toml(value: object) -> str:
    """Return a value as TOML writes it, a table on one line."""
    if isinstance(value, Mapping):
        return f"{{ {', '.join(f'{key} = {_toml(one)}' for key, one in value.items())} }}"
    if isinstance(value, list):
        return f"[{', '.join(map(_toml, value))}]"
    import json

    return json.dumps(value, ensure_ascii=False)


class Lesson:
    """A lesson of a window: its file, its steps, and the one that was shown last.

    Steps are added at the end, and what stands in the file stays as it is.
    """

    def __init__(self, path: Path | None = None) -> None:
        self._path = path
        self._text = "" if path is None else path.read_bytes().decode("utf-8")
        self.steps: tuple[LessonStep, ...] = () if path is None else read(path)
        self._at = -1

    def on(self, further: int) -> Action:
        """Return the action that shows the step so many steps further on; a note where there is none."""
        if not self.steps:
            return Action("note", said("there is no lesson yet; F8 keeps what is shown as its first step"))
        self._at = min(max(self._at + further, 0), len(self.steps) - 1)
        return Action("stage", self.steps[self._at].text(self._at + 1, len(self.steps)))

    def keep(self, state: State, files: Mapping[str, Scene], caption: str = "") -> str:
        """Write what is shown as a further step, and return a sentence on it; BadInput where that cannot be.

        The scene is named as in the catalogue, or by one of the `files` that hold it, else written beside.
        """
        if state.game or (state.sketch and state.sketch.is_blank) or not state.scene.document:
            raise BadInput(said("a step of a lesson shows a mechanism; leave what is open first"))
        if state.building and state.building.building.made.missing:
            raise BadInput(
                said("a step shows what moves; {missing}", missing=state.building.building.made.missing)
            )
        if len(self.steps) >= MOST_STEPS:
            raise BadInput(said("a lesson has at most {count} steps", count=MOST_STEPS))
        path = self._path or _free("lesson")
        if self._path and self._path.read_bytes().decode("utf-8") != self._text:
            raise BadInput(
                said(
                    "{file} was changed meanwhile; open it, then keep the step", file=intake.named(self._path)
                )
            )
        source, own = _source(state.scene, files, path)
        added = block(state, source, own, caption)
        text = f"{self._text.rstrip()}\n\n{added}" if self._text.strip() else added
        steps = (*self.steps, *_steps(parse(added, intake.named(path)), intake.named(path), path.parent))
        atomic_files.write_text(path, text)
        self._path, self._text, self.steps, self._at = path, text, steps, len(steps) - 1
        return said(
            "{file}: step {number} is kept; PgUp and PgDn show the steps",
            file=intake.named(path),
            number=len(steps),
        )


def _free(stem: str) -> Path:
    """Return the first name of a lesson in the current folder that nothing has."""
    names_ = (Path(f"{stem}{'' if n == 1 else f'-{n}'}.toml") for n in range(1, 10_000))
    return next(one for one in names_ if not os.path.lexists(one))


def _source(scene: Scene, files: Mapping[str, Scene], lesson: Path) -> tuple[str, Scene]:
    """Return how a lesson names a scene, and that scene as it is there: by its name, its file, a new file."""
    known = {**({scene.name: load(scene.name)} if scene.name in names() else {}), **files}
    for source, own in known.items():
        if _bare(own) == _bare(scene):
            path = path_of(source)
            return (source if path is None else os.path.relpath(path, lesson.parent)), own
    folder = lesson.parent
    others = (folder / f"{lesson.stem}-{scene.name}-{n}.toml" for n in range(2, 10_000))
    path = atomic_files.add(
        content(in_its_form(scene), folder), folder / f"{lesson.stem}-{scene.name}.toml", others
    )
    return path.name, scene


def _bare(scene: Scene) -> dict[str, Any]:
    """Return a scene's document without what a step says itself: its speed, its sentence."""
    drive = {key: value for key, value in scene.document.get("drive", {}).items() if key != "speed"}
    return {**{key: value for key, value in scene.document.items() if key != "look_at"}, "drive": drive}


# The line in which a caption is typed.


def _caption(state: State, _: None) -> State:
    """Ask for the caption of the step to be kept, or do not."""
    return state.without(CaptionLine) if state.of(CaptionLine) else state.unlisted.with_mode(CaptionLine())


def _write(state: State, text: str) -> State:
    line = state.of(CaptionLine)
    return state.with_mode(replace(line, typed=(line.typed + text)[:_LONGEST])) if line else state


def _erase(state: State, _: None) -> State:
    line = state.of(CaptionLine)
    return state.with_mode(replace(line, typed=line.typed[:-1])) if line else state


def _keep_caption(state: State, _: None) -> State:
    """Keep the step with the caption."""
    line = state.of(CaptionLine)
    return with_effect(line.closed(state), "keep_step", line.typed.strip()) if line else state


def keep(state: State, _: None) -> State:
    """Keep what is shown as a step."""
    return with_effect(state, "keep_step", "")


def _on(window: Outside, further: Value) -> Iterator[Action]:
    """Yield the action that shows another step."""
    if isinstance(further, int):
        yield window.lesson_step(further)


@frozen
class CaptionLine(Mode):
    """The caption of the step that will be kept, as far as it is typed."""

    typed: str = ""

    keys = ModeKeys(
        "caption",
        {
            "a caption": (
                KeyRow("type", "the sentence that stands below the step"),
                KeyRow(
                    "Enter",
                    "keep the step; Esc does not",
                    enter("accept_caption", "erase_caption") + on("escape", "back"),
                ),
            )
        },
        TypedKeys("write_caption"),
        alone=True,
    )
    bar = (BACK_BAR, BarEntry("done", Action("accept_caption"), 1))
    actions: ClassVar[Mapping[str, Rule]] = {
        "keep_step": Rule(rules.nothing, keep, taped=False),
        "caption_step": Rule(rules.nothing, _caption, taped=False),
        "write_caption": Rule(rules.text, _write, taped=False),
        "erase_caption": Rule(rules.nothing, _erase, taped=False),
        "accept_caption": Rule(rules.nothing, _keep_caption, taped=False),
        "lesson_on": Rule(rules.whole, lambda state, _: state, taped=False),  # steps; resolved to "stage"
        "lesson_off": Rule(rules.nothing, leave),
        "stage": Rule(rules.text, stage, answer=answer),  # a whole step
    }
    meanings: ClassVar[Mapping[str, Resolver]] = {"lesson_on": _on}

    def says(self, state: State) -> str:
        """Return the line in which the caption is typed."""
        del state
        return said("Caption: {typed}_ · Enter keeps the step · Esc does not", typed=self.typed)
