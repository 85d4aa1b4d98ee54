"""The one table of actions: what value each may have, what it does, and whether a tape keeps it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, NamedTuple, cast

from linkanim.intake import control_in
from linkanim.picture.diagrams.quantities import quantity
from linkanim.picture.look import TOGGLES, answer
from linkanim.picture.parts.driven import speed_words
from linkanim.player.state.action import Action
from linkanim.player.state.clock import Clock
from linkanim.player.state.handlers import build, edits, games, looks, outside, pencil, places, shelf
from linkanim.player.state.state import State, with_toast
from linkanim.scenes.editing.closures import closure_name


class Rule(NamedTuple):
    """One action: the test that its value must pass, and what it makes of a state.

    `taped` is False for what is done outside the picture, which no tape keeps. `answer` says in a word or two
    what has come of it, from the states before and after.
    """

    check: Callable[[object], bool]
    handle: Callable[[State, Any], State]
    taped: bool = True
    answer: Callable[[State, State], str | None] | None = None


_MOST_NUMBERS = 1_000
MOST_STEPS, LARGEST_NUMBER = 10**9, 1e100
"""The most of an action's value: no key or mouse gives more, and no float holds whatever a tape may say."""
_FARTHEST = 1e18
"""The same of a place on a sheet, in whose figures places are squared and counted in steps."""


def _nothing(value: object) -> bool:
    return value is None


def _whole(value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and abs(value) <= MOST_STEPS


def _number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) <= LARGEST_NUMBER


def _text(value: object) -> bool:
    return isinstance(value, str) and not control_in(value)


def _one_of(*words: str | None) -> Callable[[object], bool]:
    return lambda value: value in words


def _numbers(count: int) -> Callable[[object], bool]:
    return lambda value: isinstance(value, tuple) and len(value) == count and all(map(_number, value))


def _grouped(value: object, each: int) -> bool:
    """Tell whether a value is a number, followed by groups of so many others."""
    if not isinstance(value, tuple) or not 1 < len(value) <= _MOST_NUMBERS:
        return False
    return len(value) % each == 1 and all(map(_number, value))


def _pairs(value: object) -> bool:
    return _grouped(value, 2)


def _place_of_sheet(value: object) -> bool:
    return _numbers(2)(value) and all(abs(at) <= _FARTHEST for at in cast(tuple[float, ...], value))


def _hand(value: object) -> bool:
    """Tell whether a value is what the hand does: x and y, how near is on a thing, the step, 0 for none."""
    if not _numbers(4)(value):
        return False
    *place, reach, snap = cast(tuple[float, ...], value)
    near = _place_of_sheet(tuple(place)) and 0.0 <= reach <= _FARTHEST
    return near and (snap == 0.0 or 1.0 / _FARTHEST <= snap <= _FARTHEST)


def _answer(value: object) -> bool:
    # of the search nothing is imported before the pencil is taken
    from linkanim.synthesis.answer import NUMBERS

    return _numbers(NUMBERS)(value)


def _answers(value: object) -> bool:
    from linkanim.synthesis.answer import NUMBERS

    return _grouped(value, NUMBERS)


def _speed(_: State, after: State) -> str:
    """Say the input's speed."""
    return speed_words(after.scene, after.clock.speed)


def _direction(_: State, after: State) -> str:
    """Say which way the phase runs."""
    return "forward" if after.clock.direction > 0 else "reverse"


def _place(before: State, after: State) -> str | None:
    """Say which of the shelf's mechanisms is on."""
    return None if after.scene is before.scene else f"{after.place + 1} / {len(after.shelf)}"


def _closure(before: State, after: State) -> str | None:
    """Say which of the two closures is on."""
    return None if after.scene is before.scene else closure_name(after.scene)


def _returns(_: State, after: State) -> str:
    """Say on which closure the input comes back."""
    return f"back on the {'same' if after.scene.linkage.drive.retraced else 'other'} closure"


def _chart(before: State, after: State) -> str | None:
    """Say what is charted."""
    token = after.look.chart
    if token == before.look.chart:
        return None
    return quantity(after.scene, token).words if token else "no chart"


def _sounds(_: State, after: State) -> str:
    """Say whether the motion is heard."""
    return "sounds" if after.is_audible else "no sounds"


def _zoom(_: State, after: State) -> str:
    """Say how large the picture is."""
    return f"{after.look.zoom:.0%}".replace("%", " %")


