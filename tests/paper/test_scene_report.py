"""Reports: what the page and its files say is what is solved."""

from __future__ import annotations

import csv
import html
import math
import re
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from linkanim.cli import main
from linkanim.digits import significant, typeset
from linkanim.mechanics.facts.register import register
from linkanim.paper.curves import Pace
from linkanim.paper.findings import Instant, charted, instants_at, paces_of, sheet, usual_instants
from linkanim.scenes import load, names

PACES = tuple(Pace(speed, f"{speed:g} rad/s") for speed in (5.0, 10.0, 20.0))
PRESS = ("report", "press", "--angles", "87 deg,306 deg", "--speeds", "5 rad/s,10 rad/s,20 rad/s")


class Parts(HTMLParser):
    """What a page is made of: its tags, and the address of everything that it loads."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.loaded: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.loaded += [value or "" for name, value in attrs if name in ("src", "href", "srcset", "data")]


@pytest.fixture(scope="module")
def press(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("reports") / "press"
    assert main([*PRESS, "-o", str(folder)]) == 0
    return folder


def test_the_page_s_path_is_printed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["report", "scotch-yoke", "-o", str(tmp_path / "out")]) == 0
    assert capsys.readouterr().out == f"{tmp_path / 'out' / 'report.html'}\n"


@pytest.mark.slow
def test_the_page_holds_everything_and_loads_nothing(press: Path) -> None:
    text = (press / "report.html").read_text(encoding="utf-8")
    page = Parts(text)
    assert page.loaded == []
    assert "script" not in page.tags
    # the figure, and that with the polygons
    assert page.tags.count("svg") == 2 + len(list(press.glob("chart-*.svg")))
    assert "@page" in text
    assert "size: A4" in text
    assert not re.search(r"url\(|@import|https?://(?!www\.w3\.org)", text)


def test_the_page_s_headings_outline_it(press: Path) -> None:
    text, scene = (press / "report.html").read_text(encoding="utf-8"), load("press")
    headings = re.findall(r"<h(\d)>(.*?)</h", text)
    outline = [words for level, words in headings if level == "2"]
    assert headings[0] == ("1", html.escape(scene.title))
    assert {level for level, _ in headings} == {"1", "2", "3"}
    assert outline[:2] == ["Facts", "Dimensions"]
    assert [words.partition(" =")[0] for words in outline[2:]] == [
        *["At θ₂"] * (len(outline) - 4),
        "Velocities and accelerations as polygons",
        "Over one period, at 5 rad/s, 10 rad/s, 20 rad/s",
    ]
    last = max(n for n, (level, _) in enumerate(headings) if level == "2")
    over = dict.fromkeys(html.escape(heading) for heading, _ in charted(scene))
    assert list(over) == [words for _, words in headings[last + 1 :]]
    parts = [words for level, words in headings if level == "3"]
    assert {"Link 3", "Slider 5", "C", "Link 3, centre of mass", "Damper cushion", "Whole mechanism"} <= set(
        parts
    )
    assert f"<p class='source'>{html.escape(scene.source)}</p>" in text
    assert f"<p>{html.escape(scene.look_at)}</p>" in text
    assert min(path.name.split("-")[1] for path in press.glob("chart-*.svg")).lstrip("0") == "1"


def test_rows_are_named_without_what_their_heading_says(press: Path) -> None:
    text = (press / "report.html").read_text(encoding="utf-8")
    named = re.findall(r"<tr><th>([^<]*)</th><td>ω₃</td>|<th>([^<]*)</th><td>μ</td>", text)
    assert set(named) == {("angular velocity", ""), ("", "Transmission angle")}


def test_its_pictures_are_well_formed_and_as_large_as_each_other(press: Path) -> None:
    sizes: dict[str, set[tuple[str | None, str | None]]] = {}
    for path in press.glob("*.svg"):
        root = ElementTree.parse(path).getroot()
        assert root.tag == "{http://www.w3.org/2000/svg}svg"
        sizes.setdefault(path.stem.partition("-")[0], set()).add((root.get("width"), root.get("height")))
    assert sizes == {"figure": {("900", "560")}, "chart": {("900", "360")}}


def test_its_figure_names_the_dimensions_and_has_no_other_words(press: Path) -> None:
    root = ElementTree.parse(press / "figure.svg").getroot()
    assert "r3 = 283 mm" in {"".join(text.itertext()) for text in root.iter() if text.tag.endswith("text")}
    assert {"words", "key"}.isdisjoint(group.get("id") for group in root.iter())


# What the printed report on the press prints or plots.
PRINTED = [
    *(f"{body}.{name}" for body in "346" for name in ("coefficient", "second_coefficient")),
    "5.coefficient",
    "5.second_coefficient",
    *(f"{body}.angular_{name}" for body in "346" for name in ("velocity", "acceleration")),
    *(f"5.travel{rest}" for rest in ("", "_velocity", "_acceleration")),
    *(
        f"{body}.com_{rate}{axis}"
        for body in "23467"
        for rate in ("velocity", "acceleration")
        for axis in ("", ".x", ".y")
        if (body, axis) not in (("2", ""), ("7", ""))  # a crank's own centre goes at one speed
    ),
    *(f"{body}.com_position.{axis}" for body in "23467" for axis in "xy"),
    *(f"return.{name}" for name in ("length", "rate")),
    *(f"cushion.{name}" for name in ("length", "rate", "direction", "direction_rate")),
]


def test_the_press_has_a_chart_of_all_that_the_printed_report_plots(press: Path) -> None:
    shown = {path.stem.split("-", 2)[2] for path in press.glob("chart-*.svg")}
    assert set(PRINTED) <= shown


def test_the_press_notes_where_the_printed_report_errs(press: Path) -> None:
    scene = load("press")
    solved = scene.solve(angle=math.radians(306), speed=10.0).angular_acceleration["3"]
    assert typeset(significant(float(solved), 6)) == "−18.4617"
    assert "−18.4617" in scene.notes[0]
    assert scene.notes[0] in (press / "report.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_tables_say_what_is_solved_at_every_speed(name: str) -> None:
    scene = load(name)
    for instant in usual_instants(scene):
        rows = {row.quantity.token: row for _, part in sheet(scene, instant, PACES).sections for row in part}
        numbers = {token: one for token, one in register(scene.linkage).items() if len(one.columns) == 1}
        assert rows.keys() == numbers.keys()
        for pace, n in zip(PACES, range(3), strict=True):
            motion = scene.solve(phase=instant.phase, speed=pace.speed)
            for token, row in rows.items():
                value = float(numbers[token].shown(motion))
                said = typeset(significant(value, 7)) if math.isfinite(value) else row.values[n]
                assert row.values[n] == said, token


@pytest.mark.parametrize("n", [1, 2, 3])
def test_the_table_of_all_quantities_is_that_of_solve(press: Path, n: int) -> None:
    with (press / f"quantities-{n}.csv").open(encoding="utf-8", newline="") as file:
        header, *lines = csv.reader(file)
    columns = [np.array([float(cell or "nan") for cell in cells]) for cells in zip(*lines, strict=True)]
    found = dict(zip(header, columns, strict=True))
    scene, pace = load("press"), PACES[n - 1]
    motion = scene.solve(phase=found["phase"], speed=pace.speed)
    assert found["time"] == pytest.approx(found["phase"] / pace.speed)
    assert found["angle"] == pytest.approx(motion.coordinate)
    assert len(lines) == 361
    for token in ("3.angular_acceleration", "5.travel_velocity", "cushion.force", "4.com_velocity.y"):
        solved = np.asarray(register(scene.linkage)[token].read(motion))
        assert found[token] == pytest.approx(solved, rel=1e-15)


def test_a_slider_s_extremes_are_told_by_themselves() -> None:
    scene = load("press")
    start, high, low = usual_instants(scene)
    assert start.phase == 0.0
    assert [sheet(scene, instant, PACES).title for instant in (start, Instant(1.5, ""))] == [
        "θ₂ = 0.00° (start)",
        "θ₂ = 85.94°",
    ]
    second_turn = Instant(math.radians(447), "")
    assert sheet(load("kite"), second_turn, PACES).title == "θ₂ = 147.00°"
    piston = load("driven-piston")
    travel = float(piston.solve(phase=1.0).coordinate)
    assert sheet(piston, Instant(1.0, "then"), PACES).title == f"s = {travel:.2f} mm (then)"
    for instant, degrees in ((high, 71.0), (low, 316.5)):
        assert math.degrees(instant.phase) == pytest.approx(degrees, abs=1.0)
        assert scene.pose(instant.phase).travel_velocity["5"] == pytest.approx(0.0, abs=1e-4)


def test_what_no_speed_changes_has_one_curve() -> None:
    press = load("press")
    counts = {"3.coefficient": 1, "H.position.x": 1, "return.force": 1}
    counts |= {"cushion.force": 3, "3.angular_velocity": 3, "input.torque": 3}
    for token, count in counts.items():
        assert len(paces_of(press, token, PACES)) == count, token


def test_what_stands_still_has_no_chart() -> None:
    tokens = [token for _, token in charted(load("parallelogram"))]
    assert "coupler.angular_velocity" not in tokens
    assert "crank.angle" in tokens


def test_of_joints_that_are_not_traced_and_of_poles_the_tables_tell() -> None:
    press = load("press")
    told = {token.partition(".")[0]: heading for heading, token in charted(press)}
    joints = {joint.name for joint in press.linkage.joints} - {body.name for body in press.linkage.bodies}
    assert joints & told.keys() == set(press.trace)
    assert not any(".pole" in token for _, token in charted(press))


def test_angles_choose_the_phase_also_of_a_swing() -> None:
    scene = load("double-rocker")
    middle = sum(scene.info.input_range) / 2
    (instant,) = instants_at(scene, (middle,))
    assert scene.pose(instant.phase).coordinate == pytest.approx(middle)


# Refused in one line, and nothing is written.
@pytest.mark.parametrize(
    ("options", "words"),
    [
        pytest.param(("--angles", "87"), "no unit", id="an angle without a unit"),
        pytest.param(("--speeds", "0 rad/s"), "other than zero", id="a speed that moves nothing"),
        pytest.param(("--angles", ","), "give angles", id="no angle"),
    ],
)
def test_what_cannot_be_reported_is_refused(
    options: tuple[str, ...], words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["report", "press", "-o", str(tmp_path / "out"), *options]) == 2
    assert words in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_an_angle_out_of_range_is_refused_with_the_range(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["report", "double-rocker", "-o", str(tmp_path / "out"), "--angles", "200 deg"]) == 2
    assert "the input rocker angle goes from" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_a_report_takes_the_place_of_an_older_one_and_of_nothing_else(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / "out"
    for scene in ("kite", "scotch-yoke"):
        assert main(["report", scene, "-o", str(target)]) == 0
        (target / "thesis.txt").write_text("keep me")
    assert [path.name for path in tmp_path.iterdir()] == ["out"]
    assert (target / "thesis.txt").read_text() == "keep me"
    assert main(["report", "scotch-yoke", "-o", str(tmp_path / "alone")]) == 0
    alone = {path.name for path in (tmp_path / "alone").iterdir()}
    assert {path.name for path in target.iterdir()} == alone | {"thesis.txt"}


# A page of that name may be anyone's, and one that was written on is no longer only ours.
@pytest.mark.parametrize("whose", ["another's", "an older version's", "ours, changed"])
def test_a_page_that_is_not_ours_alone_is_never_written_over(
    whose: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / "out"
    if whose == "another's":
        target.mkdir()
    else:
        assert main(["report", "scotch-yoke", "-o", str(target)]) == 0
    if whose == "an older version's":
        (target / ".linkanim-report.json").unlink()
    else:
        (target / "report.html").write_text("what I noted")
    (target / "thesis.docx").write_text("keep me")
    before = {path.name: path.read_bytes() for path in target.iterdir()}
    assert main(["report", "kite", "-o", str(target)]) == 2
    err = capsys.readouterr().err
    assert "report.html" in err
    assert "move it away, or choose another name" in err
    assert {path.name: path.read_bytes() for path in target.iterdir()} == before
