"""Reports: what the page and its files say is what is solved."""

from __future__ import annotations

import csv
import html
import math
import re
import shutil
import subprocess
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from browser import PROGRAM, pages_of, printed
from PIL import Image

from linkanim.cli import main
from linkanim.explain.solution import PoseRequest, solution
from linkanim.mechanics.measures import output_body, output_slider
from linkanim.mechanics.quantities import register
from linkanim.paper.curves import Pace
from linkanim.paper.findings import (
    Instant,
    Values,
    charted,
    instants_at,
    paces_of,
    sheet,
    usual_instants,
    value_tables,
)
from linkanim.paper.html import Beside
from linkanim.paper.report import Report
from linkanim.paper.vectors import vectors_svg
from linkanim.picture.dimensions import symbols
from linkanim.picture.figure import figure
from linkanim.picture.stills import still_phase
from linkanim.scenes import load, names
from linkanim.scenes.toml import text as written
from linkanim.units import rounded, significant, typeset


@pytest.fixture
def anywhere(monkeypatch: pytest.MonkeyPatch) -> None:
    """The figure is of any pose: which one reads best is looked for where that is what is asked."""
    monkeypatch.setattr("linkanim.paper.report.still_phase", lambda _: 1.0)


# turns fully; its joints are farthest apart within its second turn; swings, and rests at its start
def _text(folder: Path) -> str:
    """Return what a report's page says, its blanks plain."""
    return html.unescape((folder / "report.html").read_text(encoding="utf-8")).replace("\xa0", " ")


POSED = ["crank-rocker", "dwell-six-bar", "double-rocker"]


@pytest.mark.slow
@pytest.mark.thinned(3)
@pytest.mark.parametrize("name", POSED)
def test_a_figure_a_solution_and_a_report_are_of_one_pose(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["draw", name]) == 0
    (drawn,) = re.findall(r"= (\S+)°: the pose that reads best", capsys.readouterr().out)
    assert main(["explain", name]) == 0
    (worked,) = re.findall(r"^At .* = (\S+)°\.$", capsys.readouterr().out, re.MULTILINE)
    scene = load(name)
    pose = scene.pose(still_phase(scene), 1)
    assert float(drawn) == pytest.approx(float(worked), abs=0.06)
    assert float(worked) == pytest.approx(math.degrees(pose.coordinate) % 360, abs=0.006)
    assert 0 < float(worked) < 360
    assert pose.coordinate_rate
    report = Report(scene, (), (Pace(1.0, ""),))
    worked_out = solution(PoseRequest(scene, "phase", still_phase(scene), 1.0))
    assert dict(report.files())["loops.svg"] == vectors_svg(worked_out)


PACES = tuple(Pace(speed, f"{speed:g} rad/s") for speed in (5.0, 10.0, 20.0))
PRESS = ("report", "press", "--angles", "87 deg,306 deg", "--speeds", "5 rad/s,10 rad/s,20 rad/s")


class Parts(HTMLParser):
    """What a page is made of: its elements with their attributes, what it loads, and what is not closed."""

    EMPTY = frozenset({"meta", "br", "col"})

    def __init__(self, text: str) -> None:
        super().__init__()
        self.elements: list[tuple[str, dict[str, str]]] = []
        self.open: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, {name: value or "" for name, value in attrs}))
        if tag not in self.EMPTY:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def all(self, tag: str) -> list[dict[str, str]]:
        return [known for name, known in self.elements if name == tag]

    @property
    def loaded(self) -> list[str]:
        """What lies outside of the page."""
        found = [
            known.get(name, "") for _, known in self.elements for name in ("src", "href", "srcset", "data")
        ]
        return [address for address in found if address and not address.startswith("#")]


