"""Run the window: events to actions, `advance`, paint, flip, and effects on the outside.

`Window` holds what lasts longer than a frame; pure functions do the work. `run` opens it. What it needs to
know of games is passed in as a `GameKeeper`.
"""

from __future__ import annotations

import gc
import os
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Literal, Protocol

import pygame
from pygame.event import Event

from linkanim.errors import BadInput, LinkanimError
from linkanim.picture.look import Look
from linkanim.picture.photograph import SUFFIXES, lack
from linkanim.player import files, modes, record_dialog
from linkanim.player.action import Action, Value
from linkanim.player.actions import aged, carried, end_of_frame, leave
from linkanim.player.browsing import OwnFile
from linkanim.player.building import leave_sheet, written
from linkanim.player.clock import FRAMES_PER_SECOND
from linkanim.player.edits import renewed
from linkanim.player.files import DraftFile, SavedScenes, SceneFile, relative, scene_files
from linkanim.player.lesson import Lesson
from linkanim.player.making import Layering
from linkanim.player.naming import Naming
from linkanim.player.state import Game, RunningRecording, State, begin, recovered, report
from linkanim.player.tape import Tape, Taping
from linkanim.scenes import load, names
from linkanim.scenes.files import is_lesson, opened, path_of
from linkanim.scenes.scene import Scene
from linkanim.ui import screen
from linkanim.ui.desktop import reduces_motion
from linkanim.ui.devices import MOUSE_EVENTS, PAD_EVENTS, Fingers, Keyboard, Mouse, Pads, Repeats, latest
from linkanim.ui.pointing import NOWHERE
from linkanim.ui.screen import Screen
from linkanim.words import said, speaking, to_say

if TYPE_CHECKING:
    from linkanim.player.background import Following, Making, Queue

# What the window needs to know of games: which there are, and the results that are kept.


class GameKeeper(Protocol):
    """Knows the games, and the file in which best scores and missed questions are kept."""

    def game_of(self, words: str) -> Game:
        """Return the game that words begin; BadInput where they name none. Pure, for tapes."""

    def completed(self, words: str) -> str:
        """Return a game's words with what only the outside knows: a seed, best scores, missed questions."""

    def keep(self, words: str) -> None:
        """Store a game's result; where that fails, `news` says so."""

    def news(self) -> list[str]:
        """Return messages about the stored results, each once."""


# The window itself: it holds what lasts longer than a frame; pure functions do the work.

_UNCOVERED = (pygame.WINDOWEXPOSED, pygame.WINDOWSIZECHANGED)
_NEWS_EVERY = 15
_USUALLY_MADE = ("--fit", "A4")
"""Options of `linkanim make` for parts that are made from the window."""
_WAITS = to_say(
    "unsaved work of another sheet is kept as well; `linkanim new` without a photograph takes it up"
)
_TAKEN_UP = to_say("this is the unsaved work that was kept; Ctrl+N begins an empty sheet")
_BESIDE_A_TAPE = frozenset(
    {"mouse_moved", "hint", "open_toast", "screenshot", "svg", "share", "fullscreen", "quit", "close", "back"}
)


