"""Whatever is pressed, a game goes on or is left: no fault, and a recording begins it again at any moment."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from random import Random

import pytest

from linkanim.play.arcade import Arcade
from linkanim.play.games import GAMES
from linkanim.player.action import Action, Value
from linkanim.player.actions import advance, carried
from linkanim.player.state import State, begin
from linkanim.player.tape import resumed, starting
from linkanim.ui.panels import panel_of
from linkanim.ui.pictures import beside

# What is pressed in games, what begins one, and what belongs to the window beneath.
PRESSED: dict[str, Callable[[Random], Value]] = {
    "option": lambda random: random.randrange(-1, 9),
    "next": lambda _: None,
    "turn": lambda random: random.choice((-10, -1, 1, 10)),
    "raise": lambda random: random.choice((-1, 1)),
    "back": lambda _: None,
    "play": lambda random: random.choice(
        (*GAMES, "predict level=3 seed=5", "predict level=2 chapter=sliders")
    ),
    "scrub": lambda random: random.uniform(-9.0, 9.0),
    "put": lambda random: random.randrange(50),
    **{
        name: lambda _: None
        for name in ("help", "pause", "edit", "shelf", "undo", "closure", "build", "pencil")
    },
}
OFTEN = {"option": 6, "next": 6, "play": 3}


def stood(state: State) -> State:
    """Return the state that a tape begun now starts from."""
    start = starting(state)
    for action in resumed(state):
        start = carried(start, action)
    return start


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
def test_no_key_brings_a_game_to_a_fault(seed: int, tmp_path: Path) -> None:
    random, arcade = Random(seed), Arcade(tmp_path / "scores.json", Random(seed))
    state, seen = replace(begin("press"), games=arcade.game_of, from_title=True), Counter[str]()
    for _ in range(250):
        (name,) = random.choices([*PRESSED], [OFTEN.get(name, 1) for name in PRESSED])
        state = advance(state, [Action(name, PRESSED[name](random))])
        assert all(effect.name != "report" for effect in state.effects), (name, state.effects)
        for effect in state.effects:
            if effect.name == "begin":
                state = carried(state, Action("play", arcade.completed(str(effect.value))))
            elif effect.name == "score":
                arcade.keep(str(effect.value))
        assert state.game is None or panel_of(state)
        beside(state)
        seen[type(state.game).__name__] += 1
        if seen.total() % 25 == 0:
            assert type(stood(state).game) is type(state.game)
        for _ in range(random.choice((0, 3, 40))):
            state = advance(state)
    assert arcade.news() == []
    assert len(seen) > 4
