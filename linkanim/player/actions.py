"""Advance the state by actions: one table says which value each takes, what it does, whether tapes keep it.

`advance(state, actions)` is pure, and the only way in which the state changes. Actions on the look, on the
place of the input, on games and on the outside are here; those of `edits`, `pencil`, `posing`, `building`,
`making` and `record_dialog` in their own modules.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from math import isfinite, radians
from typing import Any, TypeVar, get_args

from linkanim.errors import LinkanimError
from linkanim.mechanics.quantities import input_symbol
from linkanim.picture.look import FORCE, TOGGLES, ConstructionKind, Look, answer, toggled
from linkanim.picture.quantities import axes_of, axis_of, chart_tokens, driven_words, quantity, speed_words
from linkanim.player import building, edits, helping, making, record_dialog, rules
from linkanim.player.action import Action
from linkanim.player.clock import Clock
from linkanim.player.edits import drop
from linkanim.player.framing import departed
from linkanim.player.keys import BESIDE_GAMES
from linkanim.player.modes import MODES
from linkanim.player.naming import Naming
from linkanim.player.sketching import leave_sketch
from linkanim.player.state import (
    ATTRACT_AFTER,
    CHIP_FRAMES,
    FLASH_FRAMES,
    MOUSE_FRAMES,
    MOVE_FRAMES,
    SHUTTER_FRAMES,
    Editing,
    Game,
    Rule,
    State,
    Toast,
    followed,
    fresh,
    proved,
    refused,
    with_chip,
    with_effect,
    with_toast,
)
from linkanim.scenes.editing import other_closure
from linkanim.scenes.scene import Scene
from linkanim.units import LENGTH_UNITS
from linkanim.words import LANGUAGES, name_said, said, sentences, to_say

# Actions on the look: what is shown beside the linkage, in which theme, and how near.

Step = TypeVar("Step")

_NOTCH = 1.25
_NOTCHES, _ON_PAPER = (-6, 13), (-8, 16)
"""The least and the greatest zoom, in notches: a linkage in a small room stays a twentieth of the window
large, and none becomes more than 20 times as large. On a sheet there is more to draw on."""
_PLACES = 9


def chart(state: State, further: int) -> State:
    """Chart the key quantity `further` places on; after the last one, and after any other, chart none."""
    charts = (None, *state.scene.telling)
    if state.look.chart not in charts:
        return replace(state, look=replace(state.look, chart=None))
    at = charts.index(state.look.chart)
    return replace(state, look=replace(state.look, chart=charts[(at + further) % len(charts)]))


def toggling(name: str) -> Callable[[State, str | None], State]:
    """Return the handler that takes a field of the look to its next step; of a set, puts in or takes out."""
    return lambda state, member: replace(state, look=toggled(state.look, name, member))


def ghost(state: State, _: None) -> State:
    """Show or hide the other closure, where there is one."""
    if not state.look.ghost:
        try:
            other_closure(state.scene)
        except LinkanimError as error:
            return with_toast(state, str(error))
    return replace(state, look=toggled(state.look, "ghost"))


def vectors(state: State, kind: str) -> State:
    """Show or hide the arrows of a kind; forces only where the scene has any."""
    if kind == FORCE and kind not in state.look.vectors:
        try:
            state.scene.refuse_forceless()
        except LinkanimError as error:
            return with_toast(state, str(error))
    return replace(state, look=toggled(state.look, "vectors", kind))


def polygons(state: State, _: None) -> State:
    """Show both polygons, or none; both where one stands alone."""
    return replace(state, look=replace(toggled(state.look, "polygons"), large_polygon=0))


def unit(state: State, _: None) -> State:
    """Show lengths in the next unit, the scene's own among them."""
    following = _after(effective_look(state).unit, LENGTH_UNITS, usual=state.scene.length_unit)
    return replace(state, look=replace(state.look, unit=following))


def over(state: State, _: None) -> State:
    """Run the chart over the next axis that the scene has, the usual one among them."""
    axes = axes_of(state.scene)
    following = _after(effective_look(state).over, axes, usual=axes[0])
    return replace(state, look=replace(state.look, over=following))


def _after(now: Step | None, steps: tuple[Step, ...], *, usual: Step) -> Step | None:
    """Return the step after this one, None for the usual one."""
    following = steps[(steps.index(now) + 1) % len(steps)] if now in steps else usual
    return None if following == usual else following


