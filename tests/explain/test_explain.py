"""The worked solution: every printed line gives the next one, and the last ones are what solving gives."""

from __future__ import annotations

import base64
import math
import re
import subprocess
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest
from printed import checks_of, of_html, of_latex, of_markdown
from tex import needs_tex

import linkanim.explain.documents
from linkanim.cli import main
from linkanim.explain.documents import HTML, MARKDOWN, TEX, body_style
from linkanim.explain.formula import LATEX, Formula, Symbol, typeset
from linkanim.explain.solution import PoseRequest, Solution, solution
from linkanim.explain.steps import Given, System, ValueLine
from linkanim.explain.variant import variant
from linkanim.mechanics.forces import effort_token
from linkanim.mechanics.linkage import RRR
from linkanim.paper.lettering import FAMILY
from linkanim.picture.dimensions import symbols
from linkanim.picture.figure import figure
from linkanim.picture.text import subscripted
from linkanim.scenes import load, names
from linkanim.scenes.editing import dimensions, in_unit
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import parse

DIGITS = 5.1e-5
"""Four significant digits, and what is in the last place of a float."""


def _request(scene: str | Scene, degrees: float, speed: float | None = None) -> PoseRequest:
    """Return a pose by angle, or by phase of an input that turns back."""
    scene = load(scene) if isinstance(scene, str) else scene
    by: Literal["angle", "phase"] = "angle" if scene.info.full_turn else "phase"
    return PoseRequest(scene, by, math.radians(degrees), speed or scene.linkage.drive.speed)


def _disagreeing(found: Solution) -> list[tuple[str, float, float]]:
    motion, quantities = found.request.motion(), found.request.scene.quantities
    wrong = []
    for result in found.results:
        true, shown = float(quantities[result.token].displayed(motion)), result.value.value
        off = abs(math.remainder(shown - true, 360)) if result.unit == "°" else abs(shown - true)
        if not off <= max(DIGITS * abs(true), result.least):
            wrong.append((result.token, true, shown))
    return wrong


def _failing(found: Solution) -> list[str]:
    """Return the printed lines, of three documents, that do not give the next one."""
    wrong = []
    for form, read in ((MARKDOWN, of_markdown), (TEX, of_latex), (HTML, of_html)):
        checks = list(checks_of(read(form.document(found))))
        items = [item for chapter in found.chapters for item in chapter.items]
        formulas = sum(isinstance(item, ValueLine) and item.formula.operation != "leaf" for item in items)
        systems = sum(
            isinstance(item, System) and any(one.operation != "leaf" for row in item.formulas for one in row)
            for item in items
        )
        assert len(checks) == formulas + 6 * systems
        wrong += [f"{check.formula} = {check.shown}" for check in checks if not check.holds]
    return wrong


# A four-bar, sliders, slot, yoke, gears, planet, cylinder, driven slider; inputs that turn and that swing.
@pytest.mark.parametrize(
    "name",
    ["crank-rocker", "slider-crank", "inverted-slider-crank", "scotch-yoke", "press", "double-rocker",
     "epicyclic-hypocycloid", "excavator", "driven-piston", "engine"],
)  # fmt: skip
def test_each_printed_line_gives_the_next_and_the_last_are_what_solving_gives(name: str) -> None:
    found = solution(_request(name, 50.0))
    assert not found.singular
    assert _failing(found) == []
    assert _disagreeing(found) == []
    linkage = found.request.scene.linkage
    assert linkage.forceful == (effort_token(linkage) in {result.token for result in found.results})


@pytest.mark.long
@pytest.mark.parametrize("name", names())
def test_all_scenes_at_several_angles(name: str) -> None:
    for degrees in (0.0, 37.0, 111.5, 200.0, 306.0):
        found = solution(_request(name, degrees, speed=-3.0))
        assert _failing(found) == []
        assert _disagreeing(found) == [] or found.singular


LOADED = """
[slider-crank]
crank = 40
rod = 120
[bodies.slider]
slider = "B"
mass = "3 kg"
[loads.work]
on = "slider"
force = { table = [[90, "4 kN"], [125, "0 N"]], over = "travel", against = true, moving = "backward" }
[loads.wind]
on = "rod"
at = [10, 5]
force = { size = "50 N", angle = "30 deg", turns = true }
torque = "0.3 N m"
[loads.push]
on = "crank"
at = "A"
force = ["0 N", "-20 N"]
"""


