"""Long runs: every key and mouse action at random, over all scenes; it never fails, and never grows.

A short one over some of them as a rule; a million frames of states and twenty thousand painted ones with
`pytest -m long`.
"""

from __future__ import annotations

import ctypes
import gc
import json
import math
import random
import weakref
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from fractions import Fraction
from itertools import islice
from pathlib import Path

import pygame
import pytest
from playing import SIZE, NoSearch, Player, fake_start

from linkanim.mechanics.motion import mechanism
from linkanim.player import background
from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.state import MOVE_FRAMES, State, begin
from linkanim.scenes import names

# each time anew, as in a window: `linkanim.scenes.load` of the tests keeps what was worked out for its scenes
from linkanim.scenes.files import load
from linkanim.ui import screen

SEED = 20261121
SOME = names()[::9]
"""Scenes of a short run, of every chapter some."""
needs_proc = pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="memory is read through /proc")

KEYS = [
    *(ord(letter) for letter in "abcdehiklnoprtvw0123456789+-=.?gm"),
    *(pygame.K_SPACE, pygame.K_TAB, pygame.K_RETURN, pygame.K_BACKSPACE, pygame.K_ESCAPE, pygame.K_HOME),
    *(pygame.K_LEFT, pygame.K_RIGHT, pygame.K_UP, pygame.K_DOWN, pygame.K_F1),
]
MODS = [0, 0, 0, pygame.KMOD_LSHIFT, pygame.KMOD_LCTRL]


def answer(chance: random.Random) -> tuple[float, ...]:
    """Return the numbers of a crank-rocker that may follow a path."""
    links = (30.0, 90.0, 45.0, 30.0, 100.0, 0.0, 80.0)
    return (0.1, 1.0, 0.0, 1.0, 0.0, 0.0, *(length + chance.uniform(-2, 2) for length in links))


def random_action(chance: random.Random) -> Action:
    """Return anything that keys and mouse can ask of a state."""
    far = chance.choice([-1e9, -3.0, -0.5, 0.0, 0.25, 1.0, 40.0, 1e9])
    return chance.choice(
        [
            *map(
                Action, ("pause", "direction", "start", "closure", "trace", "ghost", "names", "theme", "help")
            ),
            *map(Action, ("fit", "edit", "erase", "accept", "undo", "redo", "back", "drop", "list", "shelf")),
            *(
                Action(name, chance.choice([-10, -1, 1, 1, 3]))
                for name in ("step", "speed", "mechanism", "chart")
            ),
            *(Action(name, chance.choice([-7, -1, 1, 5])) for name in ("choose", "nudge", "pass_on", "move")),
            Action("select", chance.randrange(9)),
            Action("scrub", far),
            Action("vectors", chance.choice("va")),
            Action("type", chance.choice(["1", "9", ".", "-", "e", " mm", "deg", "x", "é"])),
            Action("zoom", (chance.uniform(-3, 3), chance.uniform(-1, 1), chance.uniform(-1, 1))),
            Action("pan", (chance.uniform(-1, 1), chance.uniform(-1, 1))),
            Action("grab", chance.choice(["A", "B", "P"])),
            Action("carry", (far, chance.uniform(-200, 200), 1.0)),
            *map(Action, ("pencil", "own_trace", "pen_up", "let_go", "keep")),
            *(Action(name, (chance.uniform(-90, 90), far)) for name in ("pen_down", "pen_to", "lead")),
            Action("stroke", (1.0, *(chance.uniform(-90, 90) for _ in range(24)))),
            Action("answers", (0.0, *answer(chance), *answer(chance))),
            Action("cards", (0.0, *answer(chance), 1.2, 0.5, *answer(chance), 0.7, 0.9)),
            Action("way", (0.0, *answer(chance), 1.2, 0.5, *answer(chance), 0.7, 0.9)),
            Action("dial", chance.random()),
            Action("dial_on", chance.randint(-2, 2)),
            Action("follow", answer(chance)),
            Action("answer", chance.randrange(3)),
            Action("grasp_point", chance.randrange(12)),
            Action("grasp_pivot", chance.choice(["O2", "O4"])),
        ]
    )


def finite(state: State) -> None:
    """Hold a state to no fault that asks for a report, and to a place on the screen for every joint."""
    assert not [effect.value for effect in state.effects if effect.name == "report"]
    assert math.isfinite(state.phase)
    pose = state.shown.pose(state.phase, 0)
    assert all(math.isfinite(x) and math.isfinite(y) for x, y in pose.position.values())


def states(frames: int, busy: float, scenes: Sequence[str] = names(), *, seed: int = SEED) -> Iterator[State]:
    """Iterate the states of a run over scenes in which a share of the frames asks for something."""
    chance = random.Random(seed)
    each = math.ceil(frames / len(scenes))
    for name in scenes:
        state = begin(load(name))
        for _ in range(each):
            state = advance(state, [random_action(chance)] if chance.random() < busy else [])
            yield state


def going_on(frames: int, busy: float) -> State:
    """Return the state of one window after so many frames, in which the scenes change as it is asked."""
    chance, state = random.Random(SEED), begin(load("press"))
    for _ in range(frames):
        state = advance(state, [random_action(chance)] if chance.random() < busy else [])
        finite(state)
    return state


