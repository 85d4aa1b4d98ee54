"""A mode that is seen through: the help, over what is on; keys mean what they mean below it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from linkanim.frozen import frozen
from linkanim.player.state import Mode, Rule, State


@frozen
class Help(Mode):
    """The help, on the keys of what is below it."""

    actions: ClassVar[Mapping[str, Rule]] = {}
    sees_through, is_help = True, True


def toggle(state: State, _: None) -> State:
    """Open the help, or close it."""
    return state.unhelped if state.help else state.with_mode(Help())
