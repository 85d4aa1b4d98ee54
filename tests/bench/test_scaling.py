"""What a pose costs as work grows: the tables, their chart, and the memory that a run takes."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from made_result import result
from numpy.typing import NDArray
from test_command import options

from linkanim.bench import command, scaling
from linkanim.bench.entries import Timed
from linkanim.bench.machine import this_machine
from linkanim.errors import BadInput
from linkanim.mechanics.linkage import Linkage
from linkanim.mechanics.mechanism import Mechanism, mechanism
from linkanim.mechanics.program import BLOCK

MADE = scaling.Growth(
    result().machine,
    (scaling.Sized(100, 300.0, 500.0, 3000.0, 10_000), scaling.Sized(10_000, 14.2, 27.1, 46.0, 270_000)),
    (scaling.Chained(1, 14.2, 27.1), scaling.Chained(50, 420.0, 1_800.4)),
    (scaling.KindTimes("four-bar", 14.0, 27.0, 1_500.0, 2_500.0, 1.0),),
)


def test_each_table_has_its_lines() -> None:
    lines = [line.split() for line in scaling.as_text(MADE).splitlines()]
    assert ["10,000", "14.2", "27.1", "46.0", "0.27", "MB"] in lines
    assert ["50", "420.0", "1,800.4"] in lines
    assert ["four-bar", "14.0", "27.0", "1,500.0", "2,500.0", "1.00"] in lines


def test_json_has_the_same_figures() -> None:
    told = json.loads(json.dumps(scaling.as_object(MADE)))
    assert set(told) == {"machine", "poses", "dyads", "kinds"}
    assert told["poses"][1] == {
        "poses": 10_000,
        "position_ns": 14.2,
        "derivatives_ns": 27.1,
        "first_ns": 46.0,
        "extra_bytes": 270_000,
    }
    assert told["kinds"][0]["pose_derivatives_ns"] == 2_500.0


def test_the_command_prints_and_draws_it(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(scaling, "run", lambda progress: MADE)
    command.run(options("--scaling", "--into", str(tmp_path)))
    told = capsys.readouterr()
    assert told.out.startswith("A processor")
    assert told.err == f"{tmp_path / command.GROWTH}\n"
    assert (tmp_path / command.GROWTH).stat().st_size > 5_000
    command.run(options("--scaling", "--json", "--into", str(tmp_path)))
    assert json.loads(capsys.readouterr().out)["dyads"][0]["dyads"] == 1


def test_the_readme_s_tables_have_its_sizes() -> None:
    readme = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
    chained = f"dyads in a chain, {scaling.AT_ONCE:,} poses at once"
    for title, sizes in (("poses at once", scaling.COUNTS), (chained, scaling.DYADS)):
        lines = readme.partition(f"| {title}")[2].partition("\n\n")[0].splitlines()[2:]
        assert [line.split()[1] for line in lines] == [f"{size:,}" for size in sizes]


def test_the_last_point_of_each_course_has_its_name() -> None:
    longest = scaling.Chained(100, 800.0, 4_000.0)
    poses, dyads = scaling.pictures(MADE._replace(dyads=(*MADE.dyads, longest)))
    assert poses.points == [
        ("", 100, 300.0, True),
        ("positions", 10_000, 14.2, True),
        ("", 100, 500.0, False),
        ("with derivatives", 10_000, 27.1, False),
    ]
    assert [point.label for point in dyads.points] == ["", "", "positions", "", "", "with derivatives"]


# Worked out when first read: without the reading there would be nothing to time.
@pytest.mark.parametrize(("derivatives", "read"), [(0, "position"), (2, "acceleration")])
def test_what_is_timed_is_worked_out(derivatives: int, read: str, monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[str] = []

    class Told:
        def __getattr__(self, name: str) -> None:
            seen.append(name)

    monkeypatch.setattr(Mechanism, "solve", lambda self, **asked: Told())
    scaling._at_once(mechanism(scaling.yoke()), np.zeros(3), derivatives).work()
    assert seen == [read]


def test_the_first_run_of_a_size_is_timed_once_all_else_is_ready(monkeypatch: pytest.MonkeyPatch) -> None:
    done: list[tuple[int, int]] = []
    clock = iter([1.0, 1.000_01, 2.0, 2.000_02])

    def at_once(_: Mechanism, angles: NDArray[np.float64], derivatives: int) -> Timed:
        return Timed(lambda: done.append((angles.size, derivatives)), angles.size)

    monkeypatch.setattr(scaling, "_at_once", at_once)
    monkeypatch.setattr(scaling, "time", SimpleNamespace(perf_counter=lambda: next(clock)))
    monkeypatch.setattr(scaling, "nanoseconds", lambda work, **_: {key: sum(key) for key in work})
    found = [row[:4] for row in scaling.sizes((50, 500))]
    # The second time for the memory that it takes.
    assert done == [(1, 0), (1, 2), (50, 2), (500, 2), (50, 2), (500, 2)]
    assert found == [pytest.approx((50, 50, 52, 200.0)), pytest.approx((500, 500, 502, 40.0))]


def test_what_is_asked_at_once_is_one_turn() -> None:
    assert scaling._turn(4) == pytest.approx([0.0, np.pi / 2, np.pi, 3 * np.pi / 2])


@pytest.mark.parametrize("derivatives", [0, 2])
def test_one_pose_a_call_is_timed_at_a_steady_speed(
    derivatives: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[tuple[float, ...]] = []
    monkeypatch.setattr(Mechanism, "pose", lambda self, *given: asked.append(given))
    timed = scaling._one_by_one(mechanism(scaling.yoke()), derivatives)
    timed.work()
    assert len(asked) == timed.poses == 720
    assert asked == [(phase, 1.0, 0.0, derivatives) for phase in scaling._turn(720)]


def test_markdown_is_not_for_it() -> None:
    with pytest.raises(BadInput, match="--scaling"):
        command.run(options("--scaling", "--markdown"))


def test_everything_is_measured() -> None:
    few = {"rounds": 1, "budget": 0.0}
    sizes = list(scaling.sizes((50, 500), **few))
    chains = list(scaling.chains((1, 2), **few))
    kinds = scaling.kinds(**few)
    assert [row.poses for row in sizes] == [50, 500]
    assert [row.dyads for row in chains] == [1, 2]
    assert [kind.name for kind in kinds] == ["four-bar", "Scotch yoke", "slider on a moving line"]
    assert all(value > 0 for row in (*sizes, *chains) for value in row)
    assert kinds[0].times == 1.0
    scaling.Growth(this_machine(), tuple(sizes), tuple(chains), kinds)


@pytest.mark.parametrize("dyads", [1, 3, 50])
def test_a_chain_turns_fully_and_its_rockers_swing_alike(dyads: int) -> None:
    linkage = scaling.chain(dyads)
    made = mechanism(linkage)
    # Besides each dyad's pin and its joint: the crank's pin and the crank.
    assert len(linkage.joints) == 2 * dyads + 2
    assert made.assembly.path.full_turn
    position = made.solve(angle=np.linspace(0.0, 6.0, 7), speed=1.0).position
    apart = position[f"B{dyads}"] - position["B1"]
    assert apart == pytest.approx(np.tile([100.0 * (dyads - 1), 0.0], (7, 1)), abs=1e-9)


@pytest.mark.parametrize("linkage", [scaling.yoke(), scaling.moving_line()])
def test_the_kinds_turn_fully_and_close(linkage: Linkage) -> None:
    made = mechanism(linkage)
    assert made.assembly.path.full_turn
    for values in made.solve(angle=np.linspace(0.0, 6.2, 9), speed=1.0).acceleration.values():
        assert np.isfinite(values).all()


@pytest.mark.parametrize("derivatives", [0, 2])
def test_memory_beside_the_motion_does_not_grow_with_the_poses(derivatives: int) -> None:
    solved = mechanism(scaling.chain(1))
    extra = {}
    for count in (1, 2 * BLOCK, 16 * BLOCK):
        work = scaling._at_once(solved, np.linspace(0.0, 9.0, count), derivatives).work
        extra[count] = scaling.extra_bytes(work)
    # Buffers of one block, of which a few are in use at a time, and Python's own objects.
    assert extra[16 * BLOCK] <= extra[2 * BLOCK] + 50_000
    assert extra[16 * BLOCK] <= 4 * 8 * BLOCK
