"""A linkage and its mirror image, geared to its crank, move as one."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import linkanim
from linkanim.cli import main
from linkanim.errors import BadInput
from linkanim.mechanics.measures import as_complex
from linkanim.picture.text import subscripted
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import parse, text
from linkanim.synthesis.pairs import Mirror, with_image

ARC = [(0, 0), (20, 8), (40, 12), (60, 12), (80, 8), (100, 0)]
POSES = np.array([[0, 0, 0], [30, 20, 25], [50, 60, 60]]) * [1, 1, math.pi / 180]


def check(scene: Scene, line: str) -> None:
    """Check that a saved scene's primed joints are the others' images at all phases."""
    scene = scene_from(parse(text(scene), "saved"), name="saved", where="saved")
    motion = scene.cycle(240, derivatives=1)
    at = float(line[2:])
    for name in [name for name in motion.position if not name.endswith("'")]:
        own, its = (as_complex(motion.position[one]) for one in (name, f"{name}'"))
        image = 2 * at - own.conj() if line[0] == "x" else own.conj() + 2j * at
        assert its == pytest.approx(image, abs=1e-9)
    moving = motion.velocity["P"]
    assert np.hypot(*motion.velocity["P'"].T) == pytest.approx(np.hypot(*moving.T), abs=1e-8)
    assert "gears" in scene.info.class_name
    assert scene.trace == ("P", "P'")


@pytest.mark.parametrize("kind", ["four-bar", "slider-crank"])
@pytest.mark.parametrize("line", ["x=130", "y=-40.5"])
@pytest.mark.parametrize("driver", [False, True])
def test_the_image_of_an_answer_stays_its_image(kind: str, line: str, driver: bool) -> None:
    found = linkanim.guide(POSES, kind=kind, driver=driver, mirror=line, count=3)
    assert found
    for one in found:
        check(one.scene, line)
        assert all(one.scene.info.full_turn or one.defects or not driver for one in found)


@pytest.mark.slow
def test_a_finger_s_path_has_its_image() -> None:
    for fit in linkanim.path(ARC, False, mirror="x=130", count=2, prefer="exact"):
        check(fit.scene, "x=130")


@pytest.mark.parametrize("line", ["40", "z=3", "x=", "x=nan", "x=1e300", "y=1,5"])
def test_a_mirror_is_a_line(line: str) -> None:
    with pytest.raises(BadInput, match='give a line such as "x=40" or "y=0"'):
        linkanim.guide(POSES, mirror=line)


def test_gears_need_two_places() -> None:
    one = linkanim.guide(POSES, count=1)[0]
    with pytest.raises(BadInput, match="its crank turns about a point of the mirror's line"):
        with_image(one.scene, Mirror(f"x={one.parameters['x']!r}"))


# Pairs of four-bars have seven links, no five: a dyad between two geared cranks makes a five-bar.
@pytest.mark.parametrize(
    ("kind", "words"),
    [("four-bar", "seven-bar linkage with gears"), ("slider-crank", "with gears and slider")],
)
def test_a_pair_is_named_by_its_links(kind: str, words: str) -> None:
    options: dict[str, Any] = {"kind": kind, "mirror": "x=300", "count": 1}
    assert words in linkanim.guide(POSES, **options)[0].class_name


def test_names_of_the_image_are_set_as_the_others_are(tmp_path: Path) -> None:
    assert subscripted("O2'") == "O₂'"
    one = linkanim.guide(POSES, mirror="x=300", count=1)[0]
    (tmp_path / "pair.toml").write_text(text(one.scene), encoding="utf-8")
    assert main(["explain", str(tmp_path / "pair.toml"), "-o", str(tmp_path / "pair.html")]) == 0
    page = (tmp_path / "pair.html").read_text(encoding="utf-8")
    assert "O<sub>4</sub>&#x27;" in page