class Window:
    """One open window: `state` is what it shows, `screen` paints it.

    A tape plays in it until a key is pressed. The scene file with which it was opened is watched. A draft
    that another window left is offered where `offer` says so, else only mentioned.
    """

    def __init__(
        self,
        state: State,
        tape: Tape | None = None,
        file: SceneFile | None = None,
        keeper: GameKeeper | None = None,
        drafts: DraftFile | None = None,
        *,
        offer: bool = True,
        lesson: Lesson | None = None,
    ) -> None:
        self.state = state
        self._file, self._drafts, self._saved = file, drafts, SavedScenes()
        self._keeper, self._begun = keeper, ""
        self._tape = tape
        self._taping: Taping | None = None
        self._renderings: Queue | None = None
        self._following: Following | None = None
        self._layering: Making | None = None
        self._making: Making | None = None
        self._as_made: Sequence[str] = _USUALLY_MADE
        self.screen = Screen(state)
        self._keyboard, self._mouse, self._fingers, self._pads = (
            Keyboard(modes.key_names()),
            Mouse(),
            Fingers(),
            Pads(),
        )
        self._notes: list[str] = []
        self._photo: str | None = None
        self._repeats = Repeats()
        self._windowed = screen.frame()
        self._open = True
        self._now = state.frame
        self._good: State | None = None
        self._target = ""
        self._last_place: str | None = None
        self._reported: set[str] = set()
        self._unkept: str | None = None
        self._warned: str | None = None
        self._lesson = lesson or Lesson()
        if offer:
            self._offer()
        elif drafts and drafts.waits():
            self._notes.append(said(_WAITS))

    def tick(self, frames: int = 1) -> bool:
        """Go `frames` frames on, paint and flip; False when the window is to be closed.

        Events since the last tick are handled at its first frame.
        """
        self._pads.look(frames)
        events = self._fingers.pointed(pygame.event.get(), pygame.display.get_window_size())
        self._now = self.state.frame + frames
        with speaking(self.state.language):
            for frame in range(frames):
                self._advance(events if frame == 0 else [])
        with speaking(self.state.language):
            if self._good and self._good.language != self.state.language:
                self.screen = Screen(self.state)  # whatever it keeps is in the language before
            self._show()
        return self._open

    def fill(self) -> None:
        """Fill the screen, or go back from there."""
        self._windowed = screen.fill(self._windowed)

    def close(self) -> None:
        """Finish the running recording, and release what the window holds; renderings under way go on."""
        try:
            self._keep_draft()
            if self.state.recording:
                self._render(self.state.recording.format)
        finally:
            if self._drafts:
                self._drafts.close()
            for process in (self._renderings, self._following, self._layering, self._making):
                if process:
                    process.close()

    @property
    def recorded(self) -> str:
        """The folder in which the running recording will be kept; empty where none runs."""
        recording = self.state.recording
        return f"{Path(recording.target).parent if recording.target else files.FOLDER}/" if recording else ""

    def _advance(self, events: list[Event]) -> None:
        """Go one frame on; the meaning of each key is looked up once earlier keys are carried out."""
        before, done = self._tape.rewound(self.state) if self._tape else self.state, list[Action]()
        self.state = aged(before)
        for action in self._requested(events):
            self.state = carried(self.state, action)
            done.append(action)
        self.state = end_of_frame(before, self.state)
        if self._taping:
            self._taping.note(self.state.frame, tuple(done))
        for effect in self.state.effects:
            with self._noting():
                self._do(effect)

    def _requested(self, events: list[Event]) -> Iterator[Action]:
        """Yield the frame's actions: from the tape, from events, from a held key, and from work outside."""
        if self._tape:
            yield from self._of_the_tape(self._tape)
        if self._following:
            yield from self._followed(self._following)
        if self._layering:
            yield from self._layered(self._layering)
        if self._begun:
            words, self._begun = self._begun, ""
            yield Action("play", words)
        if events and not (self.state.drawing and self.state.drawing.pen):
            events = latest(events)
        for event in events:
            for action in self._meant(event):
                yield from self._off_the_tape(action)
                yield from self.resolved(action)
        for action in self._mouse.long_press(self.screen) if self._mouse.drag else ():
            yield from self._off_the_tape(action)
            yield from self.resolved(action)
        for action in self._repeats.due(self.state.frame):
            yield from self.resolved(action)
        yield from self._news()

    def resolved(self, action: Action) -> Iterator[Action]:
        """Yield an action; one that depends on what is visible or in the folder is resolved first."""
        own = (mode.meanings for mode in reversed(self.state.modes) if action.name in mode.meanings)
        meaning = next(own, MEANINGS).get(action.name)
        yield from meaning(self, action.value) if meaning else (action,)

    def _back(self, _: Value) -> Iterator[Action]:
        """Yield what Esc does: it leaves what is open, full screen, or a recording, in this order."""
        if self.state.is_covered or not (screen.is_full() or self.state.recording):
            yield Action("back")
        elif not screen.is_full() and self.state.recording:
            yield Action("record", self.state.recording.format)
        elif not self.state.kiosk:
            yield Action("fullscreen")

    def scene_files(self) -> tuple[OwnFile, ...]:
        """Return the scene files in the current folder."""
        return scene_files()

    def proposed_targets(self) -> str:
        """Return the current folder and places in it to write to, one a line."""
        return "\n".join(
            [files.current_folder(), *files.free_targets(self.state.scene.name, self._last_place)]
        )

    def refused_target(self, file: str) -> str:
        """Return why nothing can be recorded into a file; else remember its folder, and return nothing."""
        try:
            self._queue.refuse(file)
        except LinkanimError as error:
            return str(error)
        self._last_place = str(Path(file).parent)
        return ""

    def lesson_step(self, further: int) -> Action:
        """Return the action that shows the lesson's step so many steps further on, or a note."""
        return self._lesson.on(further)

    def _followed(self, following: Following) -> Iterator[Action]:
        """Yield the actions with which the search for linkages has replied."""
        if self.state.sketch and self.state.sketch.coming:
            return
        if self.state.posing and self.state.scene is not self.screen.state.scene:
            return  # this frame draws the new linkage; the next linkage is worked out in the next frame
        from linkanim.player.background import actions_of

        for reply in following.replies():
            yield from actions_of(reply, self.state.sketch)

    def _layered(self, making: Making) -> Iterator[Action]:
        """Yield the action with the layers that the state waits for, once they are found."""
        if making.done:
            shown = self.state.of(Layering)
            if shown and shown.scene is making.scene:
                yield Action("layered", making.result())
            making.close()
            self._layering = None

    def _make(self, *, whole: bool) -> None:
        """Start to find the layers of the present scene; with `whole`, to write its parts."""
        from linkanim.player.background import Making

        scene = self.state.scene
        if not whole:
            if self._layering:
                self._layering.close()
            self._layering = Making(scene, self._as_made)
        elif self._making:
            self._notes.append(said("the parts are being written"))
        else:
            self._making = Making(scene, self._as_made, Path(f"{scene.name}-parts"))

    def _ask_for(self, name: str) -> None:
        """Ask the search for linkages for the sketch, all or only the shown one; start it if need be."""
        from linkanim.player.background import Following, request_of

        if self._following and self._following.is_over:
            self._following.close()
            self._following = None
        self._following = self._following or Following(*(["paths"] if self.state.drawing else []))
        asked = {"search": name == "search", "anew": name == "anew"}
        known = self.state.sketch if name not in ("pencil", "poses") else None
        request = request_of(known, **asked) if known else None
        if request:
            self._following.ask(request)

    def _of_the_tape(self, tape: Tape) -> Iterator[Action]:
        """Yield the tape's actions at this frame, without effects on the outside."""
        yield from tape.at(self.state.frame)
        self.state = replace(self.state, effects=())

    def _off_the_tape(self, action: Action) -> Iterator[Action]:
        """Leave the tape where an action changes something."""
        if self._tape and action.name not in _BESIDE_A_TAPE:
            self._tape = None
            yield Action("note", said("the tape has been left; the keys are yours"))

    def _show(self) -> None:
        """Paint and flip; where a state cannot be painted, go back to the last that could."""
        try:
            mouse = self._mouse.over(self.screen, self.state) if self._good else NOWHERE
            self.screen.show(self.state, mouse)
        except Exception as error:
            if self._good is None:
                raise
            with self._noting():
                self._report(report(self.state.shown, error, phase=self.state.phase))
            self._taping = None
            self.state = recovered(self.state, self._good, error)
            self.screen.show(self.state)
        self._good = self.state

    def _news(self) -> tuple[Action, ...]:
        """Return, as notes, the news from outside, and how far recordings are."""
        if self.state.frame % FRAMES_PER_SECOND == 0:
            self._keep_draft()
        notes, self._notes = self._notes, []
        sheet = self.state.sheet and self.state.building
        photo = sheet.building.draft.photo if sheet else None
        if (file := photo.file if photo else None) != self._photo:
            self._photo = file
            notes += filter(None, [file and lack(file)])
        sources = ((self._keeper, 1), (self._file, FRAMES_PER_SECOND), (self._renderings, _NEWS_EVERY))
        for source, every in sources:
            notes += source.news() if source and self.state.frame % every == 0 else ()
        if self._making and self._making.done:
            notes.append(self._making.words())
            self._making.close()
            self._making = None
        return tuple(Action("note", text) for text in notes)

    @contextmanager
    def _noting(self) -> Iterator[None]:
        """Turn an error inside the block into a note; the window runs on."""
        try:
            yield
        except LinkanimError as error:
            self._notes.append(str(error))

    def _do(self, effect: Action) -> None:
        """Carry out an effect that the state asks for."""
        match effect.name:
            case "record":
                self._taping = Taping(self.state, pygame.display.get_window_size())
                self._target = self.state.recording.target if self.state.recording else ""
            case "period":
                self._render_period(str(effect.value))
            case "render":
                self._stop("mp4" if effect.value == "mp4" else "gif")
            case "screenshot":
                picture = self.screen.picture(self.state)
                self._notes.append(files.where(files.screenshot(picture, self.state.scene.name)))
            case "svg":
                self._notes.append(files.where(files.vector(self.state, pygame.display.get_window_size())))
            case "share":
                self._notes.append(files.where(files.page(self.state)))
            case "report":
                self._report(str(effect.value))
            case "name":
                self.state = self.state.with_mode(Naming(self._saved.proposal(self.state.scene)))
            case "save":
                self._noted(self._saved.write(self.state.scene, Path(str(effect.value))))
            case "save_new":
                self._save_new(str(effect.value))
            case "keep_step":
                self._notes.append(self._lesson.keep(self.state, self._own_files, str(effect.value)))
            case "open":
                self._open_file(Path(str(effect.value)))
            case "reload":
                self._reload()
            case "layers" | "make":
                self._make(whole=effect.name == "make")
            case "pencil" | "poses" | "search" | "follow" | "anew":
                self._ask_for(effect.name)
            case "begin" if self._keeper:
                self._begun = self._keeper.completed(str(effect.value))
            case "score" if self._keeper:
                self._keeper.keep(str(effect.value))
            case "folder":
                files.open_folder(str(effect.value))
            case "fullscreen":
                self.fill()
            case "quit":
                self._quit()

    @property
    def _own_files(self) -> dict[str, Scene]:
        """The scene files of this window that may hold the present scene, and what they hold."""
        files = (self._file.path if self._file else None, self.state.saved_as)
        scenes: dict[str, Scene] = {}
        for file in files:
            with suppress(LinkanimError):
                scenes |= {str(file): load(str(file))} if file else {}
        return scenes

    def _save_new(self, name: str) -> None:
        """Write the scene under a name; where that is impossible, ask again with the reason."""
        try:
            self._noted(self._saved.add(self.state.scene, name))
        except LinkanimError as error:
            self.state = self.state.with_mode(Naming(name, refusal=str(error)))

    def _noted(self, path: Path) -> None:
        """Record that the scene is in a file."""
        self._notes.append(files.where(path))
        self.state = written(self.state, str(path))

    def open_layers(self, words: Sequence[str]) -> None:
        """Show the layers of the scene, to be made with these words as options of `linkanim make`."""
        self._as_made = words
        self.state = carried(self.state, Action("layers"))
        with self._noting():
            self._make(whole=False)

    def open_sheet(self) -> None:
        """Open an empty sheet, or the draft that another window left."""
        if self.state.sheet:
            self._notes = [_TAKEN_UP]
        self.state = carried(self.state, Action("build"))

    def _offer(self) -> None:
        """Offer the draft that another window left."""
        with self._noting():
            if self._drafts:
                self.state, sentence = self._drafts.offered(self.state)
                self._notes += [sentence] if sentence else []

    def _keep_draft(self) -> str | None:
        """Keep the sheet's draft in its file; return a sentence, once, on what prevents that."""
        before, self._unkept = self._unkept, None
        try:
            if self._drafts:
                self._drafts.keep(self.state.sheet)
        except LinkanimError as error:
            self._unkept = str(error)
            self._notes += [self._unkept] if self._unkept != before else []
        return self._unkept

    def _quit(self) -> None:
        """Close the window; where the draft could not be kept, only when asked twice."""
        sheet = self.state.sheet
        why = self._keep_draft() if sheet and not sheet.is_written else None
        if why and why != self._warned:
            self._notes.append(said("{error}; once more closes without the draft", error=why))
        self._open, self._warned = bool(why and why != self._warned), why

    def _open_file(self, path: Path) -> None:
        """Show the scene of a file, which is watched from now on."""
        if self.state.recording:
            raise BadInput(
                said("a recording holds only the scenes that it began with; stop it, then open the file")
            )
        if is_lesson(path):
            self._lesson = Lesson(path)
            self.state = carried(self.state, self._lesson.on(1))
            return
        scene, left_out = opened(path)
        self._file = SceneFile(path)
        self.state = renewed(leave_sheet(leave(self.state)), scene)
        self.note_left_out(left_out)

    def note_left_out(self, left_out: Sequence[str]) -> None:
        """Say what of another program's file is not in its scene."""
        if left_out:
            self._notes.append(said("left out of it: {parts}", parts="; ".join(left_out)))

    def _reload(self) -> None:
        """Show the scene file as it is now; where it is wrong a note says so, and the linkage runs on."""
        if self._file is None:
            raise BadInput(said("this scene was not loaded from a file; `linkanim FILE.toml` opens one"))
        if self.state.recording:
            raise BadInput(
                said("a recording holds only the scenes that it began with; stop it, then press F5")
            )
        scene = self._file.load()
        try:
            self.state = renewed(leave_sheet(self.state), scene)
        except LinkanimError:
            raise
        except Exception as error:
            self._report(report(scene, error))

    def _report(self, text: str) -> None:
        """Write the report of a fault, each only once: a held key causes the same one again and again."""
        if text not in self._reported:
            self._reported.add(text)
            written = files.report(text, self.state.scene.name)
            self._notes.append(said("{file} holds what a report of the fault needs", file=written))

    def _stop(self, form: Literal["gif", "mp4"]) -> None:
        """Write the recorded tape and render it; where it cannot be written, the recording runs on."""
        try:
            self._render(form)
        except LinkanimError as error:
            assert self._taping
            self.state = replace(self.state, recording=RunningRecording(form, self._taping.since))
            self._target = ""  # the next attempt takes a free name
            self._notes.append(said("{error}; the recording runs on", error=error))

    def _render(self, form: str) -> None:
        """Render the running recording, into the file that was chosen when it began."""
        if self._taping:
            self._queue.add(
                self._taping.tape(self.state.frame), form, self.state.recording_choice.size, self._target
            )
            self._taping = None

    def _render_period(self, file: str) -> None:
        """Render one period without actions into a file; where only a format is given, into a free one."""
        tape = Taping(self.state, pygame.display.get_window_size()).tape(self.state.frame + 1)
        form, place = (file, "") if file in record_dialog.FORMATS else (file.rpartition(".")[2], file)
        self._queue.add(tape, form, self.state.recording_choice.size, place)

    @property
    def _queue(self) -> Queue:
        """The recordings that are rendered, one after the other."""
        from linkanim.player.background import Queue

        self._renderings = self._renderings or Queue()
        return self._renderings

    def _meant(self, event: Event) -> tuple[Action, ...]:
        """Return the actions of an event in the present state."""
        if event.type == pygame.DROPFILE:
            picture = event.file.lower().endswith(SUFFIXES)
            name = files.relative(event.file) if picture else event.file
            return (Action("photo" if picture else "open_file", name),)
        if event.type == pygame.QUIT:
            return (Action("close"),)
        if event.type in _UNCOVERED:
            self.screen.uncovered()
        if event.type in MOUSE_EVENTS:
            # before the first picture there is nothing under the mouse
            return self._mouse.actions(event, self.screen) if self._good else ()
        if event.type in PAD_EVENTS:
            bind, key = self._pads.bind(event, self.state.keys), None
        elif event.type == pygame.KEYDOWN:
            press, on, key = self._keyboard.press(event), self.state, event.key
            bind = on.keys.bind_of(press, typing=on.typing, valued=on.valued) if press else None
        else:
            return ()
        self._repeats.begin(bind, self._now, key)
        return (bind.action,) if bind else ()


