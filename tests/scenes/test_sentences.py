"""What is told of a linkage in words, held to its motion: of every scene of the catalogue."""

from __future__ import annotations

import json
import math
import re
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from linkanim.cli import main
from linkanim.errors import AssemblyError
from linkanim.mechanics.analysis import GRASHOF, TRIPLE_ROCKERS
from linkanim.mechanics.measures import transmission_angle
from linkanim.picture.figure import figure
from linkanim.picture.quantities import quantity
from linkanim.player.state import loss_of_turning
from linkanim.scenes import load, names
from linkanim.scenes.editing import dimensions, other_closure, with_dimensions
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

SAMPLES = 7200
NAMES = names()


def angle_of(scene: Scene, body: str) -> NDArray[np.float64]:
    """Return a body's angle over one true period and back at its start, continued from joints alone."""
    member = next(one for one in scene.linkage.bodies if one.name == body)
    phases = np.linspace(0.0, scene.period, SAMPLES * scene.mechanism.periods + 1)
    motion = scene.solve(phase=phases, derivatives=0)
    first, second = (motion.position[joint] @ [1, 1j] for joint in member.joints[:2])
    return np.unwrap(np.angle(second - first))


def turns_fully(scene: Scene, body: str) -> bool:
    angle = angle_of(scene, body)
    return bool(abs(angle[-1] - angle[0]) > math.pi)


def turning_bodies(scene: Scene) -> list[str]:
    return [body.name for body in scene.linkage.bodies if body.slider is None]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.sampled
@pytest.mark.thinned(3)
def test_what_is_said_to_turn_fully_does_and_nothing_else(name: str) -> None:
    scene = load(name)
    turning = [body for body in turning_bodies(scene) if turns_fully(scene, body)]
    assert list(scene.info.turning_links) == turning
    told = dict(scene.info.lines).get("turns fully", "")
    called = [scene.info.link_names[body] for body in turning]
    assert told == ", ".join(f"link {words}" if words.isdecimal() else words for words in called)
    for body in set(turning_bodies(scene)) - set(turning):
        assert np.ptp(angle_of(scene, body)) < 2 * math.pi


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.sampled
def test_a_link_that_is_called_crank_turns_and_one_called_rocker_swings(name: str) -> None:
    scene = load(name)
    fixed = {pin.name for pin in scene.linkage.pins}
    for body, words in scene.info.link_names.items():
        noun = words.rpartition(" ")[2]
        if noun in ("crank", "rocker", "coupler"):
            member = next(one for one in scene.linkage.bodies if one.name == body)
            assert bool(fixed & set(member.joints)) == (noun != "coupler"), (body, words)
            assert noun == "coupler" or turns_fully(scene, body) == (noun == "crank"), (body, words)
    assert len(set(scene.info.link_names.values())) == len(scene.info.link_names)
    if not scene.linkage.drive.actuator.stated_lengths:
        assert (scene.info.input_name == "crank") == scene.info.full_turn


# what the links of a scene are called where their names in the file say otherwise
@pytest.mark.parametrize(
    ("name", "called"),
    [
        ("crank-rocker", ("crank", "coupler", "rocker")),
        ("crank-rocker-link3", ("rocker", "coupler", "crank")),
        ("drag-link", ("crank", "coupler", "driven crank")),
        ("galloway", ("driven crank", "coupler", "crank")),
        ("parallelogram", ("crank", "coupler", "driven crank")),
        ("antiparallelogram", ("crank", "coupler", "driven crank")),
        ("double-rocker", ("input rocker", "coupler", "rocker")),
        ("triple-rocker", ("input rocker", "coupler", "rocker")),
        ("chebyshev-line", ("input rocker", "coupler", "rocker")),
        ("roberts-line", ("input rocker", "coupler", "rocker")),
        ("watt-line", ("input rocker", "coupler", "rocker")),
        ("rocker-driven", ("crank", "coupler", "rocker")),
        ("six-bar", ("crank", "coupler", "rocker", "second coupler", "second rocker")),
    ],
)
def test_links_are_called_by_what_they_do(name: str, called: tuple[str, ...]) -> None:
    assert tuple(load(name).info.link_names.values()) == called


