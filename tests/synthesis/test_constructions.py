"""The construction that is drawn: it holds what it says, in every step, and its names stand free."""

from __future__ import annotations

import math
from itertools import combinations, pairwise
from pathlib import Path

import numpy as np
import pytest
from made_scenes import FEW, MADE

import linkanim
from linkanim.cli import main
from linkanim.errors import BadInput
from linkanim.paper.construction import ConstructionPage
from linkanim.paper.write import data
from linkanim.picture.items import Caption
from linkanim.picture.view import Rect
from linkanim.scenes.editing import in_unit
from linkanim.scenes.scene import FunctionPurpose, PosesPurpose, TimeRatioPurpose
from linkanim.scenes.toml import text
from linkanim.synthesis.constructions import Mark, construction, dead_centres, guided_body


def labelled(marks: list[Mark], label: str) -> complex:
    (found,) = (complex(mark.points[0]) for mark in marks if mark.label == label)
    return found


def marks_of(name: str) -> list[Mark]:
    return [mark for step in construction(MADE[name]()) for mark in step.marks]


@pytest.mark.parametrize("name", ["guide-2", "guide-3"])
def test_midperpendiculars_meet_in_the_pivots(name: str) -> None:
    marks = marks_of(name)
    for joint, pivot in (("A", "O₂"), ("B", "O₄")):
        centre = labelled(marks, pivot)
        places = [labelled(marks, f"{joint}{index}") for index in "₁₂₃"[: int(name[-1])]]
        assert np.ptp(np.abs(np.array(places) - centre)) < 1e-9
        for one, other in pairwise(places):
            middle = (one + other) / 2
            (line,) = (
                mark.points
                for mark in marks
                if mark.shape == "dashed" and abs(mark.points[0] - middle) < 1e-9
            )
            assert abs(((line[1] - line[0]) * np.conj(other - one)).real) < 1e-9 * abs(other - one) ** 2
            assert abs(((centre - line[0]) * np.conj(line[1] - line[0])).imag) < 1e-7 * abs(line[1] - line[0])


def test_the_pole_triangle_has_half_the_turns_in_its_corners() -> None:
    marks, purpose = marks_of("guide-3"), MADE["guide-3"]().purpose
    assert isinstance(purpose, PosesPurpose)
    poles = {index: labelled(marks, f"P{index}") for index in ("₁₂", "₁₃", "₂₃")}
    for corner, one, other, pair in (("₁₂", "₁₃", "₂₃", (0, 1)), ("₂₃", "₁₂", "₁₃", (1, 2))):
        ways = poles[one] - poles[corner], poles[other] - poles[corner]
        between = abs(np.angle(ways[0] / ways[1]))
        turned = abs(purpose.poses[pair[1]][2] - purpose.poses[pair[0]][2])
        assert math.sin(between) == pytest.approx(math.sin(turned / 2), abs=1e-9)


@pytest.mark.parametrize("name", ["guide-4", "guide-5"])
def test_the_curves_run_through_pivots_joints_and_poles(name: str) -> None:
    marks = marks_of(name)
    curves = {
        tone: [m.points for m in marks if m.shape == "line" and m.tone == tone]
        for tone in ("third", "fourth")
    }
    size = guided_body(MADE[name](), MADE[name]().purpose).poses.size  # type: ignore[arg-type]
    on_centres = [labelled(marks, label) for label in ("O₂", "O₄", "P₁₂", "P₁₃")]
    on_circles = [labelled(marks, label) for label in ("A₁", "B₁")]
    for places, walks in ((on_centres, curves["third"]), (on_circles, curves["fourth"])):
        walk = np.concatenate(walks)
        assert all(np.nanmin(np.abs(walk - place)) < 0.05 * size for place in places)


def test_two_curves_of_five_poses_meet_in_burmester_s_points_and_three_poles() -> None:
    marks = marks_of("guide-5")
    first, last = (
        np.concatenate([mark.points for mark in marks if mark.shape == "line" and mark.tone == tone])
        for tone in ("third", "dim")
    )
    points = [complex(place) for mark in marks if mark.shape == "dot" for place in mark.points]
    poles = [labelled(marks, label) for label in ("P₁₂", "P₁₃", "P₂₃")]
    scene = MADE["guide-5"]()
    assert isinstance(scene.purpose, PosesPurpose)
    poses = guided_body(scene, scene.purpose).poses
    size = poses.size
    # curves are drawn by points, which lie close where the picture is
    near = [place for place in points if abs(place - poses.centre) < 4 * size]
    assert len(near) >= 2
    for place in (*near, *poles):
        assert all(np.nanmin(np.abs(walk - place)) < 0.05 * size for walk in (first, last))