MEANINGS: Mapping[str, Callable[[Window, Value], Iterable[Action]]] = {
    "back": Window._back,
    **modes.MEANINGS,
}
"""Actions of the key table that depend on what is visible or in the folder, and what resolves them."""


# The window: events to actions, `advance`, paint, flip; and effects on the outside.
#
# `frames` owns the time, and says how many frames are due; `Window.tick` carries them out. A late frame is
# skipped, so that the motion does not slow down: the frame's number follows the clock.

_STALLED = FRAMES_PER_SECOND


def run(
    scene: Scene | str | os.PathLike[str] | None = None,
    *,
    look: Look | None = None,
    attract: bool = False,
    size: tuple[int, int] | None = None,
    keeper: GameKeeper | None = None,
    drafts: Path | None = None,
    sheet: bool = False,
    layers: Sequence[str] | None = None,
    game: str | None = None,
    photo: Path | None = None,
    reduced_motion: bool | None = None,
) -> int:
    """Open the window on a scene, a scene file, a lesson or a tape, and return 0 when it is closed.

    Without a scene it opens on the title, where a `keeper` has games. With `attract` it fills the screen, Esc
    does not leave that, and a mechanism that runs gives way to the title when left alone for a minute.
    NoDisplay where there is no screen, or it is lost; BadInput as loading raises it. Whatever ends the
    window, a running recording is finished. `drafts` is the file in which a draft is kept; with `sheet` the
    window opens on the draft that was kept, else on an empty sheet, with `photo` behind it if one is given.
    With `layers` it shows the scene's layers, to be made with these options of `linkanim make`. `game` are
    the words of a game to begin with. With `reduced_motion` pictures change at once; None does as the desktop
    asks.
    """
    tape = _tape(scene, keeper)
    lesson = Lesson(Path(scene)) if isinstance(scene, str | os.PathLike) and is_lesson(scene) else None
    file, left_out = None if tape or lesson else _file(scene), tuple[str, ...]()
    if file and isinstance(scene, str | os.PathLike):
        scene, left_out = opened(scene)
    state = tape.begun if tape else begin(lesson.steps[0].scene if lesson else scene, look=look)
    reduced = reduces_motion() if reduced_motion is None else reduced_motion
    state = replace(state, games=keeper.game_of if keeper else None, reduced_motion=reduced)
    opening = game or ("title" if scene is None else None)
    if opening and keeper:
        words = keeper.completed(opening)
        keeper.game_of(words)  # raises where the words are wrong, before a window opens
        state = carried(state, Action("play", words))
    with screen.opened(size) as connection:
        state = replace(state, from_title=attract or scene is None, kiosk=attract)
        kept = DraftFile(drafts) if drafts and not tape else None
        window = Window(state, tape, file, keeper, kept, offer=photo is None, lesson=lesson)
        window.note_left_out(left_out)
        if lesson:
            window.state = carried(window.state, lesson.on(1))
        if sheet:
            window.open_sheet()
        if layers is not None:
            window.open_layers(layers)
        if photo:
            window.state = carried(window.state, Action("photo", relative(str(photo))))
        if attract:
            window.fill()
        gc.freeze()  # objects that exist by now stay: the collector need not search them during a frame
        try:
            for count in frames(time.monotonic, time.sleep):
                if not window.tick(count):
                    break
                connection.check(window.recorded)
        finally:
            window.close()
            gc.unfreeze()
    return 0