def _unused(state: State, _: object) -> State:
    """Do nothing: without a game there is no use for it."""
    return state


def _stuck(words: str) -> Callable[[State, State], str | None]:
    """Return what says so where there was nothing to do; else the list or the sheet shows it."""
    return lambda was, now: words if (was.editing, was.sheet) == (now.editing, now.sheet) else None


def _running(work: Callable[[Clock, int, Any], Clock]) -> Callable[[State, Any], State]:
    """Return the handler of what changes the clock alone, from the frame of the state on."""
    return lambda state, value: replace(state, clock=work(state.clock, state.frame, value))


def _of_look(name: str) -> Rule:
    """Return the rule of a field of the look; some do more than to go on a step."""
    more = {"ghost": looks.ghost, "theme": looks.theme, "unit": looks.unit, "over": looks.over}
    handle = more.get(name, looks.toggling(name))
    return Rule(
        _one_of(*TOGGLES[name].members),
        handle,
        answer=lambda before, after: answer(looks.settled(before), looks.settled(after), name),
    )


ACTIONS: Mapping[str, Rule] = {
    "pause": Rule(_nothing, _running(lambda clock, frame, _: clock.pause(frame, not clock.paused))),
    "step": Rule(_whole, _running(Clock.step)),  # degrees of phase, along the way the crank runs
    "speed": Rule(_whole, _running(Clock.faster), answer=_speed),  # steps of the speed ladder
    "direction": Rule(_nothing, _running(lambda clock, frame, _: clock.turn(frame)), answer=_direction),
    "start": Rule(_nothing, edits.start, answer=edits.way_back),
    # the phase to go to, rad
    "scrub": Rule(_number, _running(lambda clock, frame, phase: clock.go(frame, phase, paused=True))),
    "type_place": Rule(_text, places.write),
    "erase_place": Rule(_nothing, places.erase),
    "go": Rule(_nothing, places.go),
    "mechanism": Rule(_whole, shelf.mechanism, answer=_place),  # places further on the shelf
    "select": Rule(_whole, shelf.select, answer=_place),  # the place in the catalogue, from 0
    "put": Rule(_whole, build.put, answer=_place),  # the place on the shelf, from 0
    "closure": Rule(_nothing, shelf.closure, answer=_closure),
    **{name: _of_look(name) for name, toggle in TOGGLES.items() if toggle.keys},
    "chart": Rule(_whole, looks.chart, answer=_chart),  # quantities further
    "plot": Rule(_text, shelf.plot, answer=_chart),  # a quantity's token
    "help": Rule(_nothing, lambda state, _: replace(state, help=not state.help)),
    # notches, about the point (x, y): window heights from the picture's middle, y down
    "zoom": Rule(_numbers(3), looks.zoom, answer=_zoom),
    "pan": Rule(_numbers(2), looks.pan),  # window heights, right and down
    "fit": Rule(_nothing, looks.fit, answer=_zoom),
    "edit": Rule(_nothing, edits.edit),
    "choose": Rule(_whole, edits.choose),
    "pass_on": Rule(_whole, edits.pass_on),
    "nudge": Rule(_whole, edits.nudge),
    "type": Rule(_text, edits.write),
    "erase": Rule(_nothing, edits.erase),
    "take": Rule(_nothing, edits.take),
    "grab": Rule(_text, edits.grab),  # a joint
    # to (x, y) of the scene as shown, in such parts of a nudge's step
    "carry": Rule(_numbers(3), edits.carry),
    "grab_row": Rule(_whole, edits.grab_row),  # a row of the list of dimensions
    "pull": Rule(_whole, edits.pull),  # steps from the value that was taken hold of
    "drop": Rule(_nothing, edits.drop),
    "undo": Rule(_nothing, edits.undo, answer=_stuck("nothing to undo")),
    "reset": Rule(_nothing, edits.reset),
    "returns": Rule(_nothing, edits.returns, answer=_returns),
    "redo": Rule(_nothing, edits.redo, answer=_stuck("nothing to redo")),
    "pencil": Rule(_nothing, pencil.pencil),
    "own_trace": Rule(_nothing, pencil.own),
    "pen_down": Rule(_numbers(2), pencil.down),  # (x, y) in the scene's unit
    "pen_to": Rule(_numbers(2), pencil.along),
    "pen_up": Rule(_nothing, pencil.up),
    "pen_off": Rule(_nothing, pencil.off),
    "stroke": Rule(_pairs, pencil.stroke),  # 1 closed, 0 open; x, y of each point
    "follow": Rule(_answer, pencil.follow),  # an answer's numbers
    "answers": Rule(_answers, pencil.answers),  # which one is shown; the numbers of each
    "answer": Rule(_whole, pencil.choose),  # its place in the row
    "take_point": Rule(_whole, pencil.take_point),  # its place on the stroke
    "take_pivot": Rule(_text, pencil.take_pivot),
    "lead": Rule(_numbers(2), pencil.lead),  # to (x, y) in the scene's unit
    "let_go": Rule(_nothing, pencil.let_go),
    "keep": Rule(_nothing, pencil.keep),
    "take_back": Rule(_nothing, pencil.take_back),
    "play": Rule(_text, games.play),  # a game's words
    # what games have in common; each says what they do in it
    "option": Rule(_whole, _unused),  # the place of an answer, from 0
    "next": Rule(_nothing, _unused),
    "turn": Rule(_whole, _unused),  # small steps, counterclockwise or to the right
    "raise": Rule(_whole, _unused),  # steps up
    "build": Rule(_nothing, build.build),
    "build_on": Rule(_nothing, build.build_on),
    "sheet": Rule(_nothing, build.new),
    "draft": Rule(_text, build.draft),  # a draft as it is stored
    "tool": Rule(_text, build.tool),
    "photo": Rule(_text, build.photo),  # a picture's file, "" for none
    # (x, y) of the sheet, how near counts as on it, the step of what is drawn
    "hand_down": Rule(_hand, build.down),
    "hand_to": Rule(_hand, build.along),
    "hand_up": Rule(_nothing, build.up),
    "cursor": Rule(_place_of_sheet, build.cursor),  # (x, y) of the sheet
    "further": Rule(_whole, build.further),
    "number": Rule(_whole, build.number),
    "digits": Rule(_text, build.write),
    "undigit": Rule(_nothing, build.erase),
    "take_number": Rule(_nothing, build.take),
    "remove": Rule(_nothing, build.remove),
    "trace_on": Rule(_nothing, build.trace),
    "drive_by": Rule(_nothing, build.drive),
    "unbuild": Rule(_nothing, build.undo, answer=_stuck("nothing to undo")),
    "rebuild": Rule(_nothing, build.redo, answer=_stuck("nothing to redo")),
    "back": Rule(_nothing, outside.back),
    "list": Rule(_nothing, shelf.list_, taped=False),
    "shelf": Rule(_nothing, shelf.open_shelf, taped=False),
    "files": Rule(_text, shelf.files, taped=False),  # scene files, one a line
    "open_file": Rule(_text, outside.effect("open"), taped=False),
    "move": Rule(_whole, shelf.move, taped=False),  # rows of the list, or places on the shelf
    "point": Rule(_whole, shelf.point, taped=False),  # the place on the shelf
    "top": Rule(_whole, shelf.top, taped=False),  # the shelf's row that is the first in sight
    "sift": Rule(_text, shelf.sift, taped=False),
    "unsift": Rule(_nothing, shelf.unsift, taped=False),
    "record": Rule(_one_of("gif", "mp4"), outside.record, taped=False),
    "screenshot": Rule(_nothing, outside.shot("screenshot"), taped=False),
    "svg": Rule(_nothing, outside.shot("svg"), taped=False),
    "share": Rule(_nothing, outside.effect("share"), taped=False),
    "fullscreen": Rule(_nothing, outside.effect("fullscreen"), taped=False),
    "save": Rule(_nothing, outside.effect("save"), taped=False),
    "reload": Rule(_nothing, outside.effect("reload"), taped=False),
    "quit": Rule(_nothing, outside.quit_, taped=False),
    "close": Rule(_nothing, outside.close, taped=False),  # the window's own button
    "sounds": Rule(_nothing, outside.sounds, taped=False, answer=_sounds),
    "pad": Rule(_text, outside.pad, taped=False),  # what is plugged in is called; empty for nothing
    "note": Rule(_text, with_toast, taped=False),  # something the window has to say, as a toast
}


def is_known(action: Action) -> bool:
    """Tell whether the action is one of ours and its value is of the right kind."""
    rule = ACTIONS.get(action.name)
    return rule is not None and rule.check(action.value)


def is_taped(action: Action) -> bool:
    """Tell whether a tape keeps the action: one that is known and shows in the picture."""
    return is_known(action) and ACTIONS[action.name].taped
