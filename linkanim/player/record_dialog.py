"""Choose how a recording is made, in one dialog: format, size, how long, and where it is written.

Typed text is the folder and name, whatever row is chosen; some places are proposed. Below stand other ways to
keep the picture or the scene.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar, TypeVar

from linkanim.frozen import frozen
from linkanim.picture.lists import EditRow, Panel
from linkanim.player import rules
from linkanim.player.action import Action, Value
from linkanim.player.keys import (
    BACK_BAR,
    RUNNING,
    BarEntry,
    KeyRow,
    ModeKeys,
    TypedKeys,
    both,
    enter,
    on,
    tabs,
)
from linkanim.player.state import (
    Format,
    Mode,
    RecordingChoice,
    Resolver,
    Rule,
    RunningRecording,
    State,
    with_effect,
    with_toast,
)
from linkanim.units import significant, typeset
from linkanim.words import said, to_say

if TYPE_CHECKING:
    from linkanim.player.hand import Gesture, Hand, Outside
    from linkanim.player.sight import Sight

SIZES: tuple[tuple[int, int] | None, ...] = (None, (800, 450), (1280, 720), (1920, 1080), (3840, 2160))
"""The sizes of recordings to choose from; None for the window's shape."""
FORMATS: tuple[Format, ...] = ("gif", "mp4")
RUNS = to_say("a recording runs; G or M ends it")
KEEPS = (Action("screenshot"), Action("svg"), Action("share"), Action("save"), Action("save_as"))
"""Other ways to keep the picture or the scene."""
_HINT = to_say("↑ ↓ choose   ← → change   type a folder and name   Enter records   Esc closes")
_LONGEST = 300
PLACE = 3
"""The row of the place to write to."""
_START = 4
"""The row that begins the recording."""

Step = TypeVar("Step")


Row = tuple[str, str, Action | None]
"""A row of the dialog: its name, its value or the key that does the same, its action."""


def rows(state: State) -> tuple[Row, ...]:
    """Return the rows of the open dialog: the choices, the row that begins, and other ways to keep things."""
    dialog, choice = state.of(RecordDialog) or RecordDialog(), of_a_kind(state)
    typed = f"{dialog.typed}_" if dialog.typed else f"{dialog.place}.{choice.format}"
    keys = {action: (said(words), key) for words, key, action in RUNNING.commands}
    return (
        (said("Format"), choice.format.upper(), None),
        (said("Size"), _sized(choice.size), None),
        (said("Length"), _period(state) if choice.whole else said("until it is stopped"), None),
        (said("Where to"), typed, None),
        (said("Record"), "Enter", Action("record_start")),
        *((*keys[action], action) for action in KEEPS),
    )


def of_a_kind(state: State) -> RecordingChoice:
    """Return the choice as it applies now: a game has no period."""
    return state.recording_choice._replace(whole=state.recording_choice.whole and state.game is None)


def _sized(size: tuple[int, int] | None) -> str:
    return "{} × {}".format(*size) if size else said("as the window")


def _period(state: State) -> str:
    seconds = abs(state.scene.period / state.clock.speed)
    return typeset(said("one period, {seconds} s", seconds=significant(seconds, 3)))


def target(state: State) -> str:
    """Return the file that the open dialog names; empty for a free name."""
    dialog = state.of(RecordDialog)
    place = dialog.place if dialog else ""
    return f"{place}.{state.recording_choice.format}" if place else ""


# Actions in the dialog.


def toggle(state: State, _: None) -> State:
    """Open the dialog, or close it."""
    if state.recording:
        return with_toast(state, said(RUNS))
    bare = state.unlisted.unhelped
    return bare.without(RecordDialog) if state.of(RecordDialog) else bare.with_mode(RecordDialog(row=_START))


def propose(state: State, lines: str) -> State:
    """Keep the current folder and the proposed places, one a line."""
    folder, *names = lines.splitlines() or [""]
    dialog = state.of(RecordDialog)
    return state.with_mode(replace(dialog, folder=folder, places=tuple(names))) if dialog else state


def choose(state: State, further: int) -> State:
    """Choose the row `further` rows down; the first row follows the last."""
    return _on(state, lambda one: replace(one, row=(one.row + further) % len(rows(state))))


def turn(state: State, steps: int) -> State:
    """Take the chosen row's value that is `steps` further on."""
    dialog = state.of(RecordDialog)
    if dialog is None:
        return state
    choice, at = state.recording_choice, dialog.row
    if at == 0:
        choice = choice._replace(format=_after(FORMATS, choice.format, steps))
    elif at == 1:
        choice = choice._replace(size=_after(SIZES, choice.size, steps))
    elif at == 2:
        choice = choice._replace(whole=choice.whole ^ bool(steps % 2) and state.game is None)
    elif at == PLACE and dialog.places:
        return _on(state, lambda one: replace(one, typed="", at=(one.at + steps) % len(one.places)))
    return replace(_on(state, lambda one: one), recording_choice=choice)


def _after(steps: tuple[Step, ...], now: Step, by: int) -> Step:
    return steps[(steps.index(now) + by) % len(steps)] if now in steps else steps[0]


def write(state: State, text: str) -> State:
    """Add to the typed place; an ending that names a format chooses that format."""
    dialog = state.of(RecordDialog)
    return _typed(state, (dialog.typed + text)[:_LONGEST]) if dialog else state


def erase(state: State, _: None) -> State:
    """Erase the last letter of the place, even of a proposed one."""
    dialog = state.of(RecordDialog)
    return _typed(state, dialog.place[:-1]) if dialog else state


