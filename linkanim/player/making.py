"""Two modes: the steps of a construction, which is seen through; the layers in which a scene can be made."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from math import degrees
from typing import TYPE_CHECKING, ClassVar, Literal

import numpy as np

from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.intake import Intake, Section
from linkanim.mechanics.linkage import Linkage
from linkanim.picture.build_sheet import Head
from linkanim.picture.drawn import Addition
from linkanim.picture.items import Group
from linkanim.picture.layered import Frame, Layered, LayeredPin, LayeredPlate
from linkanim.picture.look import ConstructionKind, Look
from linkanim.picture.raster import Loop
from linkanim.picture.shapes import disc, hull
from linkanim.picture.slider import Slider
from linkanim.player import rules
from linkanim.player.action import Action
from linkanim.player.edits import drop, exchanged, followed
from linkanim.player.keys import BACK_BAR, HOME_BAR, LAST_BAR, BarEntry, KeyRow, ModeKeys, both, enter
from linkanim.player.state import (
    Held,
    Mode,
    Rule,
    State,
    cleared,
    with_effect,
    with_toast,
    with_undo,
)
from linkanim.scenes.scene import Scene, TimeRatioPurpose
from linkanim.units import significant
from linkanim.words import said, said_many, sentences

if TYPE_CHECKING:
    from linkanim.mechanics.motion import Pose
    from linkanim.picture.figure import DrawSetting
    from linkanim.player.hand import Gesture, Hand
    from linkanim.player.sight import Sight

_MADE = Intake("the layers of a linkage", most_bytes=10_000_000, most_values=1_000_000)
_WHERE, _DAMAGED = "the layers", "are damaged, or not what linkanim make prints"
_MOST_LAYERS = 1_000
LIFTED = 20
"""Steps by which layers are lifted off each other, from flat to as far as there is room."""
_CLOSE = frozenset({"edit", "pencil", "own_trace", "poses", "build", "build_on", "sheet", "draft", "photo"})
"""Actions on the linkage itself, for which the layers are closed first."""


def layers(state: State, _: None) -> State:
    """Show the layers in which the scene can be made, once they are found; or the scene again."""
    if state.of(Layering):
        return closed(state)
    bare = drop(replace(state.unlisted, glide=None, toast=None), None)
    return asked(replace(bare, faded=state.frame))


def closed(state: State) -> State:
    """Return the state without layers: its scene is drawn as a linkage again."""
    return replace(state.without(Layering), faded=state.frame) if state.of(Layering) else state


def asked(state: State) -> State:
    """Return the state with the layers of its scene asked for."""
    before = state.of(Layering)
    lifted = before.lifted if before else 0
    return with_effect(state.with_mode(Layering(state.scene, lifted=lifted)), "layers")


def show_layers(state: State, text: str) -> State:
    """Show the layers that `linkanim make --json` has printed, or say why there are none."""
    shown = state.of(Layering)
    if shown is None:
        return state
    document = _MADE.parsed(text, _WHERE, _DAMAGED)
    if not isinstance(document, dict):
        raise BadInput(f"{_WHERE}: {_DAMAGED}")
    top = Section(_WHERE, document)
    if document.get("refused") is not None:
        return state.with_mode(replace(shown, refused=top.text("refused"), text=text))
    return state.with_mode(replace(shown, parts=_parts(shown.scene, top), text=text))


def lift(state: State, by: int) -> State:
    """Lift the layers further off each other, by a number of steps."""
    shown = state.of(Layering)
    return lift_to(state, shown.lifted + by) if shown else state


def lift_to(state: State, step: int) -> State:
    """Lift the layers off each other to a step of the slider."""
    shown = state.of(Layering)
    return state.with_mode(replace(shown, lifted=min(max(step, 0), LIFTED))) if shown else state


FAMILY = 100
"""Steps from one end of a family of linkages to the other."""


@frozen
class Construction(Mode):
    """So many steps of a scene's construction, while that scene is shown."""

    scene: Scene
    steps: int

    actions: ClassVar[Mapping[str, Rule]] = {}
    sees_through = True

    def steps_of(self, scene: Scene) -> int:
        """Return how many steps of a scene's construction it draws."""
        return self.steps if scene is self.scene else 0

    def drawn(self, state: State) -> tuple[Addition, ...]:
        """Return a slider along the scene's family."""
        slider = _slider(state)
        return (slider,) if slider else ()


def _slider(state: State) -> Slider | None:
    """Return the slider for what is shown; None where it has none."""
    if not state.constructed or not isinstance(state.scene.purpose, TimeRatioPurpose):
        return None
    from linkanim.synthesis.quick_returns import member_of

    member = member_of(state.scene)
    if member is None:
        return None
    least, best = (f"{degrees(angle):.1f}°" for angle in (member.transmission, member.best))
    label = said("transmission {least}, best {best}", least=least, best=best)
    ends = said("short coupler"), said("long coupler")
    return Slider(label, *ends, FAMILY, round(member.place * FAMILY))