@pytest.fixture(scope="module")
def press(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("reports") / "press"
    assert main([*PRESS, "-o", str(folder)]) == 0
    return folder


@pytest.mark.usefixtures("anywhere")
@pytest.mark.slow
def test_the_page_s_path_isprinted(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["report", "scotch-yoke", "-o", str(tmp_path / "out")]) == 0
    assert capsys.readouterr().out == f"{tmp_path / 'out' / 'report.html'}\n"


@pytest.fixture(scope="module")
def every(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("reports") / "press"
    assert main([*PRESS, "--all", "-o", str(folder)]) == 0
    return folder


@pytest.mark.slow
def test_the_page_holds_everything_and_loads_nothing(press: Path) -> None:
    text = (press / "report.html").read_text(encoding="utf-8")
    page = Parts(text)
    assert page.loaded == []
    assert not page.all("script")
    # the figure, the loops, the pose at two angles, and there the polygons at three speeds
    assert len(page.all("svg")) == 2 + 2 * (1 + 3) + len(list(press.glob("chart-*.svg")))
    assert "@page { size: A4;" in text
    # a font comes with the page
    assert not re.search(r"url\((?!data:font)|@import|https?://(?!www\.w3\.org)", text)


def test_the_page_is_valid_and_can_be_read_aloud(press: Path) -> None:
    page = Parts((press / "report.html").read_text(encoding="utf-8"))
    assert page.open == []
    assert page.all("html") == [{"lang": "en"}]
    ids = [known["id"] for _, known in page.elements if "id" in known]
    assert len(ids) == len(set(ids))
    assert {link["href"][1:] for link in page.all("a")} == set(ids)
    assert {picture["role"] for picture in page.all("svg")} == {"img"}
    assert all(picture["aria-label"].startswith("Figure ") for picture in page.all("svg"))
    assert len(page.all("caption")) == len(page.all("table"))
    assert {head["scope"] for head in page.all("th")} == {"row", "col", "colgroup", "rowgroup"}


def test_figures_and_tables_are_numbered_in_their_order(press: Path) -> None:
    text = (press / "report.html").read_text(encoding="utf-8")
    for what, tag in (("Figure", "figcaption"), ("Table", "caption")):
        numbers = [int(number) for number in re.findall(rf"<{tag}>{what} (\d+)\. \S", text)]
        assert numbers == list(range(1, text.count(f"<{tag}>") + 1))
        assert len(numbers) > 4


def test_its_chapters_go_as_a_report_on_a_mechanism_does(press: Path) -> None:
    text, scene = (press / "report.html").read_text(encoding="utf-8"), load("press")
    headings = re.findall(r"<h(\d)>(.*?)</h", text)
    assert headings[0] == ("1", html.escape(scene.title))
    chapters = [words for level, words in headings if level == "2"]
    below = [words for level, words in headings if level == "3"]
    assert below[:3] == ["Loop of B", "Loop of C", "Positions"]
    assert {"Joint B", "The same by the half-angle form", "Joint B, second coefficients"} <= {*below}
    assert chapters == [
        "1 The mechanism",
        "2 Vector loops",
        "3 Derivation",
        "4 Poses",
        "5 Values",
        "6 Positions",
        "7 Velocities",
        "8 Accelerations",
        "9 Centres of mass",
        "10 Springs, dampers and input",
        "11 Comparison with printed values",
        "12 Velocity and acceleration polygons",
        "13 Summary",
        "Figures",
    ]
    listed = re.findall(r"<li><a href='#chapter-\d+'>(.*?)</a>", text)
    assert listed == chapters[:-1]
    figures = re.findall(r"<li><a href='#figure-\d+'>(.*?)</a>", text)
    assert figures == [words.replace("Figure ", "", 1).replace(". ", " ", 1) for words in
                       re.findall(r"<figcaption>(.*?)</figcaption>", text)]  # fmt: skip
    assert f"<p class='source'>{html.escape(scene.source)}</p>" in text
    assert f"<p>{html.escape(scene.look_at)}</p>" in text


@pytest.mark.long
@pytest.mark.slow
def test_all_has_every_quantity_behind_the_hand_out(every: Path, press: Path) -> None:
    text = (every / "report.html").read_text(encoding="utf-8")
    chapters = re.findall(r"<h2>\d+ (.*?)</h2>", text)
    assert chapters[12:] == [
        "Every quantity at θ₂ = 87.00°",
        "Every quantity at θ₂ = 306.00°",
        "Every quantity over one period, at 5 rad/s, 10 rad/s, 20 rad/s",
    ]
    rows = set(re.findall(r"<tr><th scope='row'>([^<]*)</th><td>(?:ω₃|μ)</td>", text))
    assert rows == {"angular velocity", "Transmission angle"}
    tokens = {path.stem.split("-", 2)[2] for path in every.glob("chart-*.svg")}
    assert tokens >= set(charted(Values(load("press"))))
    assert {path.name for path in press.iterdir()} <= {path.name for path in every.iterdir()}


def test_its_pictures_are_well_formed_and_as_large_as_each_other(press: Path) -> None:
    sizes: dict[str, set[tuple[str | None, str | None]]] = {}
    for path in press.glob("*.svg"):
        root = ElementTree.parse(path).getroot()
        assert root.tag == "{http://www.w3.org/2000/svg}svg"
        sizes.setdefault(path.stem.partition("-")[0], set()).add((root.get("width"), root.get("height")))
    assert sizes.pop("loops")
    # an odd chart of a topic has a row of its own
    assert sizes == {"figure": {("360", "618")}, "chart": {("400", "205"), ("820", "205")}}


def test_its_figure_names_the_dimensions_and_has_no_other_words(press: Path) -> None:
    root = ElementTree.parse(press / "figure.svg").getroot()
    words = {"".join(text.itertext()) for text in root.iter() if text.tag.endswith("text")}
    apart = {text for group in root.iter() if group.get("id") in {"words", "key"} for text in _lines(group)}
    # what finds no room by its bar stands apart, with its bar's name
    assert all(re.fullmatch(r"r\d = \d+ mm, \w+–\w+", text) for text in apart), apart
    known = {text.partition(",")[0] for text in words}
    assert {
        f"r{n} = {mm} mm" for n, mm in ((1, 330), (2, 55), (3, 283), (4, 322), (6, 165), (7, 61))
    } <= known


def _lines(group: ElementTree.Element) -> list[str]:
    return ["".join(text.itertext()) for text in group.iter() if text.tag.endswith("text")]


def test_its_loops_name_each_vector_and_joint_once(press: Path) -> None:
    root = ElementTree.parse(press / "loops.svg").getroot()
    names = ["".join(text.itertext()) for text in root.iter() if text.tag.endswith("text")]
    assert names == ["O2", "O7", "A", "D", "B", "C", "H", "R2", "R3", "R1", "R7", "R6", "R4", "S5"]


@pytest.mark.parametrize(
    ("name", "axis", "room"),
    [("press", 1, 480), ("pumpjack", 0, 520), ("engine", 1, 480)],
    ids=["taller than wide", "wider than tall", "a flywheel reaches below all joints"],
)
def test_loops_and_links_fill_their_figure_and_none_is_cut_off(name: str, axis: int, room: int) -> None:
    root = ElementTree.fromstring(vectors_svg(solution(PoseRequest(load(name), "phase", 1.0, 1.0))))
    groups = [one for one in root.iter() if re.match(r"vector-|body-|joint-|fitting-", one.get("id") or "")]
    drawn = [path.get("d") or "" for group in groups for path in group if path.tag.endswith("path")]
    places = [float(place[axis]) for one in drawn for place in re.findall(r"[ML]([-\d.]+) ([-\d.]+)", one)]
    assert 0 < min(places) < max(places) < room
    assert max(places) - min(places) == pytest.approx(0.86 * room, rel=0.03)


def test_facts_and_the_end_have_the_tables_digits_and_set_symbols(press: Path) -> None:
    text = (press / "report.html").read_text(encoding="utf-8")
    end = text.partition("Summary</h2>")[2]
    assert "Stroke: 67.21 mm. Time ratio: 2.153." in end
    assert "67.2126" not in text
    assert "Table 1. Facts at 20 rpm" in text  # a torque and a period are at some speed
    # the list of figures stands on one page with the end
    assert re.search(r"<div class='keep'>\n<section id='chapter-13'>", text)


@pytest.mark.usefixtures("anywhere")
@pytest.mark.thinned(2)
@pytest.mark.parametrize(("name", "beside"), [("jansen", True), ("scissor-lift", False)])
def test_equations_too_long_for_half_a_page_stand_below_the_loops(name: str, beside: bool) -> None:
    scene = load(name)
    first, *others = Report(scene, usual_instants(scene), PACES[:1])._vector_loops()
    assert isinstance(first, Beside) == beside
    assert bool(others) != beside


def test_its_charts_say_of_what_they_are(press: Path) -> None:
    text = (press / "report.html").read_text(encoding="utf-8")
    captions = re.findall(r"<figcaption>Figure \d+\. (.*?)</figcaption>", text)
    assert {"Travel of slider C", "Angle of link 3, link 6 and link 4", "Transmission angle"} <= {*captions}
    assert "Velocity of the centre of mass of link 3" in captions


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


@pytest.mark.long
@pytest.mark.slow
def test_the_press_has_a_chart_of_all_that_the_printed_report_plots(every: Path) -> None:
    shown = {path.stem.split("-", 2)[2] for path in every.glob("chart-*.svg")}
    assert set(PRINTED) <= shown


def test_the_press_notes_where_the_printed_report_errs(press: Path) -> None:
    scene = load("press")
    solved = scene.solve(angle=math.radians(306), speed=10.0).angular_acceleration["3"]
    assert typeset(significant(float(solved), 6)) == "−18.4617"
    assert "−18.4617" in scene.notes[0]
    assert scene.notes[0] in _text(press)


# What the printed report's tables have of ω and α at 87° and 10 rad/s, to four digits.
AT_87 = {"Link 3": ("3.327", "12.74"), "Link 4": ("−1.201", "−11.38"), "Link 6": ("−5.414", "−14.24")}


def test_the_tables_of_the_press_say_what_the_printed_report_does() -> None:
    values, (low, high) = Values(load("press")), (math.radians(87), math.radians(306))
    found = {
        one.title: one for one in value_tables(values, instants_at(load("press"), (low, high)), PACES, 4)
    }
    assert list(found) == [
        "Links", "Slider C", "Joints", "Centres of mass", "Springs and dampers",
        "Forces in joints", "Guide on Slider C", "The whole mechanism",
    ]  # fmt: skip
    links = found["Links"]
    assert [title for title, _ in links.groups] == ["θ₂ = 87.00°", "θ₂ = 306.00°"]
    at = [
        next(
            n for n, column in enumerate(links.columns) if (column.symbol, column.pace) == (symbol, PACES[1])
        )
        for symbol in ("ω", "α")
    ]
    rows = dict(links.groups[0][1])
    assert {name: tuple(rows[name][n] for n in at) for name in AT_87} == AT_87
    assert "−18.46" in dict(links.groups[1][1])["Link 3"]
    assert dict(found["Slider C"].groups[0][1])["θ₂ = 87.00°"][4:8:3] == ("−132.8", "−2771")


def test_more_speeds_than_fit_go_on_in_a_further_table() -> None:
    paces = tuple(Pace(float(n), f"{n} rad/s") for n in range(1, 7))
    tables = list(value_tables(Values(load("crank-rocker")), (Instant(0.0),), paces, 4))
    links = [one for one in tables if one.title == "Links"]
    assert [len(one.columns) for one in links] == [3 + 2 * 4, 2 * 2]


def test_what_is_nothing_by_geometry_is_0_and_what_is_unbounded_says_where() -> None:
    scene = load("slider-crank")
    tables = {one.title: one for one in value_tables(Values(scene), usual_instants(scene), PACES[:1], 4)}
    slider = dict(tables["Slider"].groups[0][1])
    velocity = next(n for n, column in enumerate(tables["Slider"].columns) if column.symbol == "v")
    assert [row[velocity] for row in slider.values()][1:] == ["0", "0"]
    whole = tables["The whole mechanism"]
    advantage = next(n for n, column in enumerate(whole.columns) if column.symbol == "MA")
    assert [row[advantage] for row in dict(whole.groups[0][1]).values()][1:] == ["∞", "∞"]
    assert whole.notes == ("∞: unbounded at θ₂ = 7.18°, θ₂ = 194.48°.",)


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_tables_say_what_is_solved_at_every_speed(name: str) -> None:
    scene = load(name)
    values, digits = Values(scene), re.compile(r"^[−\d.×⁻⁰¹²³⁴⁵⁶⁷⁸⁹∞–]+$")
    numbers = {token: one for token, one in register(scene.linkage).items() if len(one.columns) == 1}
    for instant in usual_instants(scene):
        sections = sheet(values, instant, PACES, 7)
        rows = {one.token: told for part in sections.values() for one, told in part}
        assert rows.keys() == numbers.keys()
        for pace, n in zip(PACES, range(3), strict=True):
            motion = scene.solve(phase=instant.phase, speed=pace.speed)
            for token, told in rows.items():
                value = float(numbers[token].displayed(motion))
                assert digits.match(told[n])
                assert told[n] in (rounded(value, 7), "0", "∞", "−∞"), token
                # nothing is so small, or so large, that it is a rounding error
                assert abs(value) < 1e-5 or told[n] != "0", token


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
    assert [instant.place(scene) for instant in (start, Instant(1.5))] == [
        "θ₂ = 0.00° (start)",
        "θ₂ = 85.94°",
    ]
    second_turn = Instant(math.radians(447))
    assert second_turn.place(load("kite")) == "θ₂ = 147.00°"
    piston = load("driven-piston")
    travel = float(piston.solve(phase=1.0).coordinate)
    assert Instant(1.0, "then").place(piston) == f"s = {travel:.2f} mm (then)"
    for instant, degrees in ((high, 71.0), (low, 316.5)):
        assert math.degrees(instant.phase) == pytest.approx(degrees, abs=1.0)
        assert scene.pose(instant.phase).travel_velocity["5"] == pytest.approx(0.0, abs=1e-12)


def test_what_no_speed_changes_has_one_curve() -> None:
    press = load("press")
    counts = {"3.coefficient": 1, "H.position.x": 1, "return.force": 1}
    counts |= {"cushion.force": 3, "3.angular_velocity": 3, "input.torque": 3}
    for token, count in counts.items():
        assert len(paces_of(press, token, PACES)) == count, token


def test_what_stands_still_has_no_chart() -> None:
    tokens = [*charted(Values(load("parallelogram")))]
    assert "coupler.angular_velocity" not in tokens
    assert "crank.angle" in tokens


def test_of_joints_that_are_not_traced_and_of_poles_the_tables_tell() -> None:
    press = load("press")
    told = {token.partition(".")[0] for token in charted(Values(press))}
    joints = {joint.name for joint in press.linkage.joints} - {body.name for body in press.linkage.bodies}
    assert joints & told == set(press.trace)
    assert not any(".pole" in token for token in charted(Values(press)))


@pytest.mark.usefixtures("anywhere")
@pytest.mark.slow
def test_numbers_on_the_page_have_true_minus_signs(tmp_path: Path) -> None:
    into = tmp_path / "report"
    options = ["--angles=-60 deg", "--speeds=-20 rpm"]
    assert main(["report", "triple-rocker", "-o", str(into), *options]) == 0
    page = (into / "report.html").read_text(encoding="utf-8")
    seen = re.sub(r"<style.*?</style>|<script.*?</script>|<svg.*?</svg>", "", page, flags=re.DOTALL)
    seen = html.unescape(re.sub(r"<[^>]+>", " ", seen))
    assert "−20 rpm" in seen
    assert re.findall(r"(?<![\w-])-\d.{9}", seen) == []


def test_an_extreme_at_the_start_is_looked_at_once() -> None:
    words = [instant.words for instant in usual_instants(load("scissor-lift"))]
    assert words == ["start, greatest travel of the foot", "least travel of the foot"]


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_what_is_told_to_be_greatest_or_least_at_an_instant_is(name: str) -> None:
    scene = load(name)
    _, *extremes = usual_instants(scene)
    output = output_slider(scene.linkage) or output_body(scene.linkage)
    for instant in extremes:
        assert output
        place, rate = ("travel", "travel_velocity") if output.slider else ("angle", "angular_velocity")
        here = scene.pose(instant.phase)
        assert scene.quantities[f"{output.name}.{rate}"].read(here) == pytest.approx(0.0, abs=1e-12)
        told = float(getattr(here, place)[output.name])
        along = np.asarray(getattr(scene.cycle(720), place)[output.name])
        if not output.slider:
            told += math.tau * round((float(along.mean()) - told) / math.tau)
        end = along.max() if "greatest" in instant.words else along.min()
        assert told == pytest.approx(end, abs=1e-3 * np.ptp(along))


def test_at_the_end_of_its_stroke_a_straight_toggle_stands() -> None:
    """Beside it the ram's rate has no digits: there it goes with the third power of the phase."""
    scene = load("toggle-press")
    at = {instant.words: scene.pose(instant.phase) for instant in usual_instants(scene)}
    for words, phase in (("greatest travel of the ram", math.pi), ("least travel of the ram", 0.0)):
        assert at[words].phase == phase
        for part in ("C.velocity", "K.velocity", "R.velocity", "upper.angular_velocity"):
            assert scene.quantities[part].read(at[words]) == 0.0
    assert scene.info.dead_centres == (0.0, math.pi)


def test_where_a_knuckle_is_straight_at_its_crank_s_dead_centre_all_but_the_crank_stands() -> None:
    """The crank, its rod and the straight knuckle meet in (0, -130): 55 + 195 is the way there."""
    scene = load("knuckle-press")
    (place,) = (one.phase for one in usual_instants(scene) if "greatest" in one.words)
    assert place == pytest.approx(math.tau - math.atan2(70, 240), abs=1e-14)
    pose = scene.pose(place)
    for token in ("upper.angular_velocity", "lower.angular_velocity", "R.velocity", "B.velocity"):
        assert scene.quantities[token].read(pose) == 0.0
    assert scene.info.dead_centres
    assert scene.info.dead_centres[1] == place


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
        pytest.param(("--digits", "16"), "15 at the most", id="more digits than a number has"),
        pytest.param(("--digits", "0"), "not a whole number", id="no digits"),
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


@pytest.mark.usefixtures("anywhere")
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
@pytest.mark.usefixtures("anywhere")
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


@pytest.mark.window
@pytest.mark.skipif(not PROGRAM, reason="needs Chromium")
def test_the_press_is_printed_on_few_pages(press: Path, tmp_path: Path) -> None:
    assert 4 <= pages_of(printed(press / "report.html", tmp_path)) <= 13


@pytest.mark.long
@pytest.mark.window
@pytest.mark.skipif(not PROGRAM or not shutil.which("pdftoppm"), reason="needs Chromium and pdftoppm")
@pytest.mark.parametrize("name", ["press", "crank-rocker", "slider-crank", "six-bar", "excavator", "jansen"])
def test_no_page_but_the_last_is_under_two_thirds_full(name: str, tmp_path: Path) -> None:
    asked = PRESS[1:] if name == "press" else (name,)
    assert main(["report", *asked, "-o", str(tmp_path / "out")]) == 0
    target = printed(tmp_path / "out" / "report.html", tmp_path)
    subprocess.run(["pdftoppm", "-r", "20", "-gray", str(target), str(tmp_path / "page")], check=True)
    pages = sorted(tmp_path.glob("page-*.pgm"))
    assert len(pages) > 2
    for page in pages[:-1]:
        with Image.open(page) as image:
            grey = np.asarray(image)
        # above the page's foot
        rows = np.flatnonzero((grey < 200).any(axis=1) & (np.arange(len(grey)) < 0.93 * len(grey)))
        assert rows.max() > 0.66 * 0.93 * len(grey), page.name


def test_printed_values_stand_beside_the_press_s_own(press: Path) -> None:
    text = html.unescape((press / "report.html").read_text(encoding="utf-8"))
    rows = re.findall(
        r"<tr>((?:<td>.*?</td>)+)</tr>", text.partition("Comparison with printed values</h2>")[2]
    )
    found = [re.findall(r"<td>(.*?)</td>", row) for row in rows][:9]
    assert [len(row) for row in found] == [6] * 8 + [4]
    motion = load("press").solve(angle=math.radians(87), speed=10.0)
    ours = [*(motion.angular_velocity[link] for link in "346"), motion.travel_velocity["5"]]
    for (_, own, program, percent, polygons, _), value in zip(found, ours, strict=False):
        assert float(own.replace("−", "-")) == pytest.approx(float(value), rel=1e-5)
        assert float(program.replace("−", "-")) == pytest.approx(float(value), rel=4e-4)
        assert float(polygons.replace("−", "-")) == pytest.approx(float(value), rel=2e-3)
        assert abs(float(percent.replace("−", "-"))) < 0.04


@pytest.mark.slow
@pytest.mark.usefixtures("anywhere")
def test_a_scene_of_that_name_in_a_file_has_no_printed_values(tmp_path: Path) -> None:
    path = tmp_path / "press.toml"
    path.write_text(written(load("press")), encoding="utf-8")
    assert main(["report", str(path), "-o", str(tmp_path / "out")]) == 0
    assert "printed values" not in (tmp_path / "out" / "report.html").read_text(encoding="utf-8")


@pytest.mark.usefixtures("anywhere")
@pytest.mark.slow
def test_an_accelerated_input_is_in_tables_charts_and_words(tmp_path: Path) -> None:
    asked = ["report", "crank-rocker", "--angles", "60 deg", "--speeds", "10 rad/s"]
    assert main([*asked, "--acceleration", "30 rad/s^2", "-o", str(tmp_path)]) == 0
    text = html.unescape((tmp_path / "report.html").read_text(encoding="utf-8"))
    assert "acceleration 30 rad/s² in every position shown" in text
    motion = load("crank-rocker").solve(angle=math.radians(60), speed=10.0, acceleration=30.0)
    value = float(motion.angular_acceleration["rocker"])
    assert f">{typeset(rounded(value, 4))}<" in text
    with (tmp_path / "quantities-1.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    assert float(rows[0]["rocker.angular_acceleration"]) == pytest.approx(
        float(
            load("crank-rocker")
            .solve(phase=0.0, speed=10.0, acceleration=30.0)
            .angular_acceleration["rocker"]
        )
    )


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["double-rocker", "--acceleration", "2 rad/s^2"], "goes with an input that turns fully"),
        (["press", "--acceleration", "2 rad/s^2", "--data", "x.csv"], "at a constant speed"),
    ],
)
def test_an_acceleration_that_cannot_be_is_refused(
    options: list[str], words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["report", *options, "-o", str(tmp_path / "out")]) == 2
    assert words in capsys.readouterr().err


