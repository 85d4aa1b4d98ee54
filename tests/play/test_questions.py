"""Questions are held against a motion worked out anew; what a round is, and how it is printed."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from contextlib import suppress
from itertools import count as numbered
from itertools import islice
from math import pi, tau
from pathlib import Path
from random import Random
from typing import Any

import orjson
import pytest
from browser import PROGRAM, pages_of, printed
from exact_motion import ExactMotion
from made_scenes import FEW as FEW_MADE
from made_scenes import MADE
from quiz_checker import MISCONCEPTIONS, faults
from random_scenes import named

from linkanim.cli import main
from linkanim.errors import LinkanimError
from linkanim.mechanics.quantities import phrase
from linkanim.picture.frame_words import lines_of
from linkanim.play.games import LEVELS
from linkanim.play.kinds import KINDS
from linkanim.play.question import Puzzle, QuestionId, angle, between
from linkanim.play.quiz import legend, next_question, pose_words, question_figure, question_of, questions
from linkanim.scenes import chapters, load, names
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

MAKING = ("pole", "slow way", "precision point")
FEW, MANY = 14, 100
"""Questions about a scene, and about one of a long run."""
SEED, SOME, EACH = 35, 3, 4
"""Random scenes of the default run, and questions about each."""
PARTS, MORE, MANY_EACH = 10, 290, 15
"""Of the long run: with those about the catalogue there are 10,000 questions."""


def about(scene: Scene, count: int, seed: int = 0) -> list[str]:
    """Return what is wrong with so many questions about a scene."""
    motion = ExactMotion(scene)
    return [fault for question in questions((scene,), count, seed) for fault in faults(question, motion)]


def readable(count: int) -> Iterator[Scene]:
    """Yield so many random scenes, the first that can be read and of which fifty digits are at hand.

    Links that are solved together have none here: `tests/mechanics` holds them.
    """
    for number in numbered():
        with suppress(LinkanimError):
            scene = scene_from(named(SEED, number), name=f"random {number}", where="random.toml")
            if any(joint.grouped for joint in scene.linkage.joints):
                continue
            yield scene
            count -= 1
        if not count:
            return


def about_random(part: int, parts: int, scenes: int, count: int) -> list[str]:
    """Return what is wrong with so many questions about each random scene of a part of so many."""
    mine = islice(readable(scenes), part, None, parts)
    return [fault for scene in mine for fault in about(scene, count)]


@pytest.mark.thinned(3)
@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
@pytest.mark.slow
def test_a_question_holds_against_fifty_digits(name: str) -> None:
    assert about(load(name), FEW) == []


@pytest.mark.parametrize("name", FEW_MADE)
def test_questions_on_how_a_linkage_was_made_hold(name: str) -> None:
    scene = MADE[name]()
    asked = [next_question(scene, str(seed), [], MAKING) for seed in range(6)]
    # no way of the output is the slow one at a time ratio of 1: there is nothing to ask
    assert {one.kind for one in asked}.isdisjoint(MAKING) == name.endswith("-even")
    motion = ExactMotion(scene)
    assert [fault for one in asked for fault in faults(one, motion)] == []


@pytest.mark.thinned(2)
@pytest.mark.parametrize("part", range(2))
@pytest.mark.slow
def test_questions_about_random_scenes_hold_against_fifty_digits(part: int) -> None:
    assert about_random(part, 2, SOME, EACH) == []


SLOT = {"crank": "O2", "length": 30}, {"slot": {"pivot": "A", "through": "O4", "offset": 50}, "length": 100}
# What ends a swing, so that the question why has to say it.
ENDS: dict[str, tuple[dict[str, Any], str]] = {
    "bars in line": (
        {"four-bar": {"ground": 100, "crank": 80, "coupler": 50, "rocker": 40}},
        "the bars A–B and O4–B lie in one line",
    ),
    "a rod across": (
        {"slider-crank": {"crank": 60, "rod": 40}},
        "the bar A–B stands straight across the line of travel of B",
    ),
    "a slot": (
        {"ground": {"O2": [0, 0], "O4": [60, 0]}, "joints": {"A": SLOT[0], "P": SLOT[1]}},
        "O4 is as near to A as the offset of the slot lets it come",
    ),
    "a stroke": (
        dict(load("excavator").document),
        "Its stroke is all: the cylinder G–H is 150 cm long at one end and 215 cm at the other.",
    ),
}


@pytest.mark.parametrize(("document", "said"), ENDS.values(), ids=ENDS)
def test_what_ends_a_swing_is_told_as_it_is(document: dict[str, Any], said: str) -> None:
    scene = scene_from(document, name="ends", where="ends.toml")
    why = next(one.why for one in questions((scene,), FEW, 0) if one.kind == "input range")
    assert said in why


REASONS = {
    "heading@engine@5.3246@B": "A moves the bar A–B towards B: it pushes B along the guide, up",
    "heading@press@0.8442@C": "B moves the bar B–C away from C: it pulls C along the guide, up",
    "input_range@drag-link@0.8442@input": "the ground: both links that turn on it can turn fully",
    "input_range@crank-rocker@0.8442@input": "the input: it can turn fully",
    "input_range@scotch-yoke@0.8442@input": "What it drives slides as far as it is taken",
    "dead_centre@crank-rocker@0.8442@rocker": "at 36.1° and 226.4°: there O2–A and A–B lie in one line.",
    "dead_centre@wiper@0.8442@rocker2": "at 164.8° and 345.0°.",
}


@pytest.mark.thinned(2)
@pytest.mark.parametrize(("token", "said"), REASONS.items(), ids=REASONS)
def test_a_reason_is_one(token: str, said: str) -> None:
    question = question_of(QuestionId.of(token))
    assert said in question.why
    assert faults(question, ExactMotion(question.scene)) == []


def test_a_transmission_angle_below_a_degree_is_no_change_point() -> None:
    document = {"slider-crank": {"crank": 50, "rod": 50.005}}
    scene = scene_from(document, name="near", where="near.toml")
    question = KINDS["input range"].make(Puzzle("input range", scene, 1.0, Random(0)))
    assert question is not None
    assert question.why.endswith("here none is ever less than 0.8°.")


@pytest.mark.thinned(2)
@pytest.mark.parametrize("phase", [0.0, 3.1416, pi, tau])
def test_a_question_at_a_limit_holds(phase: float) -> None:
    scene = load("chebyshev-line")
    motion, kinds = ExactMotion(scene), ("turning", "fastest", "heading", "speeding", "instant centre")
    for kind in kinds:
        question = KINDS[kind].make(Puzzle(kind, scene, phase, Random(0)))
        assert question is None or faults(question, motion) == []


def test_at_a_limit_the_input_is_about_to_turn_back() -> None:
    question = question_of(QuestionId.of("fastest@chebyshev-line@0.0@velocity"))
    assert pose_words(question).endswith("15 swings/min counterclockwise")


def test_a_joint_that_hardly_changes_its_speed_is_not_asked_about() -> None:
    scene, asked = load("drag-link"), 0
    for step in range(90):
        question = KINDS["speeding"].make(Puzzle("speeding", scene, tau * step / 90, Random(step)))
        if question is not None:
            pose, asked = scene.pose(question.phase), asked + 1
            speed, gained = (complex(*of[question.subject]) for of in (pose.velocity, pose.acceleration))
            assert abs((speed.conjugate() * gained).real) > 0.05 * abs(speed) * abs(gained)
    assert asked > 60


def test_what_is_rigid_with_its_guide_is_not_asked_about_as_if_it_slid() -> None:
    slotted = {"slot": {"pivot": "O2", "through": "A"}, "length": 10}
    bodies = {"2": {"joints": ["O2", "A"]}, "3": {"joints": ["O2", "P"]}}
    document = {"ground": {"O2": [0, 0]}, "joints": {"A": SLOT[0], "P": slotted}, "bodies": bodies}
    scene = scene_from(document, name="rigid", where="rigid.toml")
    assert "coriolis" not in {one.kind for one in questions((scene,), FEW, 0)}


@pytest.mark.slow
def test_every_misconception_is_named() -> None:
    back = ENDS["bars in line"][0] | {"drive": {"returns": "same"}}
    ending = [scene_from(one, name="ends", where="ends.toml") for one in (back, ENDS["a stroke"][0])]
    asked = [one for seed in range(3) for one in questions([load(name) for name in names()], 57, seed)]
    asked += questions(ending, 2 * FEW, 0)
    made = [MADE[name]() for name in ("guide-3", "function-5", "stroke")]
    asked += [next_question(one, str(seed), [], MAKING) for one in made for seed in range(12)]
    slips = {(question.kind, answer.slip) for question in asked for answer in question.answers}
    known = {(kind, pattern) for kind, patterns in MISCONCEPTIONS.items() for pattern in patterns}
    assert [
        one for one in known if not any(one[0] == kind and re.fullmatch(one[1], slip) for kind, slip in slips)
    ] == []


@pytest.mark.long
@pytest.mark.parametrize("name", names())
def test_a_hundred_questions_hold_against_fifty_digits(name: str) -> None:
    assert about(load(name), MANY, 1) == []


@pytest.mark.long
@pytest.mark.parametrize("part", range(PARTS))
def test_thousands_of_questions_about_random_scenes_hold_against_fifty_digits(part: int) -> None:
    assert about_random(part, PARTS, MORE, MANY_EACH) == []


@pytest.mark.slow
def test_every_kind_is_asked() -> None:
    scenes = [
        load(name) for name in ("crank-rocker", "double-rocker", "inverted-slider-crank", "slider-crank")
    ]
    made = [MADE[name]() for name in ("guide-3", "function-5", "stroke")]
    asked = questions(scenes, 60, 1)
    found = Counter(question.kind for question in asked)
    found += Counter(next_question(one, "1", [], MAKING).kind for one in made)
    assert found.keys() == KINDS.keys()
    assert all({*kind.levels} <= {*LEVELS} for kind in KINDS.values())  # no other level is played


@pytest.mark.slow
def test_right_answers_stand_in_every_place_and_no_question_comes_twice_in_a_row() -> None:
    found = questions((load("press"),), 12, 5)
    assert len({(question.kind, question.subject) for question in found}) == 12
    assert len({question.right for question in found}) > 1
    assert questions((load("press"),), 12, 5)[3].text == found[3].text
    assert [question.text for question in questions((load("press"),), 12, 6)] != [one.text for one in found]


def test_a_round_is_printed_as_a_list(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["quiz", "crank-rocker", "-n", "4", "--seed", "7", "--json"]) == 0
    found: list[dict[str, Any]] = orjson.loads(capsys.readouterr().out)
    assert len(found) == 4
    assert {"kind", "scene", "phase", "subject", "answers", "right", "why"} <= found[0].keys()
    assert all(0.0 <= one["phase"] < tau * 2 and one["scene"] == "crank-rocker" for one in found)


@pytest.mark.slow
def test_a_chapter_is_asked_scene_by_scene_on_a_sheet_with_its_key_apart(tmp_path: Path) -> None:
    sheet = tmp_path / "sheet.html"
    assert main(["quiz", "exact and scaling", "-n", "5", "-o", str(sheet)]) == 0
    text = sheet.read_text(encoding="utf-8")
    assert text.count("<section>") == text.count("<svg ") == 5
    assert "<script" not in text
    assert "http" not in text.replace("http://www.w3.org", "")
    assert text.index("class='key'") > text.rindex("</section>")
    for name in chapters()["exact and scaling"][:5]:
        assert load(name).title in text
        assert f">{load(name).title}</text>" not in text  # no words in the figure that tell the answer


@pytest.mark.slow
def test_a_sheet_has_lines_for_a_name_and_its_last_two_questions_stand_together(tmp_path: Path) -> None:
    sheet = tmp_path / "sheet.html"
    assert main(["quiz", "slider-crank", "-n", "11", "-o", str(sheet)]) == 0
    text = sheet.read_text(encoding="utf-8")
    assert text.count("<span>Name</span><span>Date</span>") == 1
    sheet_, _, _ = text.partition("class='key'")
    assert sheet_.count("<section>") == 11
    assert sheet_.partition("<div class='last'>")[2].count("<section>") == 2
    assert "dead centre" not in re.sub(r"<h2>.*?</h2>|<ol.*?</ol>", "", sheet_)


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
@pytest.mark.thinned(3)
def test_a_link_that_is_asked_about_has_its_name_in_the_figure_or_below_it(name: str) -> None:
    scene = load(name)
    for question in questions((scene,), 10, 3):
        shown = {line.text for line in lines_of(question_figure(question).picture, question.phase)}
        below = legend(question)
        for body in scene.linkage.bodies:
            word = scene.info.link_names[body.name]
            if f"{phrase(body, scene.info.link_names)} " in f"{question.text} ".replace("?", " "):
                assert {word, body.name} & shown or word in below, (question.text, shown)


def test_the_key_of_a_place_lies_on_no_joint() -> None:
    for name in ("press", "whitworth", "crank-rocker"):
        question = next_question(load(name), "1", [], ("instant centre",))
        assert question.kind == "instant centre"
        figured = question_figure(question)
        setting, pose = figured.picture.drawing.setting, load(name).pose(question.phase)
        joints = [setting.view.pixel(pose.position[joint]) for joint in setting.figure.in_view]
        (spots,) = figured.beside.drawn
        for words in (line for group in spots.groups(setting, pose) for line in group.captions):
            middle = complex(words.at[0], words.at[1] + 0.5 * words.size)
            assert min(abs(middle - joint) for joint in joints) > 0.9 * words.size


@pytest.mark.window
@pytest.mark.skipif(not PROGRAM, reason="needs Chromium")
def test_ten_questions_of_a_tall_scene_are_printed_on_two_pages_and_their_key(tmp_path: Path) -> None:
    sheet = tmp_path / "sheet.html"
    assert main(["quiz", "press", "-n", "10", "--seed", "7", "-o", str(sheet)]) == 0
    assert pages_of(printed(sheet, tmp_path)) == 3


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["no-such"], "no-such"),
        (["press", "-n", "0"], "from 1 to"),
        (["press", "-o", "sheet.pdf"], ".html"),
        (["press", "-o", "sheet.html", "--json"], "leave one"),
    ],
)
def test_what_makes_no_round_is_refused_in_a_line(
    words: list[str],
    said: str,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["quiz", *words]) == 2
    assert said in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(("scene", "way"), [("klann", "clockwise"), ("crank-rocker", "counterclockwise")])
def test_the_way_of_the_input_is_said_once(scene: str, way: str) -> None:
    question = next(iter(questions([load(scene)], 1, 7)))
    assert pose_words(question).endswith(f", 20 rpm {way}")


@pytest.mark.parametrize(("value", "said"), [(359.99999, "0.0°"), (-0.04, "0.0°"), (-90.0, "270.0°")])
def test_an_angle_of_a_turn_is_below_a_whole_one(value: float, said: str) -> None:
    assert angle(value) == said


@pytest.mark.parametrize(("one", "other", "far"), [(10, 350, 20), (350, 10, 20), (270, 90, 180), (40, 40, 0)])
def test_angles_are_told_apart_the_short_way_round(one: float, other: float, far: float) -> None:
    assert between(one, other) == far
