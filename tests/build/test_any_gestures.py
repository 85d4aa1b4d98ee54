"""Whatever a hand does: no exception, a draft moves or says why not, undo leads back to the empty sheet."""

from __future__ import annotations

from random import Random

import pytest
from hand import drawn as drawn_so_far
from hand import gesture, gestures
from test_sessions import SESSIONS

from linkanim.build.building import Building, building_of, undo
from linkanim.build.gestures import TOOLS
from linkanim.build.places import drawn, line_of
from linkanim.build.scene_form import EMPTY
from linkanim.build.storing import restored, stored
from linkanim.scenes.reading import scene_from
from linkanim.scenes.toml import parse, text

_PLAIN = ("trace", "drive", "delete", "undo", "redo", "next")
_TYPED = ("0", "55", "-20", "12.5", "60 deg", "3 cm", "1/3", "x", "", "1e99", "-1")
_SHEET = 200


def any_gesture(random: Random, building: Building) -> str:
    """Return a gesture such as hands make: mostly from joints that move, to what is there or to paper."""
    draft = building.draft
    if len(draft.of("pins")) < 2 or random.random() < 0.03:
        return f"click {paper(random)}"
    if building.made.missing and random.random() < 0.25:
        return "undo"
    moving = [name for name in draft.places if name not in draft.of("pins")]
    begin, target = random.choice([*draft.of("pins"), *moving * 3]), somewhere(random, building)
    at, kind = "{} {}".format(*draft.places[begin]), random.random()
    at = somewhere(random, building) if random.random() < 0.1 else at
    if kind < 0.5:
        return f"drag bar {at} {target}"
    if kind < 0.75:
        return f"drag {random.choice(TOOLS)} {at} {target}"
    if kind < 0.85:
        return f"{random.choice(('double', 'click slider', 'move', 'click'))} {target}"
    if kind < 0.95:
        return f"type {random.choice(_TYPED)}".strip() if random.random() < 0.8 else "number 1"
    return random.choice(_PLAIN)


def paper(random: Random) -> str:
    return f"{random.randint(-_SHEET, _SHEET)} {random.randint(-_SHEET, _SHEET)}"


def somewhere(random: Random, building: Building) -> str:
    """Return a place: on paper, at a joint, on a bar, on a guide."""
    draft, kind = building.draft, random.random()
    if kind < 0.35 and draft.places:
        return "{} {}".format(*random.choice(list(draft.places.values())))
    if kind < 0.55 and draft.of("bars"):
        ends = random.choice(list(draft.of("bars").values()))["joints"]
        (a, b), (c, d) = (draft.places[end] for end in ends)
        return f"{(a + c) / 2} {(b + d) / 2}"
    if kind < 0.75 and draft.of("guides"):
        start, way = line_of(draft, random.choice(list(draft.of("guides").values())))
        place = start + way * random.randint(-_SHEET, _SHEET)
        return f"{place.real} {place.imag}"
    return paper(random)


def after(seed: int, steps: int) -> bool:
    """Make so many gestures, look at what comes of each; return whether the last one leaves what moves."""
    random = Random(seed)
    session = gestures(random.choice(SESSIONS).lines) if seed % 2 else []
    building = drawn_so_far(session[: random.randint(0, len(session))])
    for _ in range(steps):
        line = any_gesture(random, building)
        building = gesture(building, line)
        scene, why = building.made[:2]
        assert (scene is None) == bool(why), (seed, line)
        assert len(drawn(building.draft)) >= len(building.draft.places)
    if scene:
        again = scene_from(parse(text(scene), "again"), name=scene.name, where="again")
        assert again == scene
        assert building_of(scene).made.scene == scene
    assert restored(stored(building.draft)).draft == building.draft
    while building.past:
        building = undo(building)
    assert building.draft == Building().draft
    assert building.made.missing == EMPTY
    return scene is not None


@pytest.mark.parametrize("seed", range(20))
def test_any_gestures(seed: int) -> None:
    after(seed, 25)


@pytest.mark.parametrize(
    "seed",
    [
        pytest.param(1115, id="a typed start stays as it was typed"),
        pytest.param(1340, id="a dyad stands at its limit at phase 0"),
        pytest.param(1344, id="the drawn pose is a whole period on"),
        pytest.param(2820, id="a cylinder, and a gear on a geared crank, in links that are solved together"),
    ],
)
def test_what_a_hand_drew_is_there_again(seed: int) -> None:
    assert after(seed, 25)


@pytest.mark.long
@pytest.mark.parametrize("part", range(8))
def test_any_gestures_of_two_thousand_hands(part: int) -> None:
    for seed in range(250):
        after(1000 + 250 * part + seed, 25)


@pytest.mark.long
@pytest.mark.parametrize("seed", range(10))
def test_two_hundred_gestures(seed: int) -> None:
    after(100 + seed, 200)
