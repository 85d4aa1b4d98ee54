"""A mode: a list at the side, of the scene's quantities or of commands, filtered by what is typed."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from linkanim.frozen import frozen
from linkanim.mechanics.linkage import Body
from linkanim.mechanics.motion import Pose
from linkanim.mechanics.quantities import Quantity
from linkanim.picture.lists import Quantities
from linkanim.picture.quantities import chart_tokens, quantity
from linkanim.player import rules
from linkanim.player.action import Action, Value
from linkanim.player.browsing import filtered
from linkanim.player.commands import LISTED_BAR, Entries, menu_of
from linkanim.player.keys import KeyRow, ModeKeys, TypedKeys, both, enter, on
from linkanim.player.state import Mode, Resolver, Rule, State
from linkanim.scenes.scene import Scene
from linkanim.units import four_digits, significant
from linkanim.words import to_say

if TYPE_CHECKING:
    from linkanim.player.hand import Gesture, Hand, Outside
    from linkanim.player.sight import Sight

_LONGEST = 40
_OTHERS_HINT = to_say("↑ ↓ choose   type to filter   Enter takes   Esc closes")
_HINT = to_say("↑ ↓ choose   type to filter   Enter charts   Ctrl+Enter adds   Esc closes")
_READ, _NEAR = 15, 80
"""How many frames a value stands, and how many rows near the chosen one have one."""


def listed(scene: Scene, typed: str) -> tuple[str, ...]:
    """Return the tokens of the quantities with a value that have all the typed words, key ones first."""
    quantities = {token: quantity(scene, token) for token in scene.valued}
    return filtered({token: (token, one.words, one.symbol) for token, one in quantities.items()}, typed)


def _toggle(state: State, below: str | None) -> State:
    """Open the list of quantities, at the charted one, or close it.

    For another chart `below` it opens at the next quantity that is not charted.
    """
    if state.of(Listing):
        return state.without(Listing)
    tokens = listed(state.scene, "")
    charted = chart_tokens(state.scene, state.look.chart)
    at = next((tokens.index(token) for token in charted if token in tokens), 0)
    if below:
        turned = (n % len(tokens) for n in range(at, at + len(tokens)))
        at = next((n for n in turned if tokens[n] not in charted), at)
    return state.unlisted.with_mode(Listing(at, adds=bool(below)))


def _menu(state: State, group: str | None) -> State:
    """Open the list of the mode's commands, all or a group of them; close it where it is open.

    Another list than the one that is open takes its place.
    """
    before, state = state.of(Listing), state.unlisted
    opened = menu_of(state, group) if not state.keys.alone else None
    if opened is None or (before and before.title == opened.title):
        return state
    return state.unhelped.with_mode(Listing(0, others=opened))


def _move(state: State, further: int) -> State:
    """Choose the row `further` places on among those found; the list has ends."""
    listing = state.of(Listing)
    if listing is None:
        return state
    last = max(len(listing.matches(state.scene)) - 1, 0)
    return state.with_mode(replace(listing, chosen=min(max(listing.chosen + further, 0), last)))


def _filter(state: State, text: str) -> State:
    """Add letters to what the list is searched for; it goes to its top."""
    return _relisted(state, lambda typed: (typed + text)[:_LONGEST])


def _erase_filter(state: State, _: None) -> State:
    """Take the last letter off what the list is searched for; it goes to its top."""
    return _relisted(state, lambda typed: typed[:-1])


def _relisted(state: State, work: Callable[[str], str]) -> State:
    listing = state.of(Listing)
    if listing is None:
        return state
    typed, others = work(listing.typed), listing.others
    others = others and replace(others, typed=typed)
    return state.with_mode(replace(listing, chosen=0, typed=typed, others=others))


def _pick(window: Outside, row: Value) -> Iterator[Action]:
    """Yield the action that takes a row of the list; without a row, the chosen one."""
    if listing := window.state.of(Listing):
        asked = listing.asked(window.state.scene, row if isinstance(row, int) else listing.chosen)
        yield from (Action("back"),) if listing.others or listing.adds else ()
        yield from window.resolved(asked) if asked else ()


def _tick(window: Outside, row: Value) -> Iterator[Action]:
    """Yield the action that charts a row's quantity below the others; without a row, the chosen one's."""
    listing = window.state.of(Listing)
    if listing and listing.others is None:
        row = row if isinstance(row, int) else listing.chosen
        yield from (Action("strip", token) for token in listing.matches(window.state.scene)[row : row + 1])


def value_words(scene: Scene, one: Quantity, pose: Pose) -> str:
    """Return a quantity's symbol and its value at a pose, a vector by its components.

    A crank's angle is given within one turn, as in the HUD.
    """
    value = one.displayed(pose)
    parts = value if isinstance(value, tuple | list | np.ndarray) and np.ndim(value) else (value,)
    if scene.info.full_turn and any(one.token == f"{body.name}.angle" for body in _cranks(scene)):
        parts = tuple(float(significant(float(part) % 360, 4)) % 360 for part in parts)
    values = ", ".join(four_digits(float(part)) for part in parts if part is not None)
    unit = one.display_unit(scene.length_unit)
    return f"{one.symbol} = {values or '–'}{'' if unit == '°' else ' '}{unit}".rstrip()


def _cranks(scene: Scene) -> Iterator[Body]:
    return (body for body in scene.linkage.bodies if scene.linkage.crank_of(body))


@frozen
class Listing(Mode):
    """The open list, of quantities or of `others`: the chosen row, and the letters that filter the list.

    With `adds` a quantity is charted below the present charts, not in their place.
    """

    chosen: int
    typed: str = ""
    others: Entries | None = None
    adds: bool = False

    keys = ModeKeys(
        "list",
        {
            "in K": (
                KeyRow(
                    "↑ ↓",
                    "choose a quantity",
                    both("up", "down", "move") + both("pageup", "pagedown", "move", 10),
                ),
                KeyRow("type", "filter by name"),
                KeyRow("Enter, click", "chart it", enter("pick", "erase_filter")),
                KeyRow(
                    "Ctrl+Enter, its box",
                    "chart it below the others; off again",
                    on("ctrl+return ctrl+kp_enter", "tick"),
                ),
            )
        },
        TypedKeys("filter", frozenset({"space", "h", "k"})),
    )
    bar = LISTED_BAR
    actions: ClassVar[Mapping[str, Rule]] = {
        "list": Rule(rules.one_of(None, "below"), _toggle, taped=False),  # "below": for another chart
        "menu": Rule(
            rules.words_or_none, _menu, taped=False
        ),  # some commands, as `commands.menu_of` has them
        "move": Rule(rules.whole, _move, taped=False),  # rows
        "filter": Rule(rules.text, _filter, taped=False),
        "erase_filter": Rule(rules.nothing, _erase_filter, taped=False),
    }
    meanings: ClassVar[Mapping[str, Resolver]] = {"pick": _pick, "tick": _tick}
    is_listed, gives_way, leads = True, True, True

    def typing(self, state: State) -> bool:
        """Return whether the list is filtered."""
        del state
        return bool(self.typed)

    @property
    def title(self) -> str:
        """The title of a list of others."""
        return self.others.title if self.others else ""

    def matches(self, scene: Scene) -> tuple[str, ...]:
        """Return the tokens of quantities, or the words of others, that have all the typed words."""
        if self.others is None:
            return listed(scene, self.typed)
        return tuple(one.words for one in self.others.matches)

    def asked(self, scene: Scene, row: int) -> Action | None:
        """Return the action of a row; None where there is no such row."""
        if self.others is not None:
            return next((one.action for one in self.others.matches[row : row + 1]), None)
        charts = "strip" if self.adds else "plot"
        return next((Action(charts, token) for token in self.matches(scene)[row : row + 1]), None)

    def panel(self, state: State) -> Quantities:
        """Return the list, which stands in the place of any other."""
        scene = state.displayed
        if others := self.others:
            return Quantities(others.rows, self.chosen, self.typed, _OTHERS_HINT, title=others.title)
        quantities = [quantity(scene, token) for token in self.matches(scene)]
        # Values change four times a second: faster ones cannot be read, and each change costs a drawing.
        pose = scene.pose(state.phase_at(state.frame // _READ * _READ), speed=state.clock.speed)
        near = range(self.chosen - _NEAR, self.chosen + _NEAR)
        rows = tuple(
            (one.words, value_words(scene, one, pose) if n in near or n < _NEAR else one.symbol)
            for n, one in enumerate(quantities)
        )
        charted = chart_tokens(scene, state.look.chart)
        boxes = tuple(one.token in charted for one in quantities)
        title, hint = ("Another chart below", _OTHERS_HINT) if self.adds else ("Quantities", _HINT)
        return Quantities(rows, self.chosen, self.typed, hint, title=title, boxes=boxes)

    def mouse(self, gesture: Gesture, mouse: Hand, screen: Sight) -> tuple[Action, ...] | None:
        """Return the actions on the list of a click, the wheel or its scroll bar; None off it."""
        if (further := self._scrolled(gesture, mouse, screen)) is not None:
            return further
        row = screen.row_at(*mouse.at) if mouse.drag is None else None
        if row is None:
            return None
        if gesture.kind == "wheel":
            return (Action("move", -gesture.notches),)
        if gesture.kind != "down" or row < 0:
            return ()
        return (Action("tick" if screen.on_box(mouse.at[0]) else "pick", row),)

    def _scrolled(self, gesture: Gesture, mouse: Hand, screen: Sight) -> tuple[Action, ...] | None:
        """Return the actions of a gesture on the scroll bar; None off it."""
        held = mouse.drag == "scroll"
        if held and gesture.kind == "up":
            mouse.drag = None
            return ()
        if gesture.kind not in (("move",) if held else ("down",)) or mouse.drag not in (None, "scroll"):
            return None
        row = screen.scrolled_to(*mouse.at, held=held)
        if row is None:
            return () if held else None
        mouse.drag = "scroll"
        return (Action("move", row - self.chosen),) if row != self.chosen else ()