@pytest.mark.long
def test_its_figures_show_an_input_that_moves(tmp_path: Path) -> None:
    scene = load("excavator")
    assert all(0.1 < one.phase < 3.0 or one.words != "half-way" for one in usual_instants(scene))
    assert main(["report", "excavator", "-o", str(tmp_path / "out")]) == 0
    text = html.unescape((tmp_path / "out" / "report.html").read_text(encoding="utf-8"))
    ends = [f"{math.degrees(end):.1f}°" for end in scene.info.input_range]
    captions = re.findall(r"<figcaption>(.*?)</figcaption>", text)
    assert not any(end in caption for caption in captions[:2] for end in ends)
    assert "all at rest" not in text


def test_angles_of_tables_lie_within_one_turn_and_names_of_pins_have_indices(press: Path) -> None:
    text = html.unescape((press / "report.html").read_text(encoding="utf-8"))
    assert "Pin O₂, x" in text
    rows = re.findall(r"<th scope='row'>Link \d</th><td class='n'>([^<]*)</td>", text)
    assert len(rows) >= 10
    angles = [float(cell.replace("−", "-")) for cell in rows[:10]]
    assert all(0 <= angle < 360 for angle in angles)


def test_facts_have_the_digits_of_the_tables(press: Path) -> None:
    text = html.unescape((press / "report.html").read_text(encoding="utf-8"))
    info = load("press").info
    assert info.stroke
    assert info.time_ratio
    assert f"<td>{rounded(info.stroke, 4)} mm</td>" in text
    assert f"<td>{rounded(info.time_ratio, 4)}</td>" in text