def effective_look(state: State) -> Look:
    """Return the look with the scene's usual values instead of None."""
    scene, look = state.scene, state.look
    return replace(look, unit=look.unit or scene.length_unit, over=axis_of(scene, look.over))


def theme(state: State, _: None) -> State:
    """Go from light to dark, or back."""
    return replace(state, look=toggled(state.look, "theme"), faded=state.frame)


def zoom(state: State, about: tuple[float, float, float]) -> State:
    """Zoom by notches of the wheel about a point."""
    notches, x, y = about
    ends = _ON_PAPER if state.building else _NOTCHES
    return replace(state, look=zoomed(state.look, notches, (x, y), ends))


def pan(state: State, by: tuple[float, float]) -> State:
    """Shift the picture right and down, in heights of the window."""
    (across, down), look = by, state.look
    return replace(state, look=replace(look, pan=_rounded(look.pan[0] + across, look.pan[1] + down)))


def fit(state: State, _: None) -> State:
    """Let the linkage fill its room again."""
    return replace(state, look=replace(state.look, zoom=1.0, pan=(0.0, 0.0)))


def zoomed(look: Look, notches: float, about: tuple[float, float], ends: tuple[int, int]) -> Look:
    """Return the look zoomed by `notches`, the point `about` staying where it is.

    `about` is in window heights from the middle of the stage, right and down. As many notches back give the
    same look, unless an end of the range was met.
    """
    low, high = ends
    zoom = _NOTCH ** min(max(round(math.log(look.zoom, _NOTCH) + notches), low), high)
    ratio = zoom / look.zoom
    pan = tuple(point - (point - shift) * ratio for point, shift in zip(about, look.pan, strict=True))
    return replace(look, zoom=zoom, pan=_rounded(pan[0], pan[1]))


def _rounded(x: float, y: float) -> tuple[float, float]:
    """Round far below a pixel, so that going there and back ends at the same picture."""
    return round(x, _PLACES) + 0.0, round(y, _PLACES) + 0.0


# Actions that move the paused input to a typed place: its angle in degrees, or a slider's travel.

_STANDS = 240
_LONGEST = 12


def write(state: State, text: str) -> State:
    """Add to the typed place, which a chip shows until it is taken; 0 alone also fits the view."""
    typed = (state.place_typed + text)[:_LONGEST]
    return _begun(fit(state, None) if typed.strip("0") == "" else state, typed)


def erase(state: State, _: None) -> State:
    """Take the last letter off the place that is typed."""
    return _begun(state, state.place_typed[:-1])


def _begun(state: State, text: str) -> State:
    stands = _STANDS if text.strip("0") else CHIP_FRAMES
    chip = Toast(f"{_symbol(state)} = {text}_", state.frame + stands) if text else None
    return replace(state, place_typed=text, chip=chip)


def _symbol(state: State) -> str:
    return input_symbol(state.scene.linkage).translate({ord("{"): None, ord("}"): None})


def go(state: State, _: None) -> State:
    """Go to the typed place; say the input's range where it does not come there."""
    text, state = state.place_typed, replace(state, place_typed="", chip=None)
    if not text:
        return state
    scene, mechanism = state.displayed, state.displayed.mechanism
    try:
        value = float(text)
    except ValueError:
        return with_toast(state, said("{text} is no number", text=text))
    place = radians(value) if scene.linkage.drive.coordinate.is_angle else value
    if not isfinite(place) or not mechanism.comes_to(place):
        unit = scene.linkage.drive.coordinate.display_unit(f" {scene.length_unit}")
        reach = scene.info.ranges("{}…{}", lambda end: driven_words(scene, end))
        words = said(
            "the {link} does not reach {place}; it goes {reach}",
            link=name_said(scene.info.input_name),
            place=f"{text}{unit}",
            reach=reach,
        )
        return with_toast(state, words)
    phase = mechanism.phase_of(place, state.phase)
    return replace(state, clock=state.clock.go(state.frame, phase, paused=True))


# Actions that the window carries out: the state only says so, in its effects.

_MEANT = to_say("recording: Q again ends it, writes it and quits")


