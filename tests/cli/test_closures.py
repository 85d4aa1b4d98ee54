"""`linkanim closures`: all closures, each once, with what they have in common."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import imageio.v3 as iio
import pytest
from test_groups import OTHER_CLOSURES, STEPHENSON_III

from linkanim.cli import main
from linkanim.scenes import load
from linkanim.scenes.closures import closures
from linkanim.scenes.reading import scene_from


def told(capsys: pytest.CaptureFixture[str], *words: str) -> Any:
    assert main(["closures", *words, "--json"]) == 0
    return json.loads(capsys.readouterr().out)


# name, how many there are at the start, and how many motions these are
COUNTED = [
    ("crank-rocker", 2, 2),
    ("double-rocker", 2, 1),
    ("press", 4, 4),
    ("engine", 2, 2),
    ("klann", 2, 2),
]


@pytest.mark.parametrize(("name", "count", "motions"), COUNTED)
def test_each_closure_is_told_once(
    capsys: pytest.CaptureFixture[str], name: str, count: int, motions: int
) -> None:
    found = told(capsys, name)
    assert len(found) == count
    assert sum(one["same_as"] is None for one in found) == motions
    assert len({json.dumps(one["joints"]) for one in found}) == count
    own = load(name)
    assert found[0]["input_range"] == list(own.info.input_range)
    assert found[0]["class"] == own.info.class_name


def test_all_four_closures_of_a_stephenson_linkage_are_found_at_its_last_link() -> None:
    scene = scene_from({"length_unit": "mm", **STEPHENSON_III}, name="my", where="my.toml")
    found = closures(scene)
    assert len(found) == 4
    for true in OTHER_CLOSURES:
        b, c = (complex(*true[name]) for name in "BC")
        assert sum(abs(one.places["B"] - b) + abs(one.places["C"] - c) < 1e-10 for one in found) == 1


@pytest.mark.parametrize("name", ["out.png", "out.gif"])
def test_they_are_drawn_beside_each_other(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    assert main(["closures", "crank-rocker", "-o", str(path)]) == 0
    pictures = iio.imread(path, index=None) if name.endswith("gif") else [iio.imread(path)]
    assert len(pictures) == (32 if name.endswith("gif") else 1)
    assert pictures[0].shape[1] > 2 * 400
