"""What a page holds, what it must not, and what is refused before anything is written."""

from __future__ import annotations

import base64
import hashlib
import json
import math
import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import read_tables

from linkanim.cli import main
from linkanim.errors import BadInput
from linkanim.paper.svg import hexadecimal
from linkanim.picture.hud import measured
from linkanim.picture.theme import DARK, LIGHT
from linkanim.scenes import load
from linkanim.scenes.editing import other_return
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import parse
from linkanim.share.page import LARGEST, Shared, document
from linkanim.share.site import INDEX, write_site

VOID = {"meta", "link", "input"}


class Reader(HTMLParser):
    """Reads a page strictly: what is opened is closed, in its order."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.seen: list[tuple[str, dict[str, str | None]]] = []
        self.text: dict[str, str] = {}
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.seen.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.seen.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        tag = self.open[-1] if self.open else ""
        self.text[tag] = self.text.get(tag, "") + data


def held(text: str) -> Any:
    found = re.search(r'id="data">(.*?)</script>', text, re.DOTALL)
    assert found
    return json.loads(found[1])


@pytest.mark.slow
def test_the_fullest_page_is_small_and_asks_for_nothing() -> None:
    text = document(Shared(load("press"), chart="5.travel_velocity", names=2))
    page = Reader(text)
    assert len(text.encode()) <= LARGEST == 200_000
    addresses = {attrs[key] for _, attrs in page.seen for key in ("src", "href") if key in attrs}
    assert {address for address in addresses if not str(address).startswith("#")} == {"data:,"}
    assert not re.search(r"@import|url\(|https?://(?!www\.w3\.org/2000/svg)", text)
    policy = next(attrs["content"] for _, attrs in page.seen if "http-equiv" in attrs)
    script = text.split("<script>")[1].split("</script>")[0]
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    assert str(policy).startswith("default-src 'none'")
    assert f"script-src 'sha256-{digest}'" in str(policy)


def test_words_of_a_scene_are_words_and_nothing_else() -> None:
    title = "</script><img src=x onerror=alert(1)> & \"quotes\" fill='#000000'"
    text = f"title = '''{title}'''\n[four-bar]\nground = 100\ncrank = 30\ncoupler = 90\nrocker = 80\n"
    scene = scene_from(parse(text, "odd"), name="odd", where="odd")
    page = Reader(document(Shared(scene, names=1)))
    assert page.text["title"] == page.text["h1"] == title
    assert not any(tag == "img" for tag, _ in page.seen)


@pytest.mark.parametrize(
    ("shared", "declared"),
    [(None, ["#fcfcfa", "#11141a"]), ("light", ["#fcfcfa"]), ("dark", ["#11141a"])],
)
def test_a_stated_theme_is_the_only_one(shared: Any, declared: list[str]) -> None:
    text = document(Shared(load("scotch-yoke"), theme=shared))
    assert [colour for colour in ("#fcfcfa", "#11141a") if f": {colour};" in text] == declared


def test_words_and_ground_have_the_colours_of_the_reader_s_theme() -> None:
    text = document(Shared(load("crank-rocker")))
    rules = re.findall(r":root[^{]*\{[^}]*\}", text)[:2]
    light, dark = (dict(re.findall(r"(--c\d+): (#\w+);", rule)) for rule in rules)
    for name, colours in (("ink", (LIGHT.ink, DARK.ink)), ("back", (LIGHT.background, DARK.background))):
        (variable,) = re.findall(rf"--{name}: var\((--c\d+)\);", text)
        assert (light[variable], dark[variable]) == tuple(map(hexadecimal, colours))


@pytest.mark.parametrize(("names", "angles"), [(0, []), (1, [False]), (2, [True])])
def test_the_input_s_angle_is_written_beside_its_arc_with_the_dimensions(
    names: int, angles: list[bool]
) -> None:
    (side, *_) = held(document(Shared(load("crank-rocker"), names=names)))["sides"]
    assert [mover["angle"] for mover in side["movers"] if mover["kind"] == "turning"] == angles
    assert side["rows"][0]["turn"] == 360


def test_both_closures_are_there_and_know_their_names() -> None:
    sides = held(document(Shared(load("crank-rocker"))))["sides"]
    assert [side["name"] for side in sides] == ["open", "crossed"]
    assert len(held(document(Shared(load("scotch-yoke"))))["sides"]) == 1


@pytest.mark.parametrize("name", ["galloway", "knuckle-press", "isosceles-slider"])
def test_a_closure_with_a_point_at_rest_has_room(name: str) -> None:
    """A bar lies on its pivot there: a track of rounding errors alone would take up to a megabyte."""
    assert len(held(document(Shared(load(name)), pytest.fail))["sides"]) == 2


def test_a_closure_is_left_out_in_a_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("linkanim.share.page.LARGEST", 99_000)
    said: list[str] = []
    page = document(Shared(load("crank-rocker")), said.append)
    sentence = "The other closure is not on this page: both would take 101 kB, and 99 kB is the most."
    assert len(held(page)["sides"]) == 1
    assert said == [f"crank-rocker: {sentence}"]
    assert sentence in page


def test_the_command_says_on_stderr_what_a_page_leaves_out(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("linkanim.share.page.LARGEST", 99_000)
    assert main(["share", "crank-rocker", "-o", str(tmp_path / "a.html")]) == 0
    assert capsys.readouterr().err.startswith("crank-rocker: The other closure is not on this page")


@pytest.mark.parametrize(
    ("name", "high"),
    [
        pytest.param("driven-piston", 480, id="a long and low scene"),
        pytest.param("crank-rocker", 615, id="one of its own shape"),
        pytest.param("scotch-yoke", 900, id="one as high as wide"),
    ],
)
def test_a_picture_is_as_high_as_its_scene_within_bounds(name: str, high: int) -> None:
    page = Reader(document(Shared(load(name))))
    views = [attrs.get("viewbox") for tag, attrs in page.seen if tag == "svg"]
    assert views == [f"0 0 960 {high}", None]


@pytest.mark.slow
def test_a_page_runs_at_the_speed_asked_for() -> None:
    found = held(document(Shared(load("press"), speed=-1.5)))
    assert found["speed"] == -1.5
    assert found["sides"][0]["rows"][1]["text"] == ["−14.32 rpm", "14.32 rpm"]


def test_numbers_too_large_for_the_usual_ones_are_held_by_larger_ones() -> None:
    text = f"[four-bar]\nground = 100\ncrank = 30\ncoupler = 90\nrocker = 80\n{SPRING}"
    shared = Shared(scene_from(parse(text, "my"), name="my", where="my"), chart="s.force")
    side = held(document(shared))["sides"][0]
    (row,) = [row for row in side["rows"] if row["label"].endswith("force")]
    (curve,) = side["charts"][0]["curves"]
    for kind, packed in ((row["kind"], row["values"][0]), (curve["kind"], curve["values"])):
        values = np.frombuffer(base64.b64decode(packed), f"<{kind}")
        assert 1e38 < np.abs(values).max() < 1e39


SPRING = """
[springs.s]
between = ["B", "O2"]
stiffness = "9e29 N/m"
free_length = 9e11
"""


def test_a_page_s_numbers_and_chart_are_what_is_solved() -> None:
    scene = load("crank-rocker")
    data = held(document(Shared(scene, speed=2.0, chart="B.velocity")))
    for phase in np.linspace(0.01, scene.period, 200, endpoint=False).tolist():
        pose = scene.pose(phase, speed=2.0)
        assert read_tables.row(data, "crank angle", phase) == pytest.approx(math.degrees(phase), abs=1e-3)
        for back in (False, True):
            (found,) = read_tables.charted_over_angle(data, phase, back=back)
            last = 10.0 ** -data["sides"][0]["charts"][int(back)]["digits"]
            assert found == pytest.approx(math.hypot(*pose.velocity["B"]), rel=1e-5, abs=last / 2)


# Between the steps of a table lie places at which a quantity is unbounded, and a size comes down to a corner.
@pytest.mark.parametrize(
    ("name", "token"),
    [
        ("slider-crank", "mechanical_advantage"),
        ("six-bar", "P.curvature_radius"),
        ("six-bar", "coupler.pole.x"),
        ("slider-crank", "B.velocity"),
        ("geared-five-bar-3-2", "left.pole.y"),
        ("umbrella", "T.tangential_acceleration"),
        ("crank-shaper", "rod.pole.y"),
        ("watt-1", "E.curvature_radius"),
    ],
)
def test_a_page_s_chart_holds_beside_poles_and_corners(name: str, token: str) -> None:
    scene = load(name)
    data, quantity = held(document(Shared(scene, chart=token))), scene.quantities[token]
    phases = np.linspace(0.0, scene.period, 1501) + 0.0007
    exact = np.asarray(quantity.displayed(scene.solve(phase=phases)), float)
    last = 10.0 ** -data["sides"][0]["charts"][0]["digits"]
    for phase, true in zip(phases.tolist(), exact.tolist(), strict=True):
        (found,) = read_tables.charted_over_angle(data, phase)
        assert found == pytest.approx(true, rel=1e-4, abs=last / 2), phase


def test_what_is_unbounded_throughout_is_so_on_a_page_s_chart() -> None:
    data = held(document(Shared(load("slider-crank"), chart="B.curvature_radius")))
    assert read_tables.charted_over_angle(data, 1.0) == [math.inf]


SIMPLE = """
length_unit = "mm"
gravity = "9.81 m/s^2"
[slider-crank]
crank = 60
rod = 40
[bodies.slider]
slider = "B"
mass = "450 g"
"""
BESIDE = (1e-9, 1e-5, math.radians(0.04), math.radians(1), math.radians(2), math.radians(3.5), 0.5, 1.3)


def swinging(name: str) -> Scene:
    """Return a scene whose input swings; `name, same` comes back by the way it came."""
    name, _, same = name.partition(", ")
    scene = scene_from(parse(SIMPLE, name), name=name, where=name) if name == "simple" else load(name)
    return other_return(scene) if same else scene


# Beside a limit, where a torque grows without bound, or where a way that is gone back changes all signs.
@pytest.mark.slow
@pytest.mark.parametrize("name", ["simple", "simple, same", "excavator, same"])
def test_a_page_s_numbers_hold_beside_a_limit(name: str) -> None:
    scene = swinging(name)
    data, tables = held(document(Shared(scene, speed=2.0))), 0
    for back in (False, True):
        for one in measured(scene):
            for phase in (
                end + way * beside for end in (0.0, math.pi) for beside in BESIDE for way in (1, -1)
            ):
                exact = float(one.quantity.displayed(scene.pose(phase, speed=-2.0 if back else 2.0)))
                found = read_tables.row(data, one.label, phase % math.tau, back=back)
                assert found == pytest.approx(exact, rel=2e-5, abs=one.step / 10), (one.label, phase, back)
                tables += 1
    assert tables or not scene.linkage.forceful


QUICK = """
length_unit = "mm"
[drive]
joint = "A"
speed = "20 rpm"
[ground]
O2 = [0, 0]
O4 = [300, 0]
[joints]
A = { crank = "O2", length = 60 }
Q = { crank = "O4", length = 60, gear = { with = "A", ratio = 20 } }
[springs.s]
between = ["Q", "O2"]
stiffness = "100 N/m"
free_length = 100
"""


def test_a_page_s_numbers_hold_where_a_gear_is_quick() -> None:
    # One crank turns twenty times while the other turns once, and the spring's length with it.
    scene = scene_from(parse(QUICK, "quick"), name="quick", where="quick")
    length = next(one for one in measured(scene) if "length" in one.label)
    data = held(document(Shared(scene)))
    for phase in np.linspace(0.01, scene.period, 101)[:-1].tolist():
        exact = float(length.quantity.displayed(scene.pose(phase)))
        assert read_tables.row(data, length.label, phase) == pytest.approx(exact, abs=length.step / 10)


def test_a_torque_that_is_not_bounded_is_told_to_be_so_and_only_there() -> None:
    data = held(document(Shared(swinging("simple"))))
    for phase in (0.0, math.pi):
        assert read_tables.row(data, "input torque", phase) == math.inf
    for degrees, torque in ((181.0, 0.162355), (178.0, -0.0825)):
        found = read_tables.row(data, "input torque", math.radians(degrees))
        assert found == pytest.approx(torque, rel=1e-2)


@pytest.mark.thinned(2)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "token"),
    [
        ("double-rocker", "coupler.coefficient"),
        ("double-rocker", "crank.angle"),
        ("double-rocker, same", "B.velocity.x"),
        ("double-rocker, same", "A.acceleration.x"),
        ("double-rocker, same", "coupler.second_coefficient"),
    ],
)
def test_a_page_s_chart_holds_beside_a_limit(name: str, token: str) -> None:
    scene = swinging(name)
    data, quantity = held(document(Shared(scene, chart=token, speed=2.0))), scene.quantities[token]
    greatest = float(
        np.nanmax(np.abs(quantity.displayed(scene.solve(phase=np.linspace(0.1, 3, 90), speed=2.0))))
    )
    for back in (False, True):
        for end in (0.0, math.pi, math.tau):
            for phase in (end + way * beside for beside in BESIDE for way in (1, -1)):
                exact = float(quantity.displayed(scene.pose(phase, speed=-2.0 if back else 2.0)))
                (found,) = read_tables.charted(data, phase, back=back)
                assert found == pytest.approx(exact, rel=1e-5, abs=1e-5 * greatest), (phase, back)


def test_no_words_take_room_from_the_linkage() -> None:
    scene = load("crank-rocker")
    text = document(Shared(scene))
    scale, x, y = held(text)["sides"][0]["view"]
    wide, high = next(re.finditer(r'viewBox="0 0 (\d+) (\d+)"', text)).groups()
    places = np.concatenate([np.atleast_2d(one) for one in scene.cycle(90).position.values()])
    across, down = x + scale * places[:, 0], y - scale * places[:, 1]
    assert across.min() + across.max() == pytest.approx(float(wide), abs=2.0)
    assert down.min() + down.max() == pytest.approx(float(high), abs=2.0)
    assert (
        max(np.ptp(across) / float(wide), np.ptp(down) / float(high)) > 0.92
    )  # a margin of 4 % on both sides


@pytest.mark.parametrize("token", ["P.velocity", "rocker.angle", "rocker.coefficient"])
def test_a_chart_tells_its_value_to_a_thousandth_of_its_height_or_so(token: str) -> None:
    data = held(document(Shared(load("crank-rocker"), chart=token)))
    for chart in data["sides"][0]["charts"]:
        low, high = chart["y"]
        steps = (high - low) * 10 ** chart["digits"]
        assert steps >= 500
        assert steps < 5000 or chart["digits"] == 0


GEARED = """
title = "slow"
[drive]
speed = "20 rpm"
[ground]
O = [0, 0]
Q = [100, 0]
P = [200, 0]
[joints.A]
crank = "O"
length = 20
[joints.D]
crank = "Q"
length = 25
gear = { with = "A", ratio = "11/12", offset = "0 deg" }
[joints.B]
from = ["A", "D"]
length = [90, 80]
side = "left"
[joints.E]
crank = "P"
length = 25
gear = { with = "A", ratio = "7/11", offset = "0 deg" }
[joints.C]
from = ["B", "E"]
length = [150, 150]
side = "left"
[trace]
joints = ["B", "C"]
"""


def test_what_is_larger_than_a_page_may_be_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("linkanim.share.page.LARGEST", 20_000)
    with pytest.raises(
        BadInput, match="20 kB is the most; it has 5 joints and 3 bodies: share a scene of fewer"
    ):
        document(Shared(load("kite")))


@pytest.mark.long
@pytest.mark.slow
def test_what_takes_too_many_turns_to_be_back_is_refused() -> None:
    scene = scene_from(parse(GEARED, "slow"), name="slow", where="slow")
    with pytest.raises(BadInput, match="200 kB is the most; it is back after 132 turns"):
        document(Shared(scene))


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        pytest.param(["press", "--chart", "foo.bar"], 'quantity "foo.bar"', id="quantity"),
        pytest.param(["press", "--speed", "0 rpm"], "nothing moves", id="speed"),
        pytest.param(["press", "-o", "out.pdf"], "use one of .html, .htm", id="suffix"),
        pytest.param(["press", "-o", "none/out.html"], "there is no folder none", id="folder"),
        pytest.param([], "name a scene", id="no scene"),
        pytest.param(["press", "--all", "site"], "leave out a scene", id="scene and all"),
        pytest.param(["--all", "site", "--chart", "B.velocity"], "leave out --chart", id="chart and all"),
    ],
)
def test_what_cannot_be_is_refused_before_anything_is_written(
    words: list[str],
    sentence: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["share", *words]) == 2
    assert sentence in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_the_command_names_its_file_after_the_scene(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["share", "scotch-yoke", "--names"]) == 0
    assert capsys.readouterr().out == "scotch-yoke.html\n"
    assert held((tmp_path / "scotch-yoke.html").read_text(encoding="utf-8"))["input"] == "crank angle"


def test_a_site_has_an_index_and_takes_nothing_that_is_not_its_own(tmp_path: Path) -> None:
    site, some = tmp_path / "site", ("crank-rocker", "scotch-yoke")
    for _ in range(2):
        write_site(site, some, Shared(load("press")))
        pages = {path.name for path in site.glob("*.html")}
        assert pages == {INDEX, *(f"{name}.html" for name in some)}
    index = Reader((site / INDEX).read_text(encoding="utf-8"))
    assert [attrs["href"] for tag, attrs in index.seen if tag == "a"] == [f"{name}.html" for name in some]
    assert index.text["h2"] == "Four-barsSliders"
    pictures = [attrs["viewbox"] for tag, attrs in index.seen if tag == "svg"]
    assert pictures == ["0 0 240 150"] * len(some)
    (site / "scotch-yoke.html").write_text("mine", encoding="utf-8")
    with pytest.raises(BadInput, match="was changed after linkanim wrote it"):
        write_site(site, some, Shared(load("press")))
    assert (site / "scotch-yoke.html").read_text(encoding="utf-8") == "mine"