@pytest.mark.parametrize("degrees", [40.0, 87.0, 250.0])
def test_loads_are_worked_out_with_what_the_input_delivers(degrees: float) -> None:
    found = solution(_request(scene_from(parse(LOADED, "my.toml"), name="my", where="my.toml"), degrees))
    assert _failing(found) == []
    assert _disagreeing(found) == []
    assert "input.torque" in {result.token for result in found.results}


LOCAL = {("b", "1"), ("b", "2"), ("θ", "half"), ("d", "min"), ("d", "max")}
"""Symbols of one step alone, by letter and index: right sides of two equations, reaches of two bars."""


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_a_symbol_stands_for_one_number(name: str) -> None:
    found = solution(_request(name, 73.1))
    known: dict[Symbol, float] = {}
    for item in (item for chapter in found.chapters for item in chapter.items):
        if isinstance(item, System):
            assert item.unknowns[0] != item.unknowns[1]
        symbol = item.value.symbol if isinstance(item, ValueLine | Given) else None
        if isinstance(item, ValueLine | Given) and symbol and (symbol.letter, symbol.sub) not in LOCAL:
            off = item.value.value - known.setdefault(symbol, item.value.value)
            off = math.remainder(off, 360) if item.unit == "°" else off
            assert abs(off) <= 1e-4 * abs(item.value.value), symbol


def _values(text: str) -> dict[str, float]:
    return {
        sides[0]: float(found[0])
        for sides in of_markdown(text)
        if (found := re.match(r"-?[\d.]+", sides[-1]))
    }


# Term report on a punch press, tables 3.1 and 3.2, at 10 rad/s; lengths in mm. At 306° its α₃ leaves its own
# loop open: this one closes it (the scene's note).
PRESS = {
    87: {
        r"\omega_{3}": "3.3271", r"\omega_{4}": "-1.2005", r"\omega_{6}": "-5.4143",
        r"\alpha_{3}": "12.7419", r"\alpha_{4}": "-11.3763", r"\alpha_{6}": "-14.2372",
        r"\dot{s}_{5}": "-132.8", r"\ddot{s}_{5}": "-2770.8",
    },
    306: {r"\alpha_{3}": "-18.4617"},
}  # fmt: skip