def construct(state: State, further: int) -> State:
    """Draw `further` steps more of the scene's synthesis, then of its dead centres and its centres.

    After the last step none is drawn. BadInput for a scene that has no construction.
    """
    from linkanim.picture.constructed import all_steps

    at = (state.constructed + further) % (all_steps(state.scene) + 1)
    return state.with_mode(Construction(state.scene, at)) if at else state.without(Construction)


def construction(state: State, kind: ConstructionKind) -> State:
    """Draw the first step of a construction; BadInput where the scene does not have it."""
    from linkanim.picture.constructed import steps_before

    return state.with_mode(Construction(state.scene, steps_before(state.scene, kind) + 1))


def slide(state: State, step: int) -> State:
    """Move the shown slider to a step: it lifts the layers, or goes along the family of a time ratio.

    However far it is moved, undo goes back to where it was grasped.
    """
    if state.of(Layering) or not state.constructed:
        return lift_to(state, step)
    held = state.held or Held("", state.scene, state.phase, not state.clock.paused)
    scene, steps = _member(held.scene, step), state.constructed
    editing = state.editing if state.scene is not held.scene else with_undo(state.editing, held.scene)
    state = exchanged(replace(state, held=held, glide=None, editing=cleared(editing)), scene)
    return state.with_mode(Construction(scene, steps))


def along(state: State, by: int) -> State:
    """Go by a number of steps along the family of a time ratio, while its construction is drawn."""
    from linkanim.synthesis.quick_returns import member_of

    member = member_of(state.scene) if state.constructed else None
    if member is None:
        return state
    steps, scene = state.constructed, _member(state.scene, round(member.place * FAMILY) + by)
    state = replace(state, editing=cleared(with_undo(state.editing, state.scene)))
    return followed(state, scene).with_mode(Construction(scene, steps))


def _member(scene: Scene, step: int) -> Scene:
    from linkanim.synthesis.quick_returns import moved_along

    return moved_along(scene, min(max(step, 0), FAMILY) / FAMILY)


def make(state: State, _: None) -> State:
    """Ask for the parts of the present scene to be written into a folder."""
    missing = state.building.building.made.missing if state.building else ""
    if missing:
        return with_toast(
            state, sentences(said("only what can move can be made; the draft is kept."), missing)
        )
    return with_effect(state, "make")


def _parts(scene: Scene, top: Section) -> Layered:
    """Return parts in layers from the printed JSON; BadInput where it is not of this scene."""
    plates = tuple(_plate(scene.linkage, one) for key in ("parts", "fittings") for one in _each(top, key))
    pins = [_pin(scene.linkage, one, named=True) for one in _each(top, "pins")]
    pins += [_pin(scene.linkage, one, named=False) for one in _each(top, "dowels")]
    if not plates:
        raise BadInput(f"{_WHERE}: {_DAMAGED}")
    return Layered(scene, top.number("scale"), plates, tuple(pins))


def _each(top: Section, key: str) -> list[Section]:
    items = top.listed(key)
    return [items.table(item) for item in items.values]


def _plate(linkage: Linkage, part: Section) -> LayeredPlate:
    loops = [_loop(part, "outline")]
    loops += [at + disc(wide / 2) for at, wide in (_circle(row) for row in _rows(part, "holes", 3))]
    loops += [_slot(row) for row in _rows(part, "slots", 5)]
    cuts = part.listed("cuts")
    loops += [_loop(cuts, cut) for cut in cuts.values]
    layer, toothed = part.whole("layer", 0, _MOST_LAYERS), part.values.get("teeth") is not None
    return LayeredPlate(
        _frame(linkage, part), layer, part.text("number"), _point(part, "number_at"), tuple(loops), toothed
    )


def _pin(linkage: Linkage, pin: Section, *, named: bool) -> LayeredPin:
    low, high = (pin.whole(key, 0, _MOST_LAYERS) for key in ("from", "to"))
    return LayeredPin(_frame(linkage, pin), _point(pin, "at"), low, high, pin.text("joint") if named else "")


def _frame(linkage: Linkage, part: Section) -> Frame:
    origin = part.text("origin") if part.values.get("origin") is not None else None
    ends = part.texts("towards") if part.values.get("towards") is not None else ()
    if not {origin, *ends} - {None} <= linkage.by_name.keys() or len(ends) not in (0, 2):
        raise part.error("origin", "names a joint that the linkage does not have")
    turn = complex(np.exp(1j * part.number("turned")))
    return Frame(origin, (ends[0], ends[1]) if ends else None, turn)


