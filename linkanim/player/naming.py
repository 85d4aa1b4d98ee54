"""Ask for the name of the scene file to be written: one line at the foot, in which print is typed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import ClassVar

from linkanim.frozen import frozen
from linkanim.player import rules
from linkanim.player.action import Action
from linkanim.player.keys import BACK_BAR, BarEntry, KeyRow, ModeKeys, TypedKeys, enter, on
from linkanim.player.state import Mode, Rule, State, with_effect
from linkanim.words import said

_LONGEST = 100


def write(state: State, text: str) -> State:
    """Add to the typed name, which replaces the proposed one."""
    return _named(state, lambda naming: (naming.typed + text)[:_LONGEST])


def erase(state: State, _: None) -> State:
    """Erase the last letter of the name, even of a proposed one."""
    return _named(state, lambda naming: naming.name[:-1])


def _named(state: State, work: Callable[[Naming], str]) -> State:
    naming = state.of(Naming)
    return state.with_mode(replace(naming, typed=work(naming), refusal="")) if naming else state


def save(state: State, _: None) -> State:
    """Write the scene under the name, and close the question."""
    naming = state.of(Naming)
    return with_effect(naming.closed(state), "save_new", naming.name) if naming else state


@frozen
class Naming(Mode):
    """The name of the scene file to be written: as proposed, or as typed, and why that was refused."""

    proposal: str
    typed: str = ""
    refusal: str = ""

    keys = ModeKeys(
        "name",
        {
            "saving": (
                KeyRow("type", "the name of the scene file"),
                KeyRow(
                    "Enter",
                    "write it; Esc does not",
                    enter("accept_name", "erase_name") + on("escape", "back"),
                ),
            )
        },
        TypedKeys("write_name"),
        alone=True,
    )
    bar = (BACK_BAR, BarEntry("done", Action("accept_name"), 1))
    actions: ClassVar[Mapping[str, Rule]] = {
        "write_name": Rule(rules.text, write, taped=False),
        "erase_name": Rule(rules.nothing, erase, taped=False),
        "accept_name": Rule(rules.nothing, save, taped=False),
    }

    @property
    def name(self) -> str:
        """The name that Enter takes."""
        return self.typed or self.proposal

    def says(self, state: State) -> str:
        """Return the line in which the name is asked for."""
        del state
        asked = said("Save as {name}_.toml · Enter writes it · Esc does not", name=self.name)
        refused = said("{cause}: {effect}", cause=self.refusal, effect=asked)
        return refused if self.refusal else asked