@pytest.mark.parametrize("degrees", PRESS)
def test_the_press_has_the_values_of_the_report(degrees: int, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", "press", "--angle", f"{degrees} deg", "--speed", "10 rad/s"]) == 0
    found = _values(capsys.readouterr().out)
    for symbol, value in PRESS[degrees].items():
        half = 0.5 * 10.0 ** -len(value.partition(".")[2])
        assert found[symbol] == pytest.approx(float(value), abs=1.01 * half), symbol


# Rows as they are printed, of what is derived and how it is said.
WRITTEN = [
    r"$\mathbf{R}_{2} + \mathbf{R}_{3} = \mathbf{R}_{1} + \mathbf{R}_{4}$",
    r"$x_{A} = r_{2} \, \cos \theta_{2} = 50 \cdot \cos 60^{\circ} = 25.00000\,\mathrm{mm}$",
    "By the chain rule, a velocity is the first coefficient times the velocity of the input.",
    "By the chain rule, an acceleration is the second coefficient times the square of the velocity of the "
    "input.",
]


def test_a_row_has_the_letters_then_the_numbers_and_each_chapter_says_what_it_does() -> None:
    lines = MARKDOWN.document(solution(_request("crank-rocker", 60.0))).splitlines()
    assert [line for line in lines if line in WRITTEN] == WRITTEN


def test_at_a_limit_it_says_that_no_rates_follow() -> None:
    found = solution(_request("double-rocker", 0.0))
    assert found.singular
    assert "are not independent" in MARKDOWN.document(found)
    assert np.isfinite([result.value.value for result in found.results]).all()


@pytest.mark.parametrize("name", ["crank-rocker", "double-rocker", "parallelogram", "excavator", "press"])
def test_a_seed_gives_other_round_lengths_of_the_same_class(name: str) -> None:
    scene = load(name)
    found = [variant(scene, seed, lambda _: True) for seed in (1, 1, 2)]
    lengths = [[item.value for item in dimensions(one) if item.kind == "length"] for one in (scene, *found)]
    assert lengths[1] == lengths[2]
    assert len({tuple(some) for some in lengths}) == 3
    assert {one.info.class_name for one in found} == {scene.info.class_name}
    assert {one.info.full_turn for one in found} == {scene.info.full_turn}


@pytest.mark.long
@pytest.mark.parametrize("name", names())
def test_variants_of_all_scenes_are_worked_out(name: str) -> None:
    request = _request(name, 50.0)
    changed = replace(request, scene=variant(request.scene, 5, lambda _: True))
    assert changed.scene != request.scene
    found = solution(changed)
    assert _failing(found) == []
    assert _disagreeing(found) == []


@pytest.mark.parametrize("suffix", [".html", ".tex", ".md"])
def test_each_form_is_written_whole_under_its_name(
    suffix: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / f"solution{suffix}"
    assert main(["explain", "crank-rocker", "--angle", "60 deg", "-o", str(target)]) == 0
    assert capsys.readouterr().out.strip() == str(target)
    assert list(tmp_path.iterdir()) == [target]
    text = target.read_text(encoding="utf-8")
    assert "Crank-rocker" in text
    drawn = text.count(">R<tspan"), text.count(r"\draw[->")
    assert drawn == {".html": (4, 0), ".tex": (0, 4), ".md": (0, 0)}[suffix]


# what is asked for, and what the refusal names
@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["double-rocker", "--angle", "300 deg"], "from 13.7953 deg to 108.395 deg"),
        (["press", "-o", "solution.pdf"], ".html, .htm, .tex, .md"),
        (["press", "-o", "no-folder/solution.tex"], "there is no folder"),
        (["driven-piston", "--angle", "3 deg"], "take the phase"),
        (["press", "--angle", "3 deg", "--phase", "4 deg"], "not allowed with"),
    ],
)
def test_bad_input_is_refused_in_one_line(
    options: list[str],
    words: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["explain", *options]) == 2
    message = capsys.readouterr().err
    assert words in message
    assert message.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def _compiles(text: str, tmp_path: Path) -> None:
    (tmp_path / "solution.tex").write_text(text, encoding="utf-8")
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "solution.tex"]
    ran = subprocess.run(command, cwd=tmp_path, capture_output=True, check=False)
    assert ran.returncode == 0, ran.stdout[-2000:]
    assert (tmp_path / "solution.pdf").stat().st_size > 10_000


@needs_tex
@pytest.mark.slow
def test_the_latex_compiles(tmp_path: Path) -> None:
    _compiles(TEX.document(solution(_request("press", 87.0))), tmp_path)


ODD_NAMES = r"\input{x}", "a_b^c", "%$#&~", "{", "x}", "<i>", "机é", "٣", "Ŀħe\u0301", "`*[]|", "constructor"
"""Names that LaTeX, Markdown or a page takes for orders."""


TITLE = '<img src=x onerror=alert(1)> {of} $a_b$ \\ "100 %"'
FOUR_BAR = {"ground": 100, "crank": 30, "coupler": 90, "rocker": 80}


@pytest.fixture(scope="module")
def odd() -> Solution:
    """A crank-rocker with points under odd names, whose crank has its centre of mass in its pivot."""
    points = {name: {"on": ["A", "B"], "at": [10 * n, 5]} for n, name in enumerate(ODD_NAMES, 1)}
    document = {
        "title": TITLE,
        "four-bar": FOUR_BAR,
        "joints": points,
        "bodies": {"crank": {"joints": ["O2", "A"], "com": [0, 0]}},
    }
    return solution(_request(scene_from(document, name="odd", where="odd.toml"), 60.0))


@needs_tex
@pytest.mark.slow
def test_the_latex_of_odd_names_compiles(odd: Solution, tmp_path: Path) -> None:
    _compiles(TEX.document(odd), tmp_path)


def test_markdown_takes_nothing_of_the_scene_for_a_mark_or_a_tag(odd: Solution) -> None:
    text = MARKDOWN.document(odd)
    assert text.splitlines()[0] == r'# \<img src=x onerror=alert(1)\> \{of\} \$a\_b\$ \\ "100 %"'
    assert "<" not in text.replace(r"\<", "")
    headings = {line for line in text.splitlines() if line.startswith("### Joint") and "," not in line}
    assert {r"### Joint \{", r"### Joint x\}", r"### Joint \\input\{x\}", "### Joint constructor"} <= headings