def frames(now: Callable[[], float], wait: Callable[[float], object]) -> Iterator[int]:
    """Yield how many frames are due since the last time, at 60 a second; wait where none is.

    After a stall of more than a second (a window being moved, a laptop that slept) the time in between is
    left out; so is a step back of the clock.
    """
    start, shown = now() - 1 / FRAMES_PER_SECOND, 1
    yield 1
    while True:
        early = start + (shown + 1) / FRAMES_PER_SECOND - now()
        if early > 2 / FRAMES_PER_SECOND:
            start, early = start - early + 1 / FRAMES_PER_SECOND, 1 / FRAMES_PER_SECOND
        wait(max(0.0, early))
        due = max(int((now() - start) * FRAMES_PER_SECOND), shown + 1)
        if due - shown > _STALLED:
            start += (due - shown - 1) / FRAMES_PER_SECOND
            due = shown + 1
        yield due - shown
        shown = due


def _file(scene: object) -> SceneFile | None:
    if not isinstance(scene, str | os.PathLike):
        return None
    path, known = Path(scene), path_of(scene)
    is_own = path.suffix.lower() in files.OPENED or (path.is_file() and scene not in names())
    return SceneFile(path) if known or is_own else None


def _tape(scene: object, keeper: GameKeeper | None) -> Tape | None:
    path = str(scene) if isinstance(scene, str | os.PathLike) else ""
    if not path.lower().endswith(".json"):
        return None
    from linkanim.player import tape_file

    return tape_file.read(Path(path), keeper.game_of if keeper else None)