def test_its_loops_stand_on_the_pins_of_links_alone(press: Path) -> None:
    # the press has two more pins on the ground, of its spring and its damper, out of the figure's room
    root = ElementTree.parse(press / "loops.svg").getroot()
    box = [float(number) for number in (root.get("viewBox") or "").split()]
    for group in root.iter():
        if (group.get("id") or "").partition("-")[0] in (
            "ground",
            "body",
            "joint",
            "fitting",
            "vector",
            "mark",
        ):
            drawn = " ".join(path.get("d") or "" for path in group if path.tag.endswith("path"))
            places = [tuple(map(float, place)) for place in re.findall(r"[ML]([-\d.]+) ([-\d.]+)", drawn)]
            assert places
            assert all(-2 <= x <= box[2] + 2 and -2 <= y <= box[3] + 2 for x, y in places)
            assert max(x for x, _ in places) < 0.9 * box[2]


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_its_dimensions_have_the_symbols_and_the_numbers_of_its_figure(name: str) -> None:
    scene = load(name)
    rows = dict(Report(scene, usual_instants(scene)[:1], PACES[:1])._dimensions())
    told = {label.split("  ")[0]: value for label, value in rows.items() if "  " in label}
    for one in symbols(figure(scene)).dimensions:
        value, unit = re.match(r"(-?[\d.]+) ?(.*)", told[one.symbol]).groups()  # type: ignore[union-attr]
        assert float(value) == pytest.approx(one.value, rel=1e-5)
        assert (unit == "°") == one.angle