def test_a_page_has_the_braces_of_the_scene_and_no_tag(odd: Solution) -> None:
    text = HTML.document(odd)
    assert "<h1>&lt;img src=x onerror=alert(1)&gt; {of} $a_b$ \\ &quot;100 %&quot;</h1>" in text
    assert "<h3>Joint {</h3>" in text
    assert "<h3>Joint x}</h3>" in text


def test_a_centre_of_mass_has_no_name_that_a_joint_has() -> None:
    point = {"on": ["A", "B"], "at": [10, 20]}
    document = {
        "four-bar": FOUR_BAR,
        "joints": {"G2": point, "GG2": point},
        "bodies": {"crank": {"joints": ["O2", "A"], "com": [5, 0]}},
        "springs": {"s": {"between": ["O4", "G2"]}},
    }
    found = solution(_request(scene_from(document, name="my", where="my.toml"), 60.0))
    assert not found.singular
    assert _disagreeing(found) == []
    assert found.places["G2"] == pytest.approx(complex(*found.request.motion().position["G2"]), rel=1e-4)


# What is stated in right angles, and how a swing's is in radians: each with the sign of a degree.
IN_DEGREES: dict[str, tuple[dict[str, Any], str]] = {
    "a start": ({"drive": {"start": "90 deg"}, "four-bar": FOUR_BAR}, r"= 90^{\circ} + \varphi ="),
    "gears": (
        {
            "ground": {"O2": [0, 0], "O4": [100, 0]},
            "joints": {
                "A": {"crank": "O2", "length": 30},
                "D": {"crank": "O4", "length": 20, "gear": {"with": "A", "ratio": -2, "offset": "-90 deg"}},
            },
        },
        r"+ \left(-90^{\circ}\right) =",
    ),
    "a guide on a body": (
        {
            "four-bar": FOUR_BAR,
            "joints": {
                "C": {
                    "from": "O2",
                    "length": 90,
                    "line": {"on": ["A", "B"], "through": "A", "angle": "90 deg"},
                }
            },
        },
        r"\theta_{3} + 90^{\circ} =",
    ),
    "a swing": (
        {"four-bar": {"ground": 100, "crank": 90, "coupler": 30, "rocker": 80}},
        r"= \frac{A \, \pi}{180^{\circ}} = \frac{",
    ),
}


@pytest.mark.parametrize("name", IN_DEGREES)
def test_right_angles_have_the_sign_of_a_degree(name: str) -> None:
    written, row = IN_DEGREES[name]
    found = solution(
        PoseRequest(scene_from(written, name="my", where="my.toml"), "phase", 0.7, 2.0),
    )
    assert row in MARKDOWN.document(found)
    assert _failing(found) == []


@pytest.mark.parametrize("unit", ["mm", "in"])
def test_a_torque_has_no_digit_that_is_wrong(unit: str) -> None:
    request = _request("press", 87.0)
    found = solution(replace(request, scene=in_unit(request.scene, unit)))
    (torque,) = [result.value for result in found.results if result.token == "input.torque"]
    assert len(torque.shown) >= len("1.4038")
    assert float(torque.shown) == round(1.40379722, len(torque.shown) - 2)


# Poses at which what is zero by geometry comes out of rounded numbers.
ZEROS = {
    ("excavator", 50.0): ("stick.rate", "bucket.rate"),
    ("isosceles-slider", 87.0): ("rod.angular_acceleration",),
    ("parallel-locomotive", 87.0): ("crank2.angular_acceleration", "rod2.angular_velocity"),
}


@pytest.mark.parametrize(("name", "degrees"), ZEROS)
def test_what_is_zero_shows_no_rounding(name: str, degrees: float) -> None:
    found = solution(_request(name, degrees))
    results = {result.token: result.value.shown for result in found.results}
    assert {float(results[token]) for token in ZEROS[name, degrees]} == {0.0}
    assert _failing(found) == []


@pytest.mark.parametrize(
    "name", [pytest.param("hart", marks=pytest.mark.long), "peaucellier", "scissor-lift", "pantograph"]
)
def test_other_lengths_leave_lines_straight_circles_round_and_what_is_level_so(name: str) -> None:
    scene = load(name)
    for seed in (1, 2):
        changed = variant(scene, seed, lambda _: True)
        assert changed.title == f"{scene.title}, with other lengths"
        for one, other in zip(_straightness(scene), _straightness(changed), strict=True):
            assert (one < 1e-9) == (other < 1e-9)