def back(state: State, _: None) -> State:
    """Close what lies on top: the help, a list, a typed value; never the window.

    From a mechanism it leads back to the title, if the window opened on the title.
    """
    if state.help and not state.keys.alone:
        return state.unhelped
    if state.top:
        return state.top.closed(state)
    if state.place_typed:
        return replace(state, place_typed="", chip=None)
    if state.constructed:
        return state.modes[-1].closed(state)
    if state.lesson:
        return replace(state, lesson=None)
    if state.from_title and state.games:
        return with_effect(state, "begin", "title")
    return with_toast(state, said("Q quits"))


def quit_(state: State, _: None) -> State:
    """Ask for the window's end; while something is recorded, only when asked twice."""
    if state.recording and (state.toast is None or state.toast.text != _MEANT):
        return with_toast(state, said(_MEANT))
    return building.closing(state) or with_effect(state, "quit")


def close(state: State, _: None) -> State:
    """Ask for the window's end by its own button; where a draft is in no file, only when asked twice."""
    return building.closing(state) or with_effect(state, "quit")


def save(state: State, _: None) -> State:
    """Write the scene to the file under which it was saved; ask for a name where it was not."""
    return _saved(state, ("save", state.saved_as) if state.saved_as else ("name", None))


def save_as(state: State, _: None) -> State:
    """Ask for the name of another file, and write the scene there."""
    return _saved(state, ("name", None))


def _saved(state: State, asked: tuple[str, str | None]) -> State:
    missing = state.building.building.made.missing if state.building else ""
    if missing:
        return with_toast(
            state, sentences(said("only what can move can be saved; the draft is kept."), missing)
        )
    return with_effect(state, *asked)


def open_toast(state: State, _: None) -> State:
    """Close the toast, and open the folder of the file that it says is saved."""
    told = state.toast.text if state.toast and not state.of(Naming) else ""
    return with_effect(replace(state, toast=None), "folder", told) if told else state


def shot(name: str) -> Callable[[State, None], State]:
    """Return the handler of an effect that saves the picture, with the shutter's flash."""
    return lambda state, _: replace(with_effect(state, name), shot=state.frame)


def effect(name: str) -> Callable[[State, str | None], State]:
    """Return the handler of an effect that changes nothing in the picture."""
    return lambda state, value: with_effect(state, name, value)


# A game replaces the state while it runs; the state before stands beneath, and comes back.

BESIDE = (
    BESIDE_GAMES
    | {"keep_step", "caption_step", "lesson_on"}
    | {"open_toast", "record_into", "mouse_moved", "menu", "note", "hint", "close"}
)
"""Actions that are the window's own while a game is on; all others are handed to the game."""


def play(state: State, words: str) -> State:
    """Begin a game, or the title, by its words; BadInput where they name none."""
    if state.games is None:
        return with_toast(state, said("there are no games in this window; the program's own has them"))
    game = state.games(words)
    if state.beneath is None:
        state = drop(leave_sketch(state), None)
        state = replace(state, beneath=state.unlisted.unhelped)
    bare = replace(state, modes=(), glide=None, home=None, toast=None)
    bare = replace(bare, also=(), place_typed="", chip=None)
    editing = Editing()
    return game.entered(replace(bare, editing=editing, faded=state.frame).with_mode(game))


def leave(state: State) -> State:
    """Return the state beneath the game, paused or running on from where it was."""
    under = state.beneath
    if under is None:
        return state
    look = replace(under.look, theme=state.look.theme)
    clock = under.clock.go(state.frame, under.phase)
    resumed = replace(under, frame=state.frame, clock=clock, look=look, touched=state.touched)
    resumed = replace(
        resumed, from_title=state.from_title, kiosk=state.kiosk, recording_choice=state.recording_choice
    )
    resumed = replace(resumed, language=state.language)
    resumed = replace(
        resumed, last_mouse_move=state.last_mouse_move
    )  # what was clicked in the game has brought the bar
    above = (one for one in state.unlisted.unhelped.modes if not isinstance(one, Game))
    resumed = replace(resumed, modes=(*under.modes, *above))
    return replace(resumed, recording=state.recording, effects=state.effects, faded=state.frame)


def with_scene(state: State, scene: Scene, phase: float = 0.0, *, paused: bool = False) -> State:
    """Return the state with a game's scene, paused at or running from a phase; errors as in `proved`."""
    clock = fresh(proved(scene, phase)).go(state.frame, phase, paused=paused)
    look = replace(state.look, zoom=1.0, pan=(0.0, 0.0), chart=None)
    return replace(
        state, scene=scene, clock=clock, look=look, glide=None, faded=state.frame, arrived=state.frame
    )


