"""All closures of a scene: each once, in every range, with the curves that they trace."""

from __future__ import annotations

import json
import math
import tomllib
from pathlib import Path
from typing import Any

import pytest
from PIL import Image
from published import STEPHENSON

from linkanim.cli import main
from linkanim.errors import BadInput
from linkanim.scenes import load
from linkanim.scenes.closures import MOST_DYADS, closures
from linkanim.scenes.reading import scene_from

# scene, how many closures, how many of them turn fully, the curves that they trace
KNOWN: dict[str, tuple[int, int, list[int]]] = {
    # a rocker's two closures never meet
    "crank-rocker": (2, 2, [1, 2]),
    "slider-crank": (2, 2, [1, 2]),
    # open and crossed are one motion, through the limits; there are two ranges, as mirror images
    "double-rocker": (2, 0, [1, 2]),
    # the ram does not change the curve that is traced
    "press": (4, 4, [1, 1, 3, 3]),
    # on its other first closure the second dyad stops the crank: both of its sides are one swing
    "klann": (3, 2, [1, 2, 3]),
}


@pytest.mark.parametrize("name", KNOWN)
def test_each_closure_is_found_once(name: str) -> None:
    count, turning, curves = KNOWN[name]
    found = closures(load(name))
    assert found[0].scene.document == load(name).document
    assert len(found) == count
    assert sum(one.scene.info.full_turn for one in found) == turning
    assert [one.curve for one in found] == curves


@pytest.mark.parametrize("name", ["crank-rocker", "klann", "press"])
def test_closures_have_the_same_lengths(name: str) -> None:
    own, *others = closures(load(name))
    bars = [(one.name, length, end) for one in load(name).linkage.joints for end, length in one.bars]
    for closure in (own, *others):
        for joint, length, end in bars:
            assert math.dist(closure.pose[joint], closure.pose[end]) == pytest.approx(length, rel=1e-12)


OF_STEPHENSON: list[dict[str, tuple[float, float]]] = [
    {"B": (5, 16), "C": (25, 25), "E": (18, 35)},
    {
        "B": (13.704776472907, -6.151156212391),
        "C": (34.652378084191, 0.344841535062),
        "E": (28.923007006968, 11.123260113846),
    },
    {
        "B": (15.535674609931, 12.668463471307),
        "C": (31.101930568661, -2.781186214925),
        "E": (37.931338197648, 7.336085721577),
    },
]


@pytest.mark.slow
def test_links_that_are_solved_together_have_the_closures_that_are_published() -> None:
    found = closures(scene_from(tomllib.loads(STEPHENSON), name="stephenson", where="stephenson"))
    assert len(found) == 4
    for wanted in OF_STEPHENSON:
        off = [max(math.dist(one.pose[name], place) for name, place in wanted.items()) for one in found]
        assert min(off) < 1e-11


def test_more_dyads_than_can_be_tried_are_refused() -> None:
    joints: dict[str, Any] = {"A0": {"crank": "O", "length": 1}}
    ground = {"O": [0, 0]}
    for n in range(MOST_DYADS + 1):
        ground[f"G{n}"] = [3 + n, 0]
        joints[f"A{n + 1}"] = {"from": [f"A{n}", f"G{n}"], "length": [4, 4]}
    scene = scene_from({"ground": ground, "joints": joints}, name="chain", where="chain")
    with pytest.raises(BadInput, match="11 dyads can be put together in 2,048 ways; 1,024 are the most"):
        closures(scene)


@pytest.mark.slow
def test_the_command_lists_writes_and_draws_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["closures", "crank-rocker"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert ["open" in lines[1], "crossed" in lines[2], len(lines)] == [True, True, 3]
    assert main(["closures", "double-rocker", "--json"]) == 0
    ranges = [one["input_range"] for one in json.loads(capsys.readouterr().out)]
    assert ranges[0] == pytest.approx([-end for end in reversed(ranges[1])])
    assert main(["closures", "crank-rocker", "-o", "c.toml"]) == 0
    assert main(["info", "c-2.toml"]) == 0
    assert load("c-2.toml").document["four-bar"]["assembly"] == "crossed"
    assert main(["closures", "crank-rocker", "-o", "c.gif"]) == 0
    with Image.open("c.gif") as picture:
        assert picture.info["loop"] == 0
        assert getattr(picture, "n_frames", 1) == 60
    assert main(["closures", "crank-rocker", "-o", "c.png"]) == 0
    with Image.open("c.png") as picture, Image.open("c.gif") as running:
        assert picture.size == running.size  # both number the closures as the table does
    assert main(["closures", "crank-rocker", "-o", "c.svg"]) == 2
    assert main(["closures", "no-such-scene"]) == 2


@pytest.mark.slow
def test_a_file_of_points_is_put_together_in_other_poses(tmp_path: Path) -> None:
    path = tmp_path / "s.toml"
    path.write_text(STEPHENSON, encoding="utf-8")
    found = closures(load(str(path)))
    assert all(one.scene.document["points"]["G"] == [45, 17] for one in found)
    assert len({tuple(one.scene.document["points"]["B"]) for one in found}) == len(found)