def _straightness(scene: Scene) -> list[float]:
    """Return how wide each moving joint's path is across, in its lengths."""
    found = []
    for place in scene.cycle(96).position.values():
        widths = np.linalg.svd(place - place.mean(axis=0), compute_uv=False)
        if widths[0] > 1e-9 * scene.linkage.longest:
            found.append(widths[1] / widths[0])
    return found


@pytest.mark.parametrize(
    ("name", "sides"),
    [
        ("crank-rocker", ("r_{1} + r_{4}",)),
        ("six-bar", ("r_{1} + r_{4}", "r_{5} + r_{8}")),
        ("watt-1", ("r_{1} + r_{5}",)),  # its pin is stated by a place level with the other
    ],
)
def test_a_ground_that_is_level_is_a_length_in_loop_figure_and_given(
    name: str, sides: tuple[str, ...]
) -> None:
    text = MARKDOWN.document(solution(PoseRequest(load(name), "phase", 1.0, 1.0)))
    given, _, loops = text.partition("## Positions")[0].partition("## Vector loops")
    for side in sides:
        assert f"= {side} \\, \\cos" in loops
        assert side[:5] in given
    assert "= x_{O_{4}} +" not in loops


def test_a_cylinder_that_drives_is_a_loop_and_where_none_closes_it_says_so() -> None:
    found = solution(_request("excavator", 100.0))
    foot, cylinder, head = (end - begin for begin, end in found.arrows.values())
    assert foot + cylinder == pytest.approx(head)
    places = found.request.scene.pose(math.radians(100.0), 0).position
    assert abs(cylinder) == pytest.approx(math.dist(places["G"], places["H"]))
    text = MARKDOWN.document(solution(_request("cardan-gears", 50.0)))
    assert "There is no loop to close" in text
    assert "Kinematic coefficients are derivatives with respect to the input" in text
    assert "Each loop" not in text
    slider = {
        "ground": {"O": [0, 0]},
        "joints": {"B": {"line": {"through": "O"}}},
        "drive": {"slider": {"joint": "B", "from": 0, "to": 100}},
    }
    alone = scene_from(slider, name="slider", where="slider")
    text = MARKDOWN.document(solution(PoseRequest(alone, "phase", 1.0, 1.0)))
    assert all(word not in text for word in ("Each loop", "Kinematic coefficients", "chain rule"))


LONG_SLOT = {
    "ground": {f"O{n}": [40 * n, 0] for n in range(9)},
    "joints": {
        "A": {"crank": "O0", "length": 10},
        "D1": {"from": ["A", "O1"], "length": [42, 25], "side": "left"},
        **{
            f"D{n}": {"from": [f"D{n - 1}", f"O{n}"], "length": [40, 25], "side": "left"} for n in range(2, 9)
        },
        "X": {"slot": {"pivot": "D6", "through": "O4"}, "length": 1e7},
    },
    "bodies": {f"bar{n}": {"joints": [f"D{n}", f"D{n + 1}"]} for n in range(1, 8)},
}


@pytest.mark.slow
def test_a_bar_far_longer_than_the_others_does_not_take_their_digits() -> None:
    found = solution(_request(scene_from(LONG_SLOT, name="my", where="my.toml"), 218.6607))
    level = {one.token: one.value.value for one in found.results}
    assert [level[f"bar{n}.angle"] for n in range(1, 8)] == [0.0] * 7


ACROSS = {
    "four-bar": {"ground": 8, "crank": 3, "coupler": 1, "rocker": 6, "ground_angle": "45 deg"}
    | {"assembly": "crossed", "coupler_point": [0, 6]},
    "ground": {"G": {"length": 7, "angle": "0 deg"}},
    "joints": {
        "S": {"from": "P", "length": 3, "line": {"through": "G", "angle": "90 deg", "offset": 3}}
        | {"side": "backward"},
        "near": {"on": ["O4", "B"], "at": [0, 1e-6]},
    },
    "bodies": {"rod": {"joints": ["P", "S"]}, "short": {"joints": ["O4", "near"]}},
}


def test_digits_that_a_short_bar_needs_leave_a_rod_across_its_guide_there() -> None:
    found = solution(_request(scene_from(ACROSS, name="my", where="my.toml"), 0.0))
    (rod,) = (one for one in found.results if one.token == "rod.angle")
    assert abs(rod.value.value) <= 2 * rod.least