# The one table of actions: what value each may have, what it does, and whether a tape keeps it.


def _speed(_: State, after: State) -> str:
    """Say the input's speed."""
    return speed_words(after.scene, after.clock.speed)


def _direction(_: State, after: State) -> str:
    """Say which way the phase runs."""
    return said("forward") if after.clock.direction > 0 else said("reverse")


def _position(before: State, after: State) -> str | None:
    """Say which of the shelf's mechanisms is shown."""
    return None if after.scene is before.scene else f"{after.place + 1} / {len(after.shelf)}"


def _returns(_: State, after: State) -> str:
    """Say on which closure the input comes back."""
    retraced = after.scene.mechanism.retraced
    return said("back on the same closure") if retraced else said("back on the other closure")


def _chart(before: State, after: State) -> str | None:
    """Say what is charted now, or that it is charted no longer."""
    was, now = (chart_tokens(one.scene, one.look.chart) for one in (before, after))
    if was == now or not now:
        return None if was == now else said("no chart")
    new = next((token for token in now if token not in was), None)
    gone = next((token for token in was if token not in now), now[0])
    if new:
        return quantity(after.scene, new).words
    return said("no {shown}", shown=quantity(after.scene, gone).words)


def _zoom(_: State, after: State) -> str:
    """Say how large the picture is."""
    return f"{after.look.zoom:.0%}".replace("%", " %")


def _speak(state: State, language: str) -> State:
    """Say all words in another language; what was said in the one before goes."""
    bare = replace(state.unlisted, language=language, toast=None, chip=None, departures=())
    if not state.sheet:
        return bare
    building = replace(state.sheet.building, sentence="", is_refusal=False)  # what it lacks is said anew
    return replace(bare, sheet=replace(state.sheet, building=building))


def _unused(state: State, _: object) -> State:
    """Do nothing: the action has a meaning only in a game."""
    return state


def _running(work: Callable[[Clock, int, Any], Clock]) -> Callable[[State, Any], State]:
    """Return the handler of an action that changes the clock alone, from the state's frame on."""
    return lambda state, value: replace(state, clock=work(state.clock, state.frame, value))


def _pause(state: State, _: None) -> State:
    """Pause the motion, or let it go on; a paused picture is complete."""
    paused = not state.clock.paused
    clock = state.clock.pause(state.frame, paused)
    return replace(state, clock=clock, glide=None if paused else state.glide)


def _of_look(name: str) -> Rule:
    """Return the rule of a field of the look; some do more than go a step further."""
    more: Mapping[str, Callable[[State, Any], State]] = {
        "ghost": ghost,
        "theme": theme,
        "unit": unit,
        "over": over,
        "polygons": polygons,
        "vectors": vectors,
    }
    handle = more.get(name, toggling(name))
    return Rule(
        rules.one_of(*TOGGLES[name].members),
        handle,
        answer=lambda before, after: answer(effective_look(before), effective_look(after), name),
    )