@pytest.mark.parametrize("name", ["stroke", "swing"])
def test_alt_s_circle_sees_the_chord_at_the_angle_of_the_time_ratio(name: str) -> None:
    scene, marks = MADE[name](), marks_of(name)
    assert isinstance(scene.purpose, TimeRatioPurpose)
    ratio = scene.purpose.ratio
    found = dead_centres(scene)
    assert math.degrees(found.angle) == pytest.approx(180 * (ratio - 1) / (ratio + 1))
    circle = next(mark.points for mark in marks if mark.shape == "arc" and mark.tone == "third")
    middle = np.mean(circle[:-1])
    radius = abs(circle[0] - middle)
    for place in (found.crank_pivot, *found.ends):
        assert abs(place - middle) == pytest.approx(radius)
    for pin, end in zip(found.pins, found.ends, strict=True):
        assert abs(((pin - found.crank_pivot) * np.conj(end - found.crank_pivot)).imag) < 1e-9 * radius**2


def test_freudenstein_s_numbers_lead_to_the_lengths() -> None:
    scene = MADE["function-3"]()
    *_, equations, lengths = construction(scene)
    assert equations.words.count("K₁") == 4
    crank = scene.linkage.crank("A").length
    assert f"r₂ = r₁/K₁ = {crank:.4g}" in lengths.words


# Precision points that lie so close that their numbers find no room at them.
@pytest.mark.parametrize(("text", "last", "kind"), [("log10(x)", 10, "four-bar"), ("1/x", 2, "slider-crank")])
def test_numbers_of_close_precision_points_stand_free(text: str, last: float, kind: str) -> None:
    page = ConstructionPage(linkanim.function(text, 1, last, kind=kind, count=1)[0].scene, size=(960, 640))
    words = [item for item in page.items() if isinstance(item, Caption)]
    boxes = boxes_of(page, words)
    assert len(boxes) > 10
    assert not any(one.meets(other) for one, other in combinations(boxes, 2))
    assert not any("e+" in word.text for word in words)


def boxes_of(page: ConstructionPage, words: list[Caption]) -> list[Rect]:
    """Return where the names of marks stand."""
    names = [word for word in words if word.halo is not None]
    return [Rect(*word.at, page.pen.type.width(word.text, word.size), 0.9 * word.size) for word in names]


@pytest.mark.parametrize("name", FEW)
def test_each_construction_is_drawn_step_by_step(name: str) -> None:
    scene = MADE[name]()
    steps = construction(scene)
    before = 0
    for count in range(1, len(steps) + 1):
        items = list(ConstructionPage(scene, size=(960, 640), steps=count).items())
        assert len(items) > before
        before = len(items)
    words = [item for item in items if isinstance(item, Caption)]
    assert all(0 <= word.at[0] <= 960 and 0 <= word.at[1] <= 640 for word in words)
    page = ConstructionPage(scene, size=(960, 640))
    boxes = boxes_of(page, words)
    met = sum(one.meets(other) for one, other in combinations(boxes, 2))
    assert met <= 0.1 * len(boxes)
    assert "construction" in data(page, ".svg").decode()


def test_draw_writes_it_and_refuses_a_scene_without(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "lid.toml").write_text(text(MADE["guide-3"]()), encoding="utf-8")
    assert main(["draw", "lid.toml", "--construction", "-o", "all.svg"]) == 0
    assert main(["draw", "lid.toml", "--construction", "2", "-o", "two.svg"]) == 0
    assert len((tmp_path / "two.svg").read_text()) < len((tmp_path / "all.svg").read_text())
    capsys.readouterr()
    assert main(["draw", "press", "--construction"]) == 2
    assert "has no construction" in capsys.readouterr().err
    assert main(["draw", "crank-rocker", "--construction", "synthesis"]) == 2
    assert "crank-rocker: has no construction of a synthesis" in capsys.readouterr().err
    assert main(["draw", "crank-rocker", "--construction", "center"]) == 2
    assert '"center" is no construction; give synthesis, centres or dead-centres' in capsys.readouterr().err