def test_rates_miss_the_differentiated_loops_by_rounding_alone() -> None:
    text = MARKDOWN.document(solution(PoseRequest(load("press"), "angle", 1.5, 10.0)))
    found = re.findall(r"a residual of at most (\S+) mm/s²?\.", text)
    assert len(found) == 2
    sizes = [
        value.replace("×10", "e").translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")) for value in found
    ]
    assert all(0 <= float(value) < 0.05 for value in sizes)


def test_an_accelerated_input_adds_its_share() -> None:
    request = PoseRequest(load("crank-rocker"), "angle", 1.0, 10.0, 30.0)
    found = {result.token: result.value.value for result in solution(request).results}
    motion = load("crank-rocker").solve(angle=1.0, speed=10.0, acceleration=30.0)
    assert found["rocker.angular_acceleration"] == pytest.approx(
        motion.angular_acceleration["rocker"], rel=1e-5
    )
    speed = float(np.hypot(*motion.velocity["B"]))
    assert found["B.velocity"] == pytest.approx(speed, rel=1e-5)


def test_all_results_stand_at_the_end() -> None:
    found = solution(PoseRequest(load("crank-rocker"), "angle", 1.0, 10.0))
    assert MARKDOWN.document(found).partition("## All results")[2].count("- $") > 20


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_a_result_is_listed_in_the_digits_that_are_right(name: str) -> None:
    fewer = "fewer where they are small beside others of their kind"
    for degrees in (0.0, 73.1, 180.0, 251.7):
        found = solution(_request(name, degrees))
        text = MARKDOWN.document(found)
        printed = dict(
            re.findall(r"^- \$(.*) = (-?[\d.]+)", text.partition("## All results")[2], re.MULTILINE)
        )
        short = 0
        items = (item for chapter in found.chapters for item in chapter.items)
        lines = {item.value.symbol: item.value.value for item in items if isinstance(item, ValueLine)}
        for symbol, true in found.solved.items():
            shown = printed.pop(typeset(Formula("leaf", symbol=symbol, shown="0"), LATEX))
            half = 0.5001 * 10 ** -len(shown.partition(".")[2])
            assert abs(float(shown) - true) <= half, (symbol, true)
            assert abs(float(shown) - lines.get(symbol, true)) <= half, (symbol, lines[symbol])
            short += float(shown) != 0 and float(shown) != pytest.approx(true, rel=6e-4)
        assert not printed
        assert fewer in text or not short


# Points behind a body's first joint and to the right of its line, guides and a slot to the right; of the drag
# link's point a length is the coupler's own.
RIGHT = {
    "title": "To the right",
    "length_unit": "mm",
    "drive": {"joint": "A", "speed": "20 rpm"},
    "ground": {"O2": [0, 0], "O4": [200, 0]},
    "joints": {
        "A": {"crank": "O2", "length": 40},
        "B": {"from": "A", "length": 120, "side": "forward", "line": {"through": "O2", "offset": -20}},
        "C": {"slot": {"pivot": "O4", "through": "A", "offset": -15}, "length": 90},
        "P": {"on": ["A", "B"], "at": [-35, -70]},
        "Q": {"on": ["O4", "C"], "at": [-25, 0]},
    },
    "bodies": {
        "crank": {"joints": ["O2", "A"]},
        "rod": {"joints": ["A", "B", "P"]},
        "arm": {"joints": ["O4", "C", "Q"], "com": [10, -5]},
    },
}


@pytest.mark.parametrize("name", ["to the right", "drag-link", "crank-rocker", "slider-crank"])
def test_a_length_is_that_of_the_figure_and_its_side_is_told(name: str) -> None:
    scene = scene_from(RIGHT, name="s", where="s") if name == "to the right" else load(name)
    found = solution(_request(scene, 70.0))
    assert _failing(found) == []
    assert _disagreeing(found) == []
    lengths = {
        item.value.symbol: item
        for item in found.chapters[0].items
        if isinstance(item, Given) and item.value.symbol and item.value.symbol.letter in "repq"
    }
    assert all(item.value.value > 0 for item in lengths.values())
    assert any("right" in item.words for item in lengths.values()) == (name != "slider-crank")
    drawn = {one.symbol: one.value for one in symbols(figure(scene)).dimensions if one.symbol[0] == "r"}
    given = {
        subscripted(f"r{symbol.sub}"): item.value.value
        for symbol, item in lengths.items()
        if symbol.letter == "r"
    }
    assert given == pytest.approx(drawn)


