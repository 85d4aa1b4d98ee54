"""The sweep's own checks: each passes a sound motion and catches it broken."""

from __future__ import annotations

import json
import math
from collections.abc import Callable

import numpy as np
import pytest
import sweeping
from motion_checks import Array, kinks, not_back, not_finite, unclosed
from sweeping import outcome
from typed_linkages import BASES, EXTRAS, linkages

from linkanim.errors import SceneError
from linkanim.scenes.reading import scene_from

TURN = 2 * math.pi
Path = Callable[[Array], Array]


def circle(phases: Array) -> Array:
    return np.stack([np.cos(phases), np.sin(phases)], axis=1)


def jumping(phases: Array) -> Array:
    """A circle that moves over by 1e-6 at 2 and back at 5."""
    return circle(phases) + 1e-6 * ((phases % TURN > 2) & (phases % TURN < 5))[:, None]


def kinked(phases: Array) -> Array:
    """A circle with a tangent that turns by a hundredth at 3."""
    return circle(phases) + 0.01 * np.abs(np.sin((phases - 3) / 2))[:, None]


def stopping(phases: Array) -> Array:
    """A path that reaches its limit with a square root: it turns back at once."""
    return np.sqrt(np.abs(np.sin(phases - 1.0)))[:, None]


def sharp(phases: Array) -> Array:
    """A smooth path whose bend at 3 is 1e-4 wide: next to a change point that it does not reach."""
    return circle(phases) + np.sqrt(np.sin((phases - 3) / 2) ** 2 + 1e-8)[:, None]


@pytest.mark.parametrize("path", [circle, sharp])
def test_a_smooth_path_has_no_kink(path: Path) -> None:
    assert list(kinks(path, TURN, 360, 1.0)) == []


@pytest.mark.parametrize("path", [jumping, kinked, stopping])
def test_a_jump_and_a_kink_are_found(path: Path) -> None:
    assert list(kinks(path, TURN, 360, 1.0))


BY_ROCKER = {"ground": 5, "crank": 4, "coupler": 3, "rocker": 2, "driver": "rocker"}


@pytest.mark.parametrize(
    ("document", "moved", "words"),
    [
        ({"four-bar": {"ground": 4, "crank": 2, "coupler": 5, "rocker": 3}}, "B", "bar A-B"),
        ({"four-bar": {"ground": 4, "crank": 2, "coupler": 5, "rocker": 3}}, "A", "crank A"),
        ({"four-bar": BY_ROCKER}, "B", "crank B"),
        ({"six-bar": {"lengths": [4, 2, 5, 3, 6, 2, 5, 5], "link_angle": "30 deg"}}, "C", "point C along"),
        ({"six-bar": {"lengths": [4, 2, 5, 3, 6, 2, 5, 5], "link_angle": "30 deg"}}, "D", "bar C-D"),
        ({"slider-crank": {"crank": 2, "rod": 5, "offset": 1, "line_angle": "30 deg"}}, "B", "line of B"),
        ({"slider-crank": {"crank": 2, "rod": 5, "coupler_point": [1, 2]}}, "P", "point P aside"),
    ],
)
def test_what_is_not_closed_is_named(document: dict[str, object], moved: str, words: str) -> None:
    motion = scene_from(document, name="x", where="x").cycle(40)
    places = {name: np.array(place) for name, place in motion.position.items()}
    assert list(unclosed(document, places, motion.coordinate, 5.0)) == []
    places[moved][7] += 3e-11
    assert words in " ".join(unclosed(document, places, motion.coordinate, 5.0))


SLOT = {"slot": {"pivot": "G", "through": "A", "offset": 1}, "length": 4}
GEARED = {"crank": "G", "length": 4, "gear": {"with": "A", "ratio": "-1/3", "offset": "20 deg"}}


@pytest.mark.parametrize(("joint", "words"), [(SLOT, "slot of E"), (GEARED, "crank E")])
def test_slots_and_gears_are_held_to(joint: dict[str, object], words: str) -> None:
    crank = {"crank": "O", "length": 2}
    document = {"ground": {"O": [0, 0], "G": [5, 1]}, "joints": {"A": crank, "E": joint}}
    motion = scene_from(document, name="x", where="x").cycle(40)
    places = {name: np.array(place) for name, place in motion.position.items()}
    assert list(unclosed(document, places, motion.coordinate, 5.0)) == []
    places["E"] *= 1 + 1e-11
    places["A"] *= 1 + 1e-11
    assert words in " ".join(unclosed(document, places, motion.coordinate, 5.0))


def test_a_place_that_is_not_a_number_is_no_closed_bar_and_not_finite() -> None:
    document = {"four-bar": {"ground": 4, "crank": 2, "coupler": 5, "rocker": 3}}
    motion = scene_from(document, name="x", where="x").cycle(40)
    places = {name: np.array(place) for name, place in motion.position.items()}
    assert list(not_finite(places)) == []
    places["B"][3, 1] = math.nan
    assert list(not_finite(places)) == ["B is nowhere at 1 of 40 instants"]
    assert list(unclosed(document, places, motion.coordinate, 5.0))


def test_a_period_too_short_or_too_long_is_found() -> None:
    home, away = np.zeros((4, 2)), np.full((4, 2), 1e-6)
    assert list(not_back(home, [home], 1.0)) == []
    assert list(not_back(home, [away, home], 1.0)) == []
    assert list(not_back(home, [away], 1.0))
    assert list(not_back(home, [home, home], 1.0)) == ["it is back after 1 drive periods already, not 2"]


def test_a_refusal_is_a_sentence_that_says_where() -> None:
    apart = outcome({"four-bar": {"ground": 100, "crank": 1, "coupler": 2, "rocker": 3}})
    assert apart.refusal.startswith("sweep.toml: four-bar: ")
    assert apart.faults == ()


def test_an_exception_that_is_no_refusal_is_a_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object, **__: object) -> None:
        raise ZeroDivisionError("float division by zero")

    monkeypatch.setattr(sweeping, "scene_from", broken)
    assert outcome({}).faults == ("unexpected ZeroDivisionError: float division by zero",)


def test_a_refusal_of_several_lines_is_a_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    def wordy(*_: object, **__: object) -> None:
        raise SceneError("sweep.toml: no\nand no")

    monkeypatch.setattr(sweeping, "scene_from", wordy)
    assert outcome({}).faults


def test_the_same_seed_gives_the_same_linkages_of_every_kind() -> None:
    once, again = list(linkages(3, 400)), list(linkages(3, 400))
    assert json.dumps(once) == json.dumps(again)
    assert {kind.split(" + ")[0] for kind, _ in once} == set(BASES)
    assert {part for kind, _ in once for part in kind.split(" + ")[1:]} == set(EXTRAS)