def test_words_follow_the_motion_and_tokens_stay(capsys: pytest.CaptureFixture[str]) -> None:
    scene = load("drag-link")
    assert quantity(scene, "rocker.angle").words == "Driven crank: angle"
    assert quantity(scene, "driven crank.angle").token == "rocker.angle"
    assert quantity(load("crank-rocker-link3"), "rocker.angle").words == "Crank: angle"
    assert set(figure(scene).links.values()) == {"crank", "coupler", "driven crank"}
    assert [item.label for item in dimensions(scene)][1:4] == ["Crank 2", "Coupler 3", "Driven crank 4"]
    assert main(["info", "drag-link", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["links"] == {"crank": "crank", "coupler": "coupler", "rocker": "driven crank"}
    assert main(["solve", "drag-link", "--angle", "10 deg", "--json"]) == 0
    assert list(json.loads(capsys.readouterr().out)["bodies"]) == ["crank", "coupler", "rocker"]


def test_tables_and_refusals_call_the_input_by_what_it_does(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", "drag-link", "--angle", "10 deg"]) == 0
    table = capsys.readouterr().out
    assert "crank angle 10 deg" in table
    assert "driven crank" in table
    assert main(["solve", "double-rocker", "--phase", "1 rad"]) == 0
    assert "\ninput rocker angle " in capsys.readouterr().out
    assert main(["solve", "double-rocker", "--angle", "1 deg"]) == 2
    assert "the input rocker angle goes from 13.7953 deg" in capsys.readouterr().err
    assert main(["solve", "double-rocker", "--sweep", "20:30:5"]) == 0
    assert "input rocker deg" in capsys.readouterr().out.splitlines()[0]


@pytest.mark.parametrize("name", NAMES)
def test_a_slider_that_takes_longer_one_way_does(name: str) -> None:
    scene = load(name)
    slider = next((body.name for body in scene.linkage.bodies if body.slider), None)
    for slow, quick in (("forward", "back"), ("back", "forward")):
        if slider and f"takes longer {slow} than {quick}" in scene.look_at:
            rate = scene.cycle(SAMPLES, derivatives=1).travel_velocity[slider]
            forward = float(np.mean(rate > 0))
            assert (forward > 0.5) == (slow == "forward"), forward


def test_the_offset_slider_cranks_way_forward_is_the_shorter_one() -> None:
    scene = load("slider-crank")
    assert "takes longer back than forward" in scene.look_at
    rate = scene.cycle(SAMPLES, derivatives=1).travel_velocity["slider"]
    assert np.mean(rate > 0) == pytest.approx(0.480, abs=5e-4)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.sampled
def test_an_input_swings_as_far_as_it_is_said_to(name: str) -> None:
    scene = load(name)
    angle = scene.cycle(SAMPLES).coordinate
    low, high = scene.info.input_range
    if scene.info.full_turn:
        assert dict(scene.info.lines)["input"] == "turns fully"
        assert np.ptp(angle) > 2 * math.pi * (1 - 2 / SAMPLES)
    else:
        assert (angle.min(), angle.max()) == pytest.approx((low, high), abs=1e-5 * (high - low))


@pytest.mark.parametrize("name", NAMES)
def test_the_class_of_a_four_bar_is_that_of_its_motion(name: str) -> None:
    scene = load(name)
    own = scene.info.class_name
    if len([joint for joint in scene.linkage.joints if joint.dyad]) > 1:
        return
    turning = {
        words.rpartition(" ")[2]
        for words in map(scene.info.link_names.get, scene.info.turning_links)
        if words
    }
    if own == f"Grashof {GRASHOF['ground']}":
        assert turning == {"crank", "coupler"}
    elif own in (f"Grashof {GRASHOF['input']}", f"Grashof {GRASHOF['output']}"):
        assert turning == {"crank"}
    elif own == f"Grashof {GRASHOF['coupler']}":
        assert turning == {"coupler"}
    elif own in {f"triple-rocker ({sort})" for sort in TRIPLE_ROCKERS.values()}:
        assert not turning


# what is changed, what the title was and is then
@pytest.mark.parametrize(
    ("name", "changes", "title"),
    [
        # one that says its class goes with the class
        ("crank-rocker", {("four-bar", "crank"): 70.0}, "Triple-rocker (outward/outward)"),
        ("drag-link", {("four-bar", "ground"): 160.0}, "Triple-rocker (outward/outward)"),
        ("slider-crank", {("slider-crank", "offset"): 0.0}, "In-line slider-crank"),
        # one that is a name stays, and so does one that still holds
        ("hoecken", {("four-bar", "crank"): 200.0}, "Hoecken's straight line"),
        ("crank-rocker", {("four-bar", "crank"): 35.0}, "Crank-rocker"),
    ],
)
def test_a_title_that_says_the_class_goes_with_it(
    name: str, changes: dict[tuple[str | int, ...], float], title: str
) -> None:
    scene = load(name)
    edited = with_dimensions(scene, changes)
    assert edited.title == title
    before = {item.key: item.value for item in dimensions(scene)}
    assert edited.document["title"] == title
    assert with_dimensions(edited, {key: before[key] for key in changes}).title == scene.title


def test_the_other_closure_has_its_original_title() -> None:
    other = other_closure(load("parallelogram"))
    assert (other.title, other.info.class_name) == ("Antiparallelogram", "antiparallelogram")
    assert other_closure(other).title == "Parallelogram"


LINKS = {"ground": 100, "crank": 30, "coupler": 90, "rocker": 80}


def apart(document: dict[str, Any], ends: tuple[str, str]) -> tuple[float, float]:
    """Return the least and the greatest distance of two joints, of a scene without what joins them."""
    motion = scene_from(document, name="my", where="my").cycle(SAMPLES, derivatives=0)
    distance = np.abs((motion.position[ends[0]] - motion.position[ends[1]]) @ [1, 1j])
    return float(distance.min()), float(distance.max())


# bars on two joints that are too far from each other, or too near: on the crank, and down the chain
@pytest.mark.parametrize("ends", [("A", "O4"), ("B", "O6"), ("C", "A")])
@pytest.mark.parametrize("far", [True, False])
def test_bars_that_cannot_meet_are_told_how_far_their_ends_ever_are(ends: tuple[str, str], far: bool) -> None:
    document: dict[str, Any] = {
        "four-bar": LINKS,
        "ground": {"O6": [150, -20]},
        "joints": {"C": {"on": ["O4", "B"], "at": [90, 30]}},
    }
    least, most = apart(document, ends)
    lengths = [least / 4, least / 4] if far else [most * 3, most]
    dyad = {"T": {"from": list(ends), "length": lengths}}
    said = f"at least {least:.4g}" if far else f"at most {most:.4g}"
    needs = f"these bars reach {least / 2:.4g}" if far else f"these bars need {2 * most:.4g}"
    with pytest.raises(AssemblyError) as refused:
        scene_from({**document, "joints": document["joints"] | dyad}, name="my", where="my")
    told = re.search(r"–(\w+) is (at \w+) ([\d.]+) mm; (these bars \w+) ([\d.]+) mm$", str(refused.value))
    assert told is not None, refused.value
    assert f"{ends[0]}–{ends[1]}" in str(refused.value)
    assert f"{told[2]} {float(told[3]):.4g}" == said
    assert f"{told[4]} {float(told[5]):.4g}" == needs


# what a change of one length does to an input that turned fully, and what stops it then
@pytest.mark.parametrize(
    ("name", "key", "value", "cause"),
    [
        ("crank-rocker", ("four-bar", "crank"), 70.0, "s + l = 170 > p + q = 165: the crank"),
        # Grashof holds, and yet it is another link that turns.
        ("crank-rocker", ("four-bar", "rocker"), 20.0, "but the shortest is the driven link: the crank"),
        ("crank-rocker", ("four-bar", "coupler"), 30.0, "but the shortest is the coupler: the crank"),
        (
            "grashof-limit-six-bar",
            ("six-bar", "lengths", 7),
            30.0,
            "D cannot close all the way round: the crank",
        ),
    ],
)
def test_what_ends_a_full_turn_is_what_is_told(
    name: str, key: tuple[str | int, ...], value: float, cause: str
) -> None:
    before = load(name)
    after = with_dimensions(before, {key: value})
    refusal = loss_of_turning(before.info, after.info)
    assert refusal is not None
    assert cause in refusal
    for dyad in re.findall(r"(\w+) cannot close", refusal):
        # There its bars lie in one line: its transmission angle is nothing at a limit of the input.
        angles = [transmission_angle(after.solve(angle=limit), dyad) for limit in after.info.toggles]
        assert min(angles) == pytest.approx(0.0, abs=1e-6)