ACTIONS: Mapping[str, Rule] = {
    **{name: rule for mode in MODES for name, rule in mode.actions.items()},
    "pause": Rule(rules.nothing, _pause),
    "step": Rule(rules.whole, _running(Clock.step)),  # degrees of phase, along the way the crank runs
    "speed": Rule(rules.whole, _running(Clock.faster), answer=_speed),  # steps of the speed ladder
    "level": Rule(
        rules.whole, _running(Clock.at_level), answer=_speed
    ),  # a rung of it, 0 for the scene's own
    "direction": Rule(rules.nothing, _running(lambda clock, frame, _: clock.turn(frame)), answer=_direction),
    "start": Rule(rules.nothing, edits.start, answer=edits.way_back),
    # the phase to go to, rad
    "scrub": Rule(rules.number, _running(lambda clock, frame, phase: clock.go(frame, phase, paused=True))),
    "type_place": Rule(rules.text, write),
    "erase_place": Rule(rules.nothing, erase),
    "go": Rule(rules.nothing, go),
    "mechanism": Rule(rules.whole, edits.mechanism, answer=_position),  # places further on the shelf
    "select": Rule(rules.whole, edits.select, answer=_position),  # the place in the catalogue, from 0
    "put": Rule(rules.whole, building.put, answer=_position),  # the place on the shelf, from 0
    "closure": Rule(rules.nothing, edits.closure, answer=rules.closure),
    **{name: _of_look(name) for name, toggle in TOGGLES.items() if toggle.keys},
    "chart": Rule(rules.whole, chart, answer=_chart),  # quantities further
    "plot": Rule(rules.text, edits.plot, answer=_chart),  # a quantity's token
    "strip": Rule(rules.text, edits.strip, answer=_chart),  # a quantity's token, charted below or removed
    "help": Rule(rules.nothing, helping.toggle),
    # notches, about the point (x, y): window heights from the stage's middle, y down
    "zoom": Rule(rules.numbers(3), zoom, answer=_zoom),
    "pan": Rule(rules.numbers(2), pan),  # window heights, right and down
    "fit": Rule(rules.nothing, fit, answer=_zoom),
    "trace_joint": Rule(rules.text, edits.trace_joint),
    "drive_joint": Rule(rules.text, edits.drive_joint),
    "grab": Rule(rules.text, edits.grab),  # a joint
    # to (x, y) of the scene as shown, in such parts of a nudge's step
    "carry": Rule(rules.numbers(3), edits.carry),
    "drop": Rule(rules.nothing, edits.drop),
    "undo": Rule(rules.nothing, edits.undo, answer=rules.stuck(to_say("nothing to undo"))),
    "reset": Rule(rules.nothing, edits.reset),
    "returns": Rule(rules.nothing, edits.returns, answer=_returns),
    "redo": Rule(rules.nothing, edits.redo, answer=rules.stuck(to_say("nothing to redo"))),
    "dial_on": Rule(rules.whole, making.along),  # so many steps further
    "language": Rule(rules.one_of(*LANGUAGES), _speak),  # of all words
    "play": Rule(rules.text, play),  # a game's words
    # what games have in common; each says what they do in it
    "option": Rule(rules.whole, _unused),  # the place of an answer, from 0
    "next": Rule(rules.nothing, _unused),
    "turn": Rule(rules.whole, _unused),  # small steps, counterclockwise or to the right
    "raise": Rule(rules.whole, _unused),  # steps up
    "construct": Rule(rules.whole, making.construct),  # steps further
    "construction": Rule(rules.one_of(*get_args(ConstructionKind)), making.construction),
    "slide": Rule(rules.whole, making.slide),  # the step of the slider that is shown
    "back": Rule(rules.nothing, back),
    "open_toast": Rule(rules.nothing, open_toast, taped=False),  # a click on it: the folder that it tells of
    "mouse_moved": Rule(
        rules.nothing, lambda state, _: replace(state, last_mouse_move=state.frame), taped=False
    ),
    "open_file": Rule(rules.text, effect("open"), taped=False),
    "screenshot": Rule(rules.nothing, shot("screenshot"), taped=False),
    "svg": Rule(rules.nothing, shot("svg"), taped=False),
    "share": Rule(rules.nothing, effect("share"), taped=False),
    "record": Rule(rules.one_of(*record_dialog.FORMATS), record_dialog.record, taped=False),
    "period": Rule(rules.one_of(*record_dialog.FORMATS), record_dialog.period, taped=False),
    "record_into": Rule(rules.text, record_dialog.into, taped=False),  # the file
    "make": Rule(rules.nothing, making.make, taped=False),
    "fullscreen": Rule(rules.nothing, effect("fullscreen"), taped=False),
    "save": Rule(rules.nothing, save, taped=False),
    "save_as": Rule(rules.nothing, save_as, taped=False),
    "reload": Rule(rules.nothing, effect("reload"), taped=False),
    "quit": Rule(rules.nothing, quit_, taped=False),
    "close": Rule(rules.nothing, close, taped=False),  # the window's own button
    "hint": Rule(rules.text, with_chip, taped=False),  # what letting go would do, as a chip
    "note": Rule(rules.text, with_toast, taped=False),  # something the window has to say, as a toast
}


def is_known(action: Action) -> bool:
    """Tell whether the action is one of ours and its value is of the right kind."""
    rule = ACTIONS.get(action.name)
    return rule is not None and rule.check(action.value)


def is_taped(action: Action) -> bool:
    """Tell whether a tape keeps the action: it is known, and its effect shows in the picture."""
    return is_known(action) and ACTIONS[action.name].taped