def test_an_input_that_swings_has_an_acceleration_by_its_angle_alone(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["explain", "double-rocker", "--phase", "30 deg", "--acceleration", "2 rad/s^2"]) == 2
    assert "give --angle with it" in capsys.readouterr().err


# closed forms: four-bars and slider-cranks by their class, offset, and driven the other way
CLOSED = ["crank-rocker", "slider-crank", "engine", "isosceles-slider", "wiper"]
# found by search: gears, a slot, a second dyad, inputs that swing; one comes to a dead centre twice
SEARCHED = ["press", "whitworth", "crank-shaper", "six-bar", "double-rocker", "triple-rocker", "andrews"]


def _lines_of(found: Solution, title: str) -> dict[str, float]:
    chapters = [chapter for chapter in found.chapters if chapter.title == title]
    lines = (item for chapter in chapters for item in chapter.items if isinstance(item, ValueLine))
    return {
        f"{line.value.symbol.letter}{line.value.symbol.sub}": line.value.value
        for line in lines
        if line.value.symbol
    }


@pytest.mark.parametrize("name", CLOSED + SEARCHED)
def test_stroke_swing_and_time_ratio_are_derived_as_info_has_them(name: str) -> None:
    found = solution(_request(name, 50.0))
    info, lines = found.request.scene.info, _lines_of(found, "Dead centres and time ratio")
    if info.stroke:
        assert lines["H"] == pytest.approx(info.stroke, rel=2e-6)
    elif info.swing:
        assert lines["ψswing"] == pytest.approx(math.degrees(info.swing.stroke), abs=1e-3)
    else:
        assert lines == {}
        return
    if name == "six-bar":
        assert "TR" not in lines
        return
    assert lines["TR"] == pytest.approx(info.time_ratio, rel=2e-6)


def test_a_swing_over_two_drive_periods_has_its_time_ratio_in_words() -> None:
    """A link that follows a slider to where the rod and the link lie in one line, and on through it."""
    written = {
        "ground": {"O2": [0, 0]},
        "drive": {"slider": {"joint": "C", "from": 54, "to": 60}},
        "joints": {
            "C": {"line": {"through": "O2", "angle": "30 deg"}},
            "A": {"from": ["C", "O2"], "length": [54, 6], "side": "right"},
        },
        "bodies": {"lever": {"joints": ["O2", "A"]}},
    }
    scene = scene_from(written, name="my", where="my.toml")
    text = MARKDOWN.document(solution(PoseRequest(scene, "phase", 0.7, 2.0)))
    assert scene.info.true_period == 2
    assert "The motion repeats after 2 periods of the input." in text
    assert "more than once" not in text


@pytest.mark.parametrize(
    "lengths",
    [(110, 130, 80, 115), (100, 60, 45, 50), (100, 30, 85, 80), (100, 70, 40, 50)],
    ids=["double-rocker", "triple-rocker", "crank-rocker", "triple-rocker, ground longest"],
)
def test_the_input_turns_back_at_derived_angles(lengths: tuple[int, ...]) -> None:
    sides = dict(zip(("ground", "crank", "coupler", "rocker"), lengths, strict=True))
    document = {"four-bar": sides | {"ground_angle": "20 deg"}}
    found = solution(PoseRequest(scene_from(document, name="my", where="my.toml"), "phase", 0.7, 2.0))
    info, lines = found.request.scene.info, _lines_of(found, "Range of the input")
    angles = [value for name, value in lines.items() if name.startswith("θ")]
    assert bool(angles) is not info.full_turn
    for end in () if info.full_turn else map(math.degrees, info.input_range):
        assert min(abs(math.remainder(end - angle, 360)) for angle in angles) < 1e-3


def test_pivots_in_one_place_to_the_digits_shown_ask_for_no_division_by_zero() -> None:
    written = {"four-bar": {"ground": 1e-10, "crank": 50_000, "coupler": 85_000, "rocker": 80_000}}
    found = solution(PoseRequest(scene_from(written, name="my", where="my.toml"), "phase", 3.3, 2.0))
    assert not any(name.startswith(("k", "ψ")) for name in _lines_of(found, "Range of the input"))
    text = MARKDOWN.document(found)
    assert "In the digits shown A is equally far from O4 at every crank angle" in text
    assert "The crank turns fully." in text


