"""Questions against the solver: the key is what is solved, one answer is right, none is a matter of taste."""

from __future__ import annotations

import re
from collections import Counter
from itertools import pairwise
from math import atan2, degrees, hypot, radians, tau
from pathlib import Path
from typing import Any

import numpy as np
import orjson
import pytest

from linkanim.cli import main
from linkanim.mechanics.facts.naming import four_bar_of
from linkanim.play.kinds.table import KINDS
from linkanim.play.kinds.wording import between
from linkanim.play.question import QuizQuestion
from linkanim.play.round import questions
from linkanim.play.sheet import pose_words
from linkanim.scenes import chapters, load, names

FEW, MANY = 3, 200


def check(question: QuizQuestion) -> None:
    """Hold the key against what is solved at the question's phase, read by its own words."""
    texts, slips, places, curves = zip(*question.answers, strict=True)
    assert len(set(texts)) == len(texts) >= 2
    assert 0 <= question.right < len(texts)
    assert [n for n, slip in enumerate(slips) if not slip] == [question.right]
    assert all(len({bool(one) for one in part}) == 1 for part in (places, curves))
    scene, answer = question.scene, texts[question.right]
    pose, cycle = scene.pose(question.phase), scene.cycle(720)
    match question.kind:
        case "turning":
            rate = pose.angular_velocity[question.subject]
            assert answer == ("counterclockwise" if rate > 0 else "clockwise")
            assert abs(rate) > 0.05 * abs(cycle.angular_velocity[question.subject]).max()
        case "fastest":
            speeds = {name: hypot(*pose.velocity[name]) for name in texts}
            assert answer == max(speeds, key=lambda name: speeds[name])
            order = sorted(speeds.values())
            assert all(high - low > 0.02 * order[-1] for low, high in pairwise(order))
            assert order[0] > 0.02 * order[-1]
        case "heading":
            x, y = pose.velocity[question.subject]
            way = degrees(atan2(y, x)) % 360
            towards = {"to the right": 0, "up": 90, "to the left": 180, "down": 270}[answer]
            assert abs((way - towards + 180) % 360 - 180) < 31
        case "speeding":
            (vx, vy), (ax, ay) = pose.velocity[question.subject], pose.acceleration[question.subject]
            assert answer == ("it speeds up" if vx * ax + vy * ay > 0 else "it slows down")
        case "doubled":
            joint, kind = question.subject.rsplit(".", 1)
            twice = scene.pose(question.phase, speed=2 * scene.linkage.drive.speed)
            ratio = hypot(*getattr(twice, kind)[joint]) / hypot(*getattr(pose, kind)[joint])
            assert {"twice as large": 2, "four times as large": 4}[answer] == pytest.approx(ratio)
        case "instant centre":
            stands_still(question, answer)
        case "dead centre":
            turns_back(question, answer)
        case "input range":
            assert (answer == "it turns fully") == scene.info.full_turn
            if not scene.info.full_turn:
                ends = [float(word.rstrip("°").replace("−", "-")) for word in answer.split() if "°" in word]
                assert ends == pytest.approx([degrees(end) for end in scene.info.input_range], abs=0.051)
        case "closure":
            assert answer.endswith("same closure" if scene.info.mechanism.retraced else "other closure")
            assert ("the way it came" in question.why) == scene.info.mechanism.retraced
        case "grashof":
            s, p, q, longest = (float(word) for word in sums(question.why))
            sign = (s + longest > p + q) - (s + longest < p + q)
            assert ("<" in answer, ">" in answer) == (sign < 0, sign > 0)
        case "grashof sum":
            misplaced(question, answer)
        case "curves":
            is_the_steepness(question)
        case "force":
            assert answer == FACTORS[grows(question)]
        case "coriolis":
            assert (answer == "yes") == (coriolis(question) > 0)


FACTORS = {1: "as large as before", 2: "twice as large", 4: "four times as large"}


def grows(question: QuizQuestion) -> int:
    """Return by how much a force grows when the speed doubles, from two solutions."""
    scene, subject = question.scene, question.subject
    speed = scene.linkage.drive.speed
    once, twice = (scene.pose(question.phase, speed=factor * speed) for factor in (1, 2))
    if subject.endswith(".acceleration"):
        joint = subject.partition(".")[0]
        values = [hypot(*pose.acceleration[joint]) for pose in (once, twice)]
    else:
        values = [({**pose.spring, **pose.damper})[subject].force for pose in (once, twice)]
    assert values[1] / values[0] == pytest.approx(round(values[1] / values[0]), rel=1e-6)
    return round(values[1] / values[0])


