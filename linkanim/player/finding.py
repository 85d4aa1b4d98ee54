"""A mode: one field that finds commands, quantities, mechanisms, dimensions and facts by any of their words.

What is found is done from there; beside each stands the key that does the same, its value or its kind.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import ClassVar

from linkanim.frozen import frozen
from linkanim.picture.lists import Quantities
from linkanim.picture.quantities import quantity, turned_words
from linkanim.player import rules
from linkanim.player.action import Action
from linkanim.player.browsing import searched
from linkanim.player.commands import Entries, ListRow, menu_of, thing_said, things
from linkanim.player.keys import KeyRow, ModeKeys, TypedKeys, both, enter, on
from linkanim.player.listing import Listing
from linkanim.player.state import Rule, State
from linkanim.scenes.editing import dimensions, in_unit
from linkanim.scenes.scene import Scene
from linkanim.units import significant, typeset
from linkanim.words import name_said, said, to_say

_HINT = to_say("type any words of it   ↑ ↓ choose   Enter does it   Esc closes")
_SCENE_SHOWN = ("play", "paused", "edit")
"""The modes in which a mechanism is shown with all that belongs to it."""
_TYPED = str.maketrans(
    {
        **{f"{char}": f"{n}" for n, char in enumerate("₀₁₂₃₄₅₆₇₈₉")},
        **{"_": "", "{": "", "}": "", "θ": "theta", "ω": "omega", "α": "alpha", "μ": "mu"},
    }
)
"""How the letters of symbols are typed."""
_ALIKE: Mapping[str, str] = {
    "slider": "ram piston",
    "velocity": "speed rate",
    "torque": "moment",
    "dead centre": "limit toggle",
}
"""Other words under which what has the first ones is looked for."""


def _toggle(state: State, _: None) -> State:
    """Open the field, or close it."""
    if state.of(Finder):
        return state.without(Finder)
    bare = state.unlisted.unhelped
    return (
        bare
        if bare.keys.alone
        else bare.with_mode(Finder(0, others=Entries(to_say("Find"), tuple(_all(bare)))))
    )


def _all(state: State) -> Iterator[ListRow]:
    """Yield all that can be found: what can be done, what belongs to the scene, then other scenes."""
    usual = menu_of(state, None)
    yield from (row for row in usual.entries if row.action.name != "find") if usual else ()
    if state.game:
        return
    if state.mode in _SCENE_SHOWN:
        yield from _facts(state.displayed)
        yield from _dimensions(state)
        yield from _quantities(state.displayed)
    for place, entry in enumerate(state.shelf):
        name, title, chapter = searched(entry)
        yield ListRow(
            title, said("mechanism"), Action("put", place), (name, title, chapter, "mechanism scene")
        )
    if state.mode in _SCENE_SHOWN:
        yield from (
            _row(thing_said(one), said("its commands"), Action("menu", one), one)
            for one in things(state.scene)
        )


def _row(words: str, key: str, action: Action, *more: str) -> ListRow:
    """Return a row that is found by its words, what stands beside it, `more`, and words like these."""
    texts = (words, key, key.translate(_TYPED), *more)
    plain = " ".join(texts).casefold()
    return ListRow(words, key, action, (*texts, *(also for one, also in _ALIKE.items() if one in plain)))


def _facts(scene: Scene) -> Iterator[ListRow]:
    """Yield what is known of a scene, as its class; where it holds at a pose, the row leads there."""
    info = scene.info
    transmission = info.transmission
    for label, words in info.lines:
        name = said(label)
        to = Action("note", said("{label}: {words}", label=name, words=words))
        if label == "transmission angle" and transmission:
            to = Action("scrub", transmission.phase)
        yield _row(name, words, to, "fact least" if label == "transmission angle" else "fact")
    ends = info.swing.dead_centres if info.swing else info.dead_centres
    for n, phase in enumerate(ends or (), start=1):
        where = turned_words(scene, scene.pose(phase, 0).coordinate)
        yield _row(
            said("dead centre {number} of {link}", number=n, link=name_said(info.output_name)),
            where,
            Action("scrub", phase),
            "fact",
        )


def _dimensions(state: State) -> Iterator[ListRow]:
    """Yield the scene's dimensions, with their values, to be edited."""
    for n, one in enumerate(dimensions(in_unit(state.scene, state.look.unit))):
        value = typeset(f"{significant(one.value, 6)} {one.unit}".strip())
        yield _row(
            said("edit {dimension}", dimension=one.label), value, Action("edit_row", n), "dimension length"
        )


def _quantities(scene: Scene) -> Iterator[ListRow]:
    """Yield the quantities that have a value in the scene, to be charted."""
    for token in scene.valued:
        one = quantity(scene, token)
        yield _row(
            said("chart {quantity}", quantity=one.words), one.symbol, Action("plot", token), token, "quantity"
        )


@frozen
class Finder(Listing):
    """The open field: a list of all that can be found, the chosen row, and what was typed."""

    keys = ModeKeys(
        "find",
        {
            "in Ctrl+K": (
                KeyRow("type", "any words of a command, quantity, mechanism, dimension or fact"),
                KeyRow("↑ ↓", "choose", both("up", "down", "move") + both("pageup", "pagedown", "move", 10)),
                KeyRow("Enter, click", "do it: chart, show, edit, go there", enter("pick", "erase_filter")),
                KeyRow("Ctrl+K, Esc", "close", on("ctrl+k", "find")),
            )
        },
        TypedKeys("filter"),
    )
    actions: ClassVar[Mapping[str, Rule]] = {
        **Listing.actions,
        "find": Rule(rules.nothing, _toggle, taped=False),
    }

    def panel(self, state: State) -> Quantities:
        """Return the list, with its own hint."""
        return replace(super().panel(state), hint=_HINT)
