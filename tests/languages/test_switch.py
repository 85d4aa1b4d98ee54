"""Another language in the window: what is shown is as if it had been opened so, and nothing stays behind."""

from __future__ import annotations

from dataclasses import replace

import pygame
import pytest

from linkanim.player.action import Action
from linkanim.player.actions import carried
from linkanim.player.commands import menu_of
from linkanim.player.state import State, begin
from linkanim.ui import screen
from linkanim.ui.window import Window
from linkanim.words import LANGUAGES, speaking, spoken

SHOWN: dict[str, tuple[Action, ...]] = {
    "a mechanism with names, arrows and a chart": (
        *(Action("names"), Action("vectors", "v")),
        *(Action("chart", 1), Action("pause")),
    ),
    "its polygons and instant centres": (Action("polygons"), Action("centres"), Action("pause")),
    "the list of dimensions": (Action("edit"), Action("pause")),
    "the help": (Action("pause"), Action("help")),
    "a construction": (Action("pause"), Action("construction", "centres")),
    "an empty sheet": (Action("sheet"),),
}


def pixels(state: State, first: str, then: str | None) -> bytes:
    """Return what a window shows that was opened in one language, and then put into another."""
    with speaking(first), screen.opened((960, 540)):
        window = Window(state)
        for n in range(60):
            if n == 20 and then:
                window.state = carried(window.state, Action("language", then))
            window.tick()
        return pygame.image.tobytes(pygame.display.get_surface(), "RGB")  # type: ignore[arg-type]


@pytest.mark.slow
@pytest.mark.parametrize("case", SHOWN)
def test_a_window_in_another_language_is_as_if_opened_so(case: str) -> None:
    def state() -> State:
        found = begin("crank-rocker")
        for action in SHOWN[case]:
            found = carried(found, action)
        return replace(found, chip=None, toast=None, arrived=None)

    with speaking("zh_TW"):
        in_chinese = pixels(state(), "zh_TW", None)
    assert pixels(state(), "en", "zh_TW") == in_chinese
    assert pixels(state(), "en", None) != in_chinese


def test_the_commands_offer_the_other_languages_by_their_own_names() -> None:
    for language in LANGUAGES:
        with speaking(language):
            menu = menu_of(begin("press"), None)
            assert menu
            offered = {row.action.value: row.words for row in menu.entries if row.action.name == "language"}
        assert offered == {one: name for one, name in LANGUAGES.items() if one != language}


def test_what_was_said_in_the_language_before_goes() -> None:
    state = carried(carried(begin("press"), Action("note", "a sentence")), Action("names"))
    assert state.toast
    assert state.chip
    state = carried(state, Action("language", "zh_CN"))
    assert (state.toast, state.chip, state.language) == (None, None, "zh_CN")
    assert spoken() == "en"