def _typed(state: State, text: str) -> State:
    form = next((one for one in FORMATS if text.lower().endswith(f".{one}")), None)
    if form:
        state = replace(state, recording_choice=state.recording_choice._replace(format=form))
        text = text[: -len(form) - 1]
    return _on(state, lambda one: replace(one, row=PLACE, typed=text))


def refused(state: State, reason: str) -> State:
    """Say why it cannot be written there."""
    dialog = state.of(RecordDialog)
    return state.with_mode(replace(dialog, row=PLACE, refusal=reason)) if dialog else state


def _on(state: State, work: Callable[[RecordDialog], RecordDialog]) -> State:
    """Return the state with its dialog changed, and nothing refused."""
    dialog = state.of(RecordDialog)
    return state.with_mode(replace(work(dialog), refusal="")) if dialog else state


# What keys ask that depends on the folder.


def _opened(window: Outside, _: Value) -> Iterator[Action]:
    """Yield the actions that open the dialog with free places, or close it."""
    yield Action("record_dialog")
    if window.state.of(RecordDialog):
        yield Action("record_places", window.proposed_targets())


def _started(window: Outside, _: Value) -> Iterator[Action]:
    """Yield what Enter means in the dialog: a recording begins, or another command is done."""
    dialog = window.state.of(RecordDialog)
    if dialog is None:
        return
    _, _, does = rows(window.state)[dialog.row]
    if does and does.name != "record_start":
        yield Action("back")
        yield from window.resolved(does)
        return
    file = target(window.state)
    if reason := window.refused_target(file):
        yield Action("record_refused", reason)
        return
    yield Action("back")
    yield Action("record_into", file)


# Actions that record.


def into(state: State, file: str) -> State:
    """Begin what the dialog has chosen: a recording into a file, or at once the recording of a period."""
    choice = of_a_kind(state)
    if choice.whole:
        return with_effect(state, "period", file)
    return replace(
        with_effect(state, "record", choice.format),
        recording=RunningRecording(choice.format, state.frame, file),
    )


def record(state: State, form: Format) -> State:
    """Start a recording, or stop the one that runs, whatever its format."""
    if state.recording is None:
        return replace(with_effect(state, "record", form), recording=RunningRecording(form, state.frame))
    return replace(with_effect(state, "render", state.recording.format), recording=None)


def period(state: State, form: Format) -> State:
    """Record one period at the present speed and look: a recording without actions."""
    if state.recording:
        return with_toast(state, said(RUNS))
    return with_effect(state, "period", form)


@frozen
class RecordDialog(Mode):
    """The open dialog of a recording: the chosen row, and where the recording is to be written.

    That place is the `typed` one, else number `at` of the proposed `places`. These are files without their
    endings, relative to the current `folder`. `refusal` says why nothing can be written there.
    """

    row: int = 0
    typed: str = ""
    places: tuple[str, ...] = ()
    at: int = 0
    folder: str = ""
    refusal: str = ""

    keys = ModeKeys(
        "record",
        {
            "recording": (
                KeyRow("↑ ↓, Tab", "choose a row", both("up", "down", "record_row") + tabs("record_row")),
                KeyRow(
                    "← →, click",
                    "format, size, length; another place that is proposed",
                    both("left", "right", "record_turn"),
                ),
                KeyRow("type", "the folder and name to write to; .gif or .mp4 chooses the format"),
                KeyRow(
                    "Enter",
                    "record; Esc does not",
                    enter("record_start", "erase_target") + on("escape", "back"),
                ),
            )
        },
        TypedKeys("record_type"),
        alone=True,
    )
    bar = (BACK_BAR, BarEntry("done", Action("record_start"), 1))
    actions: ClassVar[Mapping[str, Rule]] = {
        "record_dialog": Rule(rules.nothing, toggle),
        "record_places": Rule(rules.text, propose),  # the current folder and places to write to, one a line
        "record_row": Rule(rules.whole, choose),  # rows further down
        "record_turn": Rule(rules.whole, turn),  # values further on
        "record_type": Rule(rules.text, write),
        "erase_target": Rule(rules.nothing, erase),
        "record_refused": Rule(rules.text, refused),  # why it cannot be written there
    }
    meanings: ClassVar[Mapping[str, Resolver]] = {"record_dialog": _opened, "record_start": _started}
    is_listed, leads = True, True

    @property
    def place(self) -> str:
        """Where the recording is to be written, without its ending; a folder alone gets the proposed name."""
        proposed = next(iter(self.places[self.at :]), "")
        if self.typed.endswith(("/", "\\")):
            return self.typed + proposed.replace("\\", "/").rpartition("/")[2]
        return self.typed or proposed

    def panel(self, state: State) -> Panel:
        """Return the dialog, which stands in the place of a game's panel."""
        shown = tuple(
            EditRow(label, value, n == self.row, draft=n == PLACE and self.typed != "")
            for n, (label, value, _) in enumerate(rows(state))
        )
        is_whole = self.place.startswith("~") or Path(self.place).is_absolute()
        facts = () if is_whole or not self.folder else (said("in {folder}", folder=self.folder),)
        return Panel(
            shown, to_say("Record and save"), facts, error=self.refusal or None, hint=_HINT, counted=False
        )

    def mouse(self, gesture: Gesture, mouse: Hand, screen: Sight) -> tuple[Action, ...] | None:
        """Return the actions of a click on the dialog: a row's next value, or its command; None off it."""
        number = screen.row_at(*mouse.at) if mouse.drag is None else None
        if number is None or gesture.kind not in ("wheel", "down"):
            return None
        if number < 0:
            return ()
        _, _, does = rows(screen.state)[number]
        to = Action("record_row", number - self.row)
        if gesture.kind == "wheel":
            return () if does else (to, Action("record_turn", gesture.notches))
        mouse.drag = "bar"
        return (to, Action("record_start") if does else Action("record_turn", 1))