def _point(part: Section, key: str) -> complex:
    pair = part.listed(key, 2)
    x, y = (pair.number(item) for item in pair.values)
    return complex(x, y)


def _rows(part: Section, key: str, count: int) -> list[tuple[float, ...]]:
    rows = part.listed(key)
    result = []
    for row in rows.values:
        items = rows.listed(row, count)
        result.append(tuple(items.number(item) for item in items.values))
    return result


def _circle(row: tuple[float, ...]) -> tuple[complex, float]:
    x, y, wide = row
    return complex(x, y), wide


def _slot(row: tuple[float, ...]) -> Loop:
    *ends, wide = row
    round_ends = [complex(*at) + disc(wide / 2) for at in (ends[:2], ends[2:])]
    return np.array(hull(np.concatenate(round_ends).tolist()))


def _loop(part: Section, key: str) -> Loop:
    points = _rows(part, key, 2)
    if len(points) < 3:
        raise part.error(key, "must be three corners or more")
    return np.array([complex(*point) for point in points])


@frozen
class Layering(Mode, Addition):
    """The layers of a scene: its parts once they are known, or a sentence on why it cannot be made.

    They are `lifted` by so many steps; `text` is the result of `linkanim make`, as a tape keeps it.
    """

    scene: Scene
    parts: Layered | None = None
    refused: str = ""
    lifted: int = 0
    text: str = ""

    keys = ModeKeys(
        "layers",
        {
            "in F6": (
                KeyRow("↑ ↓, slider", "lift the layers off each other", both("down", "up", "lift")),
                KeyRow("Enter", "write the parts, as pages to print, into a folder", enter("make")),
                KeyRow("Esc, F6", "the linkage again"),
            )
        },
    )
    bar = (
        *(BACK_BAR, HOME_BAR, BarEntry("nearer", Action("lift", -1), 4, leads=True)),
        *(
            BarEntry("farther", Action("lift", 1), 4),
            BarEntry("save", Action("make"), 3, leads=True),
            *LAST_BAR,
        ),
    )
    actions: ClassVar[Mapping[str, Rule]] = {
        "layers": Rule(rules.nothing, layers),
        "layered": Rule(rules.text, show_layers),  # the layers as `linkanim make --json` prints them
        "lift": Rule(rules.whole, lift),  # steps
    }
    has_head, is_paper = True, True

    def look(self, look: Look) -> Look:
        """Return the look of the picture: bare, at the same zoom and pan."""
        return Look(theme=look.theme, hud=False, zoom=look.zoom, pan=look.pan)

    def ready_for(self, state: State, action: Action) -> State:
        """Close the layers for an action on the linkage itself."""
        return closed(state) if action.name in _CLOSE else state

    def aged(self, state: State) -> State:
        """Ask for the layers of another scene, once it is there."""
        return state if self.scene is state.scene else asked(state)

    def closed(self, state: State) -> State:
        """Return the state with the linkage again."""
        return closed(state)

    def drawn(self, state: State) -> tuple[Addition, ...]:
        """Return the parts in layers, words about them, and a slider.

        In the frame in which another scene appears the layers are still those of the one before, and not
        shown.
        """
        is_own = self.scene is state.scene
        parts, refused = (self.parts, self.refused) if is_own else (None, "")
        if parts is None:
            waits = said("{title}: looking for layers in which it can turn", title=said(state.scene.title))
            return (Head(refused or waits, is_warning=bool(refused)),)
        times = said("in true size")
        if parts.ratio != 1:
            times = said("{number} times as large", number=significant(parts.ratio, 3))
        on = said_many("{count} layer on the ground", "{count} layers on the ground", parts.layers)
        counted = said(
            "{parts} parts, {pins} pins, {size}", parts=len(parts.plates), pins=len(parts.pins), size=times
        )
        facts = counted, said("Enter writes the parts")
        sentence = said("{title}: {part}", title=said(self.scene.title), part=on)
        slider = Slider(said("layers"), said("flat"), said("lifted"), LIFTED, self.lifted)
        return Head(sentence, facts, has_slider=True), self, slider

    @property
    def alone(self) -> Literal["bare"]:
        """The parts stand in the linkage's place."""
        return "bare"

    def groups(self, setting: DrawSetting, pose: Pose) -> Iterator[Group]:
        """Yield the parts in their layers."""
        if self.parts:
            from linkanim.picture.layered import in_layers

            yield in_layers(setting, pose, self.parts, self.lifted / LIFTED)

    def mouse(self, gesture: Gesture, mouse: Hand, screen: Sight) -> tuple[Action, ...] | None:
        """Shift the parts, which have no crank pin to drag; None where the mouse acts as usual."""
        del screen
        if gesture.kind != "down":
            return None
        mouse.drag = "pan"
        return ()
