"""What is said of a chosen thing besides its lengths: mass, look, colour and name, each to be typed."""

from __future__ import annotations

from typing import Any

import pytest
from hand import drawn, gesture

from linkanim.build.building import Building, undo
from linkanim.build.dimensions import accept, choose_number, next_option, rows_of, write
from linkanim.build.storing import restored, stored
from linkanim.scenes.reading import scene_from
from linkanim.scenes.toml import parse, text

SESSION = """
click 0 0
click 100 0
drag 0 0 30 0
drag 30 0 90 80
drag 90 80 100 0
double 60 40
trace
drag spring 0 0 90 80
drag damper 100 0 30 0
"""
SLIDER = """
click 0 0
drag 0 0 30 0
drag guide 0 0 120 0
drag bar 30 0 120 0
"""


def chosen(kind: str, name: str, label: str, begin: str = SESSION) -> Building:
    """Return a drawing with a thing chosen, and the row of that name asked for."""
    building = gesture(drawn(begin), f"choose {kind} {name}")
    labels = [row.label for row in rows_of(building.draft, building.chosen)]
    return choose_number(building, labels.index(label) - building.row)


def typed(building: Building, words: str) -> Building:
    return accept(write(building, words))


def again(building: Building) -> Any:
    """Return the scene of a building, once written and read."""
    scene = building.made.scene
    assert scene
    return scene_from(parse(text(scene), "again"), name=scene.name, where="again")


@pytest.mark.parametrize(
    ("thing", "label", "words", "stated"),
    [
        (("bars", "A–B"), "mass", "0.5", {"mass": "0.5 kg"}),
        (("bars", "A–B"), "mass", "80 g", {"mass": "80 g"}),
        (("bars", "A–B"), "look", "plate", {"look": "plate"}),
        (("bars", "A–B"), "colour", "#123456", {"colour": "#123456"}),
        (("bars", "A–B"), "colour", "123456", {"colour": "#123456"}),
        (("bars", "A–B"), "colour", "Blue", {"colour": "#0072b2"}),
    ],
)
def test_what_is_typed_of_a_bar_is_its_body_s(
    thing: tuple[str, str], label: str, words: str, stated: dict[str, str]
) -> None:
    before = chosen(*thing, label)
    after = typed(before, words)
    body = after.draft.of("bodies")[str(after.draft.body_of(["A", "B"]))]
    assert stated.items() <= body.items(), after.sentence
    assert again(after) == after.made.scene
    assert undo(after).draft.tables == before.draft.tables


def test_a_mass_is_in_the_middle_until_it_is_said_where() -> None:
    heavy = typed(chosen("bars", "A–B", "mass"), "2")
    labels = [row.label for row in rows_of(heavy.draft, heavy.chosen)]
    assert labels[:5] == ["length", "mass", "mass along", "mass to the left", "inertia"]
    (body,) = (one for one in heavy.draft.of("bodies").values() if "mass" in one)
    ends = (complex(*heavy.draft.places[joint]) for joint in body["joints"][:2])
    assert body["com"] == [pytest.approx(abs(next(ends) - next(ends)) / 2, abs=1e-9), 0]
    off = typed(choose_number(heavy, 2 - heavy.row), "20")
    (body,) = (one for one in off.draft.of("bodies").values() if "mass" in one)
    assert body["com"] == [20, 0]
    gone = typed(choose_number(off, 1 - off.row), "-")
    assert not any({"mass", "com"} & {*one} for one in gone.draft.of("bodies").values())


@pytest.mark.parametrize(
    ("thing", "label", "words"),
    [
        (("springs", "spring"), "stiffness", "200"),
        (("springs", "spring"), "free length", "60"),
        (("dampers", "damper"), "coefficient", "12"),
        (("bars", "O2–A"), "speed", "30"),
    ],
)
def test_all_numbers_are_rows(thing: tuple[str, str], label: str, words: str) -> None:
    after = typed(chosen(*thing, label), words)
    (row,) = (row for row in rows_of(after.draft, thing) if row.label == label)
    assert row.number
    assert row.number.value == float(words)


@pytest.mark.parametrize(("label", "words"), [("look", "piston"), ("colour", "orange"), ("mass", "3")])
def test_a_slider_has_a_block_of_its_own(label: str, words: str) -> None:
    after = typed(chosen("joints", "B", label, SLIDER), words)
    (body,) = (one for one in after.draft.of("bodies").values() if "slider" in one)
    assert label in body
    assert again(after) == after.made.scene


def test_looks_go_round_by_clicks_and_end_with_none() -> None:
    building, looks = chosen("bars", "A–B", "look"), list[Any]()
    for _ in range(11):
        building = next_option(building)
        looks.append(building.draft.of("bodies")[str(building.draft.body_of(["A", "B"]))].get("look"))
    assert looks[:3] == ["bar", "plate", "wheel"]
    assert looks[8:] == ["none", None, "bar"]


@pytest.mark.parametrize("name", ["C", "Pin 4", "Ω"])
@pytest.mark.parametrize("joint", ["O2", "A", "B", "P", "O4"])
def test_a_joint_is_called_otherwise_wherever_it_is_named(joint: str, name: str) -> None:
    before = chosen("joints", joint, "name")
    after = typed(before, name)
    assert after.chosen == ("joints", name)
    assert after.made.missing == ""
    scene, was = again(after), before.made.scene
    assert was
    assert [one.name for one in scene.linkage.joints] == [
        name if one.name == joint else one.name for one in was.linkage.joints
    ]
    assert scene.pose(1.0, 0).position[name] == pytest.approx(was.pose(1.0, 0).position[joint])
    assert not any(joint == end for bar in after.draft.of("bars").values() for end in bar["joints"])
    assert restored(stored(after.draft)).draft == after.draft
    assert undo(after).draft == before.draft
    back = typed(chosen_again(after, name), joint)
    assert back.draft.tables == before.draft.tables


def chosen_again(building: Building, name: str) -> Building:
    labels = [row.label for row in rows_of(building.draft, ("joints", name))]
    return choose_number(gesture(building, f"choose joints {name}"), labels.index("name"))


def test_links_springs_and_dampers_have_names() -> None:
    for thing, label in (
        (("springs", "spring"), "name"),
        (("dampers", "damper"), "name"),
        (("bars", "A–B"), "link's name"),
    ):
        after = typed(chosen(*thing, label), "rod")
        kind = "bodies" if thing[0] == "bars" else thing[0]
        assert "rod" in after.draft.of(kind)
        assert again(after) == after.made.scene


@pytest.mark.parametrize(
    ("label", "words", "sentence"),
    [
        ("look", "round", '"bar" or "plate" or "wheel"'),
        ("colour", "pinkish", "is no colour"),
        ("mass", "-3", "above zero"),
        ("link's name", "2", "needs one of its own"),
    ],
)
def test_what_cannot_be_is_refused_with_what_can(label: str, words: str, sentence: str) -> None:
    before = chosen("bars", "A–B", label)
    after = typed(before, words)
    assert after.draft is before.draft
    assert after.is_refusal
    assert sentence in after.sentence


def test_letters_go_nowhere_until_a_row_of_words_is_asked_for() -> None:
    building = gesture(drawn(SESSION), "choose joints B")
    after = write(building, "5")
    assert (after.typed, after.is_refusal) == ("", True)
    assert "among the rows" in after.sentence
