"""Choose how a recording is made, in one dialog: format, size, how long, and where it is written.

Typed text is the folder and name, whatever row is chosen; some places are proposed. Below stand other ways to
keep the picture or the scene.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TypeVar

from linkanim.frozen import NamedTuple
from linkanim.player.action import Action
from linkanim.player.keys import commands
from linkanim.player.state import Format, State, Take, TakeChoice, TakeDialog, with_effect, with_toast
from linkanim.units import significant, typeset

SIZES: tuple[tuple[int, int] | None, ...] = (None, (800, 450), (1280, 720), (1920, 1080), (3840, 2160))
"""The sizes of recordings to choose from; None for the window's shape."""
FORMATS: tuple[Format, ...] = ("gif", "mp4")
RUNS = "a recording runs; G or M ends it"
KEEPS = (Action("screenshot"), Action("svg"), Action("share"), Action("save"), Action("save_as"))
"""Other ways to keep the picture or the scene."""
_LONGEST = 300
PLACE = 3
"""The row of the place to write to."""
_START = 4
"""The row that begins the recording."""

Step = TypeVar("Step")


class TakeRow(NamedTuple):
    """A row of the dialog: its name, its value or the key that does the same, its action."""

    label: str
    value: str
    action: Action | None = None


def rows(state: State) -> tuple[TakeRow, ...]:
    """Return the rows of the open dialog: the choices, the row that begins, and other ways to keep things."""
    dialog, choice = state.taking or TakeDialog(), of_a_kind(state)
    typed = f"{dialog.typed}_" if dialog.typed else f"{dialog.place}.{choice.format}"
    keys = {action: (words, key) for words, key, action in commands("play")}
    return (
        TakeRow("Format", choice.format.upper()),
        TakeRow("Size", _sized(choice.size)),
        TakeRow("Length", _period(state) if choice.whole else "until it is stopped"),
        TakeRow("Where to", typed),
        TakeRow("Record", "Enter", Action("take_start")),
        *(TakeRow(*keys[action], action) for action in KEEPS),
    )


def of_a_kind(state: State) -> TakeChoice:
    """Return the choice as it applies now: a game has no period."""
    return state.take._replace(whole=state.take.whole and state.game is None)


def _sized(size: tuple[int, int] | None) -> str:
    return "{} × {}".format(*size) if size else "as the window"


def _period(state: State) -> str:
    seconds = abs(state.scene.period / state.clock.speed)
    return typeset(f"one period, {significant(seconds, 3)} s")


def target(state: State) -> str:
    """Return the file that the open dialog names; empty for a free name."""
    place = state.taking.place if state.taking else ""
    return f"{place}.{state.take.format}" if place else ""


# Actions in the dialog.


def dialog(state: State, _: None) -> State:
    """Open the dialog, or close it."""
    if state.recording:
        return with_toast(state, RUNS)
    opened = None if state.taking else TakeDialog(row=_START)
    return replace(state, taking=opened, help=False, listing=None, browsing=None)


def places(state: State, lines: str) -> State:
    """Keep the current folder and the proposed places, one a line."""
    if state.taking is None:
        return state
    folder, *found = lines.splitlines() or [""]
    return replace(state, taking=state.taking._replace(folder=folder, places=tuple(found)))


def row(state: State, further: int) -> State:
    """Choose the row `further` rows down; the first row follows the last."""
    return _on(state, lambda one: one._replace(row=(one.row + further) % len(rows(state))))


def turn(state: State, steps: int) -> State:
    """Take the chosen row's value that is `steps` further on."""
    if state.taking is None:
        return state
    choice, at = state.take, state.taking.row
    if at == 0:
        choice = choice._replace(format=_after(FORMATS, choice.format, steps))
    elif at == 1:
        choice = choice._replace(size=_after(SIZES, choice.size, steps))
    elif at == 2:
        choice = choice._replace(whole=choice.whole ^ bool(steps % 2) and state.game is None)
    elif at == PLACE and state.taking.places:
        return _on(state, lambda one: one._replace(typed="", at=(one.at + steps) % len(one.places)))
    return replace(_on(state, lambda one: one), take=choice)


def _after(steps: tuple[Step, ...], now: Step, by: int) -> Step:
    return steps[(steps.index(now) + by) % len(steps)] if now in steps else steps[0]


def write(state: State, text: str) -> State:
    """Add to the typed place; an ending that names a format chooses that format."""
    if state.taking is None:
        return state
    return _typed(state, (state.taking.typed + text)[:_LONGEST])


def erase(state: State, _: None) -> State:
    """Erase the last letter of the place, even of a proposed one."""
    if state.taking is None:
        return state
    return _typed(state, state.taking.place[:-1])


def _typed(state: State, text: str) -> State:
    form = next((one for one in FORMATS if text.lower().endswith(f".{one}")), None)
    if form:
        state = replace(state, take=state.take._replace(format=form))
        text = text[: -len(form) - 1]
    return _on(state, lambda one: one._replace(row=PLACE, typed=text))


def refused(state: State, reason: str) -> State:
    """Say why it cannot be written there."""
    return replace(state, taking=state.taking and state.taking._replace(row=PLACE, refusal=reason))


def _on(state: State, work: Callable[[TakeDialog], TakeDialog]) -> State:
    """Return the state with its dialog changed, and nothing refused."""
    return replace(state, taking=state.taking and work(state.taking._replace(refusal="")))


# Actions that record.


def into(state: State, file: str) -> State:
    """Begin what the dialog has chosen: a recording into a file, or at once the recording of a period."""
    choice = of_a_kind(state)
    if choice.whole:
        return with_effect(state, "period", file)
    return replace(
        with_effect(state, "record", choice.format), recording=Take(choice.format, state.frame, file)
    )


def record(state: State, form: Format) -> State:
    """Start a recording, or stop the one that runs, whatever its format."""
    if state.recording is None:
        return replace(with_effect(state, "record", form), recording=Take(form, state.frame))
    return replace(with_effect(state, "render", state.recording.format), recording=None)


def period(state: State, form: Format) -> State:
    """Record one period at the present speed and look: a recording without actions."""
    if state.recording:
        return with_toast(state, RUNS)
    return with_effect(state, "period", form)