@pytest.mark.parametrize("offset", [0, 25, -25])
def test_a_crank_longer_than_its_rod_turns_back_where_the_rod_stands_square(offset: int) -> None:
    written = {"slider-crank": {"crank": 80, "rod": 60, "offset": offset}}
    found = solution(PoseRequest(scene_from(written, name="my", where="my.toml"), "phase", 0.7, 2.0))
    angles = [v for name, v in _lines_of(found, "Range of the input").items() if name.startswith("θ")]
    for end in map(math.degrees, found.request.scene.info.input_range):
        assert min(abs(math.remainder(end - angle, 360)) for angle in angles) < 1e-3


@pytest.mark.parametrize("name", ["crank-rocker", "press", "double-rocker", "jansen", "watt-1"])
@pytest.mark.parametrize("degrees", [40.0, 200.0])
def test_the_half_angle_form_gives_the_angle_found(name: str, degrees: float) -> None:
    found = solution(_request(name, degrees))
    (chapter,) = [one for one in found.chapters if "half-angle" in one.title]
    places = found.request.motion().position
    for step in chapter.steps:
        joint = found.request.scene.linkage.joint(step.title.split()[1].strip("\x02\x03"))
        assert isinstance(joint, RRR)
        x, y = places[joint.name] - places[joint.ends[1]]
        (angle,) = [item.value.value for item in step.items if isinstance(item, ValueLine)][-1:]
        assert abs(math.remainder(angle - math.degrees(math.atan2(y, x)), 360)) < 1e-2


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "said"),
    [("jansen", r"At $\theta_{m}$ = 30.00°."), ("excavator", r"At $\theta_{\mathrm{boom}}$ = 59.99°.")],
)
def test_the_pose_is_one_that_moves_and_its_angle_is_set(
    name: str, said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["explain", name]) == 0
    assert capsys.readouterr().out.splitlines()[2] == said


def test_factors_of_a_thousandth_are_explained_once() -> None:
    text = MARKDOWN.document(solution(_request("press", 87.0)))
    assert text.count("1 mm is 0.001 m") == 1


def test_pages_bring_the_font_of_their_formulas() -> None:
    text = HTML.document(solution(_request("crank-rocker", 60.0)))
    (face,) = re.findall(r"url\(data:font/woff2;base64,([\w+/=]+)\)", text)
    assert len(face) < 40_000
    path = Path(linkanim.explain.documents.__file__).parent / "faces"
    assert base64.b64decode(face) == (path / "LinkanimMath.woff2").read_bytes()
    assert {"GUST-FONT-LICENSE.txt", "MANIFEST-LinkanimMath.txt"} <= {one.name for one in path.iterdir()}


@pytest.mark.parametrize(("name", "says"), [("watt-line", "swings −69.2°"), ("antiparallelogram", "is −1: ")])
def test_its_sentences_have_true_minus_signs(
    name: str, says: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["explain", name]) == 0
    prose = re.sub(r"\$[^$]*\$", "", capsys.readouterr().out)
    assert says in prose
    assert not re.search(r"(?<!\w)-\d", prose)


def test_a_page_sets_its_text_in_a_face_of_which_its_pictures_bring_no_parts() -> None:
    # a picture carries the letters that it uses: the others of a text would be in another face
    families = re.findall(r"font: [\d.]+px/[\d.]+ ([^;]*);", body_style("16px/1.5", 56))
    assert families
    assert not any(FAMILY in family for family in families)


NOT_FOR_A_CLASS = ("scene file", "scene states", "the class says", "'s way s", "But for whole turns", "Here ")
"""Words of the program, or of no textbook, that stood on sheets."""


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_a_sheet_speaks_as_a_textbook_does(name: str) -> None:
    text = MARKDOWN.document(solution(_request(name, 73.1)))
    assert [words for words in NOT_FOR_A_CLASS if words in text] == []
    # an article fits the word behind it
    assert not re.search(r"\ba (?:antip|eight|input|offset|inv)|\ban (?:crank|six|four|slider|rocker)", text)


LARGEST = 200_000
LARGER = {"scissor-lift": 290_000, "andrews": 260_000}
"""Of nine dyads 65,000 bytes are words and numbers, and each of 1,900 symbols is three elements of MathML."""


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_a_page_is_small(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = tmp_path / "solution.html"
    assert main(["explain", name, "-o", str(target)]) == 0
    assert len(target.read_bytes()) <= LARGER.get(name, LARGEST)