@pytest.mark.parametrize("kind", ["centres", "dead-centres"])
def test_draw_writes_the_construction_of_a_catalogue_scene(
    kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for steps in ("", ":1"):
        line = ["draw", "slider-crank", "--construction", f"{kind}{steps}", "-o", f"{kind}{steps[1:]}.svg"]
        assert main(line) == 0
    whole, first = ((tmp_path / f"{kind}{n}.svg").read_text(encoding="utf-8") for n in ("", "1"))
    assert len(first) < len(whole)
    assert f"the construction of its {'instant' if kind == 'centres' else 'dead'} centres" in whole


@pytest.mark.parametrize("name", FEW)
def test_a_purpose_is_read_back_and_in_any_unit(name: str, tmp_path: Path) -> None:
    scene = MADE[name]()
    path = tmp_path / "scene.toml"
    path.write_text(text(scene), encoding="utf-8")
    again = linkanim.load(path)
    assert again.purpose == scene.purpose
    shown = in_unit(again, "cm")
    match shown.purpose, scene.purpose:
        case PosesPurpose() as one, PosesPurpose() as other:
            assert np.array(one.poses)[:, :2] == pytest.approx(np.array(other.poses)[:, :2] / 10)
        case TimeRatioPurpose(stroke=float(one_stroke)), TimeRatioPurpose(stroke=float(stroke)):
            assert one_stroke == pytest.approx(stroke / 10)
        case one, other:
            assert isinstance(one, FunctionPurpose | TimeRatioPurpose)
            assert type(one) is type(other)
    assert len(construction(shown)) == len(construction(scene))


SCENE = """
[four-bar]
ground = 100
crank = 30
coupler = 90
rocker = 80
"""


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ('[guide]\nposes = [["0 mm", "0 mm", "0 deg"]]', "must be a list of 2 to 5 poses"),
        ('[guide]\nposes = [["0 mm", "0 mm"], ["1 mm", "1 mm", "9 deg"]]', "must be x, y and an angle"),
        (
            '[guide]\nposes = [[0, 0, "0 deg"], ["1 mm", "1 mm", "9 deg"]]',
            'needs its unit; write it as "80 mm"',
        ),
        ('[guide]\nposes = [["0 mm", "0 mm", 0], ["1 mm", "1 mm", "9 deg"]]', "has no unit"),
        ("[quick-return]\nratio = 0.5\nstroke = '80 mm'", "give 1 or more"),
        ("[quick-return]\nratio = 1.5", "either the slider's stroke or the rocker's swing"),
        ("[quick-return]\nratio = 'two'\nstroke = '80 mm'", "must be a finite number"),
        (
            "[function]\nwords = 'y = x'\nx = [1, 2]\ny = [1]\ninput = ['1 deg']\noutput = ['1 deg']",
            "must be a list of 2 to 12 numbers",
        ),
        (
            "[function]\nwords = 'y = x'\nx = [1, 2, 3]\ny = [1, 2]\ninput = ['1 deg', '2 deg']\n"
            "output = ['1 deg', '2 mm']",
            "equally long",
        ),
        ("[quick-return]\nratio = 2\nstroke = '9 mm'\n[guide]\nposes = []", "keep one of the tables"),
        ("[guide]\nplaces = []", "unknown key"),
    ],
)
def test_a_purpose_that_is_none_is_refused(table: str, said: str, tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(f"{SCENE}\n{table}\n", encoding="utf-8")
    with pytest.raises(BadInput, match=said):
        linkanim.load(path)


def test_a_purpose_on_a_scene_of_another_kind_is_no_construction(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(f"{SCENE}\n[quick-return]\nratio = 1.5\nswing = '60 deg'\n", encoding="utf-8")
    assert construction(linkanim.load(path))  # a four-bar all the same
    press = text(linkanim.load("press"))
    path.write_text(f"{press}\n[quick-return]\nratio = 1.5\nswing = '60 deg'\n", encoding="utf-8")
    with pytest.raises(BadInput, match="has no construction"):
        construction(linkanim.load(path))