def misplaced(question: QuizQuestion, answer: str) -> None:
    """Check that the answer stands elsewhere in the sum than its length has it, and no other answer does."""
    bar = four_bar_of(question.scene.mechanism)
    assert bar
    written = re.findall(r"\((\w+)\)", question.text)  # s, l, p, q
    s, p, q, longest = sorted(bar.links, key=lambda part: bar.links[part])
    own = {written[0]: (s,), written[1]: (longest,), written[2]: (p, q), written[3]: (p, q)}
    wrong = [part for part, places in own.items() if part not in places]
    assert len(wrong) == 2
    assert [one.text for one in question.answers if one.text in wrong] == [answer]


def is_the_steepness(question: QuizQuestion) -> None:
    """Check that the right curve is what is solved, over time, and that no other is near it."""
    body, _, token = question.subject.partition(".")
    times = np.linspace(0.0, 1.0, 72, endpoint=False) * question.scene.period
    way = 1.0 if question.scene.linkage.drive.speed > 0 else -1.0
    values = np.asarray(getattr(question.scene.solve(phase=way * times), token)[body])
    right, *others = (np.array(one.curve) for one in sorted(question.answers, key=lambda one: one.slip != ""))
    # over one period, from whatever phase on
    apart = [float(np.abs(values / np.abs(values).max() - np.roll(right, n)).max()) for n in range(72)]
    assert min(apart) < 0.01
    assert all(float(np.abs(other - right).max()) > 0.25 for other in others)
    assert len(others) == 2


def coriolis(question: QuizQuestion) -> float:
    """Return the size of 2ω × v where the subject slides, zero along a guide that stands still."""
    scene, pose = question.scene, question.scene.pose(question.phase)
    slides = [one for joint in scene.linkage.joints for one in joint.slides]
    for slide in (one for one in slides if one.point == question.subject):
        if slide.axis is None or slide.start is None:
            continue
        way, turn = (
            complex(*pose.position[end]) - complex(*pose.position[begin])
            for begin, end in ((slide.start, slide.point), slide.axis)
        )
        moves, turns = (
            complex(*pose.velocity[end]) - complex(*pose.velocity[begin])
            for begin, end in ((slide.start, slide.point), slide.axis)
        )
        return abs(2 * (turns / turn).imag * (moves / way).real * abs(way))
    return 0.0


def sums(why: str) -> list[str]:
    """Return s, p, q, l of "s + l = 1 + 4 and p + q = 2 + 3." """
    words = why.rstrip(".").split()
    return [words[4], words[12], words[14], words[6]]


def stands_still(question: QuizQuestion, answer: str) -> None:
    """Check that the body's point there has no velocity."""
    text = answer[1 : answer.index(")")].replace("−", "-")
    x, y = map(float, text.split(","))
    scene, pose = question.scene, question.scene.pose(question.phase)
    body = next(body for body in scene.linkage.bodies if body.name == question.subject)
    (px, py), (vx, vy) = (found[body.joints[0]] for found in (pose.position, pose.velocity))
    rate = pose.angular_velocity[body.name]
    left = hypot(vx - rate * (y - py), vy + rate * (x - px))
    assert left < 0.01 * max(hypot(*pose.velocity[name]) for name in body.joints) + abs(rate) * 0.06


def turns_back(question: QuizQuestion, answer: str) -> None:
    """Check that the output's velocity changes its sign there, and at no other answer."""
    kind = "travel_velocity" if question.subject in question.scene.pose(0.0).travel else "angular_velocity"
    for text, *_ in question.answers:
        at = radians(float(text.rstrip("°")))
        rates = [
            getattr(question.scene.solve(angle=at + part), kind)[question.subject] for part in (-0.01, 0.01)
        ]
        assert (float(rates[0]) * float(rates[1]) < 0) == (text == answer)


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_the_key_is_what_is_solved(name: str) -> None:
    for seed in range(FEW):
        found = questions((load(name),), 10, seed)
        assert len(found) == 10
        for question in found:
            check(question)


@pytest.mark.long
@pytest.mark.parametrize("name", names())
def test_the_key_is_what_is_solved_for_two_hundred_seeds(name: str) -> None:
    scene = load(name)
    for seed in range(MANY):
        for question in questions((scene,), 5, seed):
            check(question)


def test_every_kind_is_asked() -> None:
    scenes = [
        load(name) for name in ("crank-rocker", "double-rocker", "inverted-slider-crank", "slider-crank")
    ]
    found = Counter(question.kind for question in questions(scenes, 60, 1))
    assert found.keys() == KINDS.keys()


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


@pytest.mark.parametrize(("one", "other", "far"), [(10, 350, 20), (350, 10, 20), (270, 90, 180), (40, 40, 0)])
def test_angles_are_told_apart_the_short_way_round(one: float, other: float, far: float) -> None:
    assert between(one, other) == far