def pressed(player: Player, chance: random.Random) -> bool:
    """Press a key or use the mouse; return whether the window is still open."""
    at = (chance.randrange(SIZE[0]), chance.randrange(SIZE[1]))
    match chance.randrange(5):
        case 0:
            player.drag(at, (chance.randrange(SIZE[0]), chance.randrange(SIZE[1])))
        case 1:
            wheel = pygame.event.Event(
                pygame.MOUSEWHEEL, x=0, y=chance.choice([-2, 1]), precise_y=1.0, flipped=False
            )
            pygame.event.post(wheel)
        case _:
            key = chance.choice(KEYS)
            return player.press(key, chance.choice(MODS), chr(key) if key < 127 else "")
    return player.tick(chance.choice([1, 1, 5, 120]))


def painted(
    frames: int, folder: Path, busy: float = 1.0, scenes: Sequence[str] = names(), *, seed: int = SEED
) -> None:
    """Play a window for so many frames that are painted, over scenes; hold it to no fault and no NaN.

    In a share of the frames a key is pressed or the mouse used.
    """
    chance, each = random.Random(seed), math.ceil(frames / len(scenes))
    for number, name in enumerate(scenes):
        player = Player(begin(load(name)))
        for _ in range(each):
            if not (pressed(player, chance) if chance.random() < busy else player.tick()):
                player.window.close()
                player = Player(begin(load(name)))
            finite(player.state)
        player.window.close()
        faults = list(folder.glob("recordings/*fault*.json"))
        assert not faults, (number, name, [json.loads(path.read_text())["error"] for path in faults])


def resident_mb() -> float:
    """Return the memory in use, once what is kept on purpose (the last linkages) or free is given back."""
    mechanism.cache_clear()
    gc.collect()
    with suppress(AttributeError):  # a C library without it gives back by itself
        ctypes.CDLL(None).malloc_trim(0)
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * 4096 / 1e6


@pytest.mark.withstands("frames run", 300)
@needs_proc
@pytest.mark.slow
def test_states_stay_finite_whatever_is_asked(record_property: Callable[[str, object], None]) -> None:
    run = states(300, 0.3, SOME)
    for state in islice(run, 150):
        finite(state)
    before = resident_mb()
    for state in run:
        finite(state)
    record_property("memory growth, MB", resident_mb() - before)


@pytest.mark.slow
def test_what_was_worked_out_for_an_edited_scene_goes_when_another_is_put_on() -> None:
    state = begin(load("crank-rocker"))
    for action in (Action("edit"), Action("nudge", 3), Action("nudge", 3), Action("undo")):
        state = advance(state, [action])
    editing = state.editing
    solved = [weakref.ref(scene.mechanism) for scene in (state.scene, *editing.past, *editing.future)]
    assert len(solved) == 3
    lengths = state.scene.linkage
    state = advance(state, [Action("mechanism", 1)])
    for _ in range(MOVE_FRAMES):
        state = advance(state)
    del editing
    mechanism.cache_clear()
    gc.collect()
    assert [one() for one in solved] == [None] * 3
    state = advance(state, [Action("mechanism", -1)])
    assert state.scene.linkage == lengths
    assert advance(state, [Action("redo")]).scene.linkage != lengths


@pytest.mark.withstands("frames run", 35)
@pytest.mark.slow
def test_a_window_withstands_keys_and_mouse(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(background, "_start", fake_start([]))
    monkeypatch.setattr(background, "Following", NoSearch)
    with screen.opened(SIZE):
        painted(35, here, scenes=SOME)


@needs_proc
@pytest.mark.slow
def test_windows_opened_one_after_the_other_take_no_more_memory(here: Path) -> None:
    def one_more() -> float:
        with screen.opened(SIZE):
            player = Player(begin(load("press")))
            player.type("n")
            player.window.close()
        return resident_mb()

    used = [one_more() for _ in range(4)]
    assert used[-1] - used[1] < 4


@pytest.mark.long
@pytest.mark.withstands("frames run", 1_000_000)
@needs_proc
def test_a_million_frames_take_no_more_memory(record_property: Callable[[str, object], None]) -> None:
    # what is kept of scenes and pictures fills slowly, most of it in a first run of that length
    for state in states(1_000_000, 0.01):
        finite(state)
    before = resident_mb()
    for state in states(1_000_000, 0.01, seed=SEED + 1):
        finite(state)
    grown = resident_mb() - before
    record_property("memory growth, MB", grown)
    assert grown < 5


@pytest.mark.long
@pytest.mark.withstands("frames run", 1_000_000)
@needs_proc
def test_a_window_that_goes_on_takes_no_more_memory(record_property: Callable[[str, object], None]) -> None:
    used = []
    for frames in (500_000, 1_000_000):
        state = going_on(frames, 0.01)
        used.append(resident_mb())
    assert state.edited
    record_property("memory growth, MB", used[1] - used[0])
    assert used[1] - used[0] < 5


@pytest.mark.long
@pytest.mark.withstands("frames run", 20_000)
@needs_proc
def test_twenty_thousand_painted_frames_take_no_more_memory(
    here: Path, monkeypatch: pytest.MonkeyPatch, record_property: Callable[[str, object], None]
) -> None:
    monkeypatch.setattr(background, "_start", fake_start([]))
    monkeypatch.setattr(background, "Following", NoSearch)
    with screen.opened(SIZE):
        painted(20_000, here, 0.2)
        before = resident_mb()
        painted(20_000, here, 0.2, seed=SEED + 1)
        grown = resident_mb() - before
    record_property("memory growth, MB", grown)
    assert grown < 5


@pytest.mark.parametrize("name", ["crank-rocker", "press", "double-rocker"])
def test_the_phase_is_right_after_a_day_of_frames(name: str) -> None:
    clock = begin(load(name)).clock
    day = 24 * 3600
    exact = Fraction(clock.phase) + Fraction(clock.speed) * day
    assert abs(Fraction(clock.at(60 * day)) - exact) <= Fraction(1, 10**9)