@pytest.mark.parametrize(
    ("more", "speeds"),
    [([], ["5 rad/s", "10 rad/s"]), (["--polygon-speed", "10 rad/s"], ["10 rad/s"])],
)
def test_polygons_are_drawn_at_each_speed_or_at_the_one_that_is_named(
    more: list[str], speeds: list[str], tmp_path: Path
) -> None:
    asked = [
        "report",
        "crank-rocker",
        "--angles",
        "60 deg",
        "--speeds",
        "5 rad/s,10 rad/s",
        "--no-derivation",
    ]
    assert main([*asked, *more, "-o", str(tmp_path)]) == 0
    text = _text(tmp_path)
    captions = re.findall(r"<figcaption>Figure \d+\. (.*?)</figcaption>", text)
    found = [words.rpartition(", ")[2] for words in captions if words.startswith("Velocity and acceleration")]
    assert found == speeds
    assert "Derivation" not in text
    assert text.count("significant digits") == 1


def test_one_speed_is_named_for_polygons(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    asked = ["report", "crank-rocker", "--polygon-speed", "5 rad/s,10 rad/s", "-o", str(tmp_path / "out")]
    assert main(asked) == 2
    assert "--polygon-speed takes one speed, not 2" in capsys.readouterr().err


@pytest.mark.usefixtures("anywhere")
@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
@pytest.mark.thinned(3)
def test_every_chart_is_discussed_in_sentences_and_only_places_have_a_time_ratio(name: str) -> None:
    scene = load(name)
    report = Report(scene, usual_instants(scene)[:1], PACES[:2])
    for tokens, part in (chart for charts in report._topics.values() for chart in charts):
        assert part.words.endswith("."), tokens
        if "time ratio" in part.words:
            assert all(token.endswith((".angle", ".travel")) for token in tokens)
