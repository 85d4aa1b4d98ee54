"""Time grows with the number of joints, not with its square: counted, not timed."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from types import FrameType

import pytest
from generated import SHAPES, geared, series

from linkanim.errors import AssemblyError
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import parse

FEW, MANY = 5, 20
LINEAR = 1.3 * MANY / FEW
"""What four times the joints may take, a third more than four times as much."""


def scene_of(text: str) -> Scene:
    return scene_from(parse(text, "generated"), name="generated", where="generated")


def facts(text: str) -> object:
    return scene_of(text).info.lines


def named(scene: Scene) -> Picture:
    return Picture(scene, (1280, 720), Look(names=2))


def arrowed(scene: Scene) -> Picture:
    return Picture(scene, (1280, 720), Look(vectors=frozenset({"v", "a"})), moment=0.7)


def drawn(picture: Picture) -> object:
    return [*picture.groups(picture.scene.pose(0.7, 2))]


def calls(work: Callable[[], object]) -> int:
    """Count the calls of functions while something is done."""
    count = 0

    def counted(frame: FrameType, event: str, argument: object) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    before = sys.getprofile()
    sys.setprofile(counted)
    try:
        work()
    finally:
        sys.setprofile(before)
    return count


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.slow
def test_what_is_said_of_a_linkage_takes_as_many_more_calls_as_it_has_more_joints(shape: str) -> None:
    few, many = (calls(partial(facts, SHAPES[shape](dyads))) for dyads in (FEW, MANY))
    assert many <= LINEAR * few


@pytest.mark.slow
def test_placing_names_takes_as_many_more_calls_as_there_are_more_joints() -> None:
    few, many = (calls(partial(named, scene_of(series(dyads)))) for dyads in (FEW // 2, MANY // 2))
    assert many <= LINEAR * few


@pytest.mark.slow
def test_a_frame_with_names_at_arrows_takes_as_many_more_calls_as_there_are_more_joints() -> None:
    few, many = (calls(partial(drawn, arrowed(scene_of(series(dyads))))) for dyads in (3 * FEW, 3 * MANY))
    assert many <= LINEAR * few


def test_gears_that_bring_everything_back_too_late_are_refused_by_name() -> None:
    with pytest.raises(AssemblyError) as refused:
        facts(geared(7, 11, 9, 8, 5))
    for part in ("D0 (1/7), D1 (1/11), D2 (1/9), D3 (1/8), D4 (1/5)", "27,720 turns", "1,000 are"):
        assert part in str(refused.value)


def test_any_two_gears_and_the_longest_of_three_are_taken() -> None:
    assert scene_of(geared(12, 11)).info.true_period == 132
    assert scene_of(geared(9, 10, 11)).info.true_period == 990