# How the state changes: `advance(state, actions)`, pure.
#
# A frame is three steps, so that the window can ask what a key means once earlier keys are carried out: the
# state grows a frame older, each action is carried out, and a kiosk left alone shows its title.

Change = Callable[[State], State]

_SHEETS = frozenset({"build", "sheet", "draft", "photo", "stage"})
"""Actions that open a sheet, or show a step of a lesson, even out of a game."""
_NOT_BY_HAND = frozenset({"note", "hint", "mouse_moved"})
"""Actions that no user asks for, and the one that only brings the bar of commands."""
_LIVES = {
    "last_mouse_move": MOUSE_FRAMES,
    "turned": FLASH_FRAMES,
    "faded": MOVE_FRAMES,
    "shot": SHUTTER_FRAMES,
}
"""For how many frames after the frame in the state's field something is visible."""


def advance(state: State, actions: Iterable[Action] = ()) -> State:
    """Return the state one frame later, with the actions carried out in their order.

    KeyError for an action that is not in `actions.ACTIONS`.
    """
    before, state = state, aged(state)
    for action in actions:
        state = carried(state, action)
    return end_of_frame(before, state)


def aged(state: State) -> State:
    """Return the state a frame older: what has had its time disappears, a glide goes on."""
    state = replace(state, frame=state.frame + 1, effects=())
    if state.toast and state.frame >= state.toast.until:
        state = replace(state, toast=None)
    if state.chip and state.frame >= state.chip.until:
        state = replace(state, chip=None, place_typed="")
    sinces = ((name, getattr(state, name), life) for name, life in _LIVES.items())
    over = [name for name, since, life in sinces if since is not None and state.frame >= since + life]
    state = replace(state, **dict.fromkeys(over)) if over else state  # type: ignore[arg-type]
    for mode in state.modes:
        state = state if mode is state.game else mode.aged(state)
    if state.glide:
        state = _tried(state, Action("glide"), _followed, lambda before: replace(before, glide=None))
    return _tried(state, Action("play"), state.game.aged, leave) if state.game else state


def carried(state: State, action: Action) -> State:
    """Return the state with one action carried out; unchanged, with a message, where the solver fails."""
    if action.name not in _NOT_BY_HAND:
        state = replace(state, touched=state.frame)
        if state.by_itself:
            return leave(state)
    own = {name: rule for mode in state.modes for name, rule in mode.actions.items()}
    beside = BESIDE | _SHEETS | {*own, *([] if state.top is state.game else ["back"])}
    if state.game and action.name not in beside:
        return _in_a_game(state, state.game, action)
    rule = own.get(action.name) or ACTIONS[action.name]
    refusals = (one.forbids(state, action) for one in state.modes)
    if (why := next((one for one in refusals if one is not None), None)) is not None:
        return with_toast(state, why) if why else state
    if state.game and action.name in _SHEETS:
        state = leave(state)
        if state.building and action.name == "build":
            return state  # the sheet that was open beneath
    for mode in reversed(state.modes):
        state = mode.ready_for(state, action)

    def handled(before: State) -> State:
        after = rule.handle(before, action.value)
        for mode in after.modes:
            after = mode.agreed(before, after)
        return with_chip(after, rule.answer(before, after)) if rule.answer else after

    return _tried(state, action, handled)


def end_of_frame(before: State, state: State) -> State:
    """Return the state at the end of a frame, with what it leaves of that of the frame before.

    In a kiosk a mechanism left alone gives way to the title, unless it is paused, recorded, or has something
    open.
    """
    alone = state.frame - state.touched >= ATTRACT_AFTER
    if state.kiosk and state.games and alone and state.is_bare:
        titled = carried(state, Action("play", "title"))
        state = replace(titled, touched=state.touched, by_itself=True)
    return departed(before, state)


def _in_a_game(state: State, game: Game, action: Action) -> State:
    """Return the state with an action handed to its game; while the help is open, only back is possible."""
    if state.help:
        return state.unhelped if action.name == "back" else state
    return _tried(state, action, lambda before: game.carried(before, action))


def _followed(state: State) -> State:
    return replace(state, glide=state.glide and followed(state.glide, state.scene, state.frame))


def _tried(state: State, action: Action, work: Change, without: Change = lambda before: before) -> State:
    """Return the state with some work done; where a solver fails at it, `without` it and with a message."""
    try:
        return work(state)
    except Exception as error:
        return refused(without(state), action, error)
