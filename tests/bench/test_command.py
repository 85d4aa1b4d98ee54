"""`bench` as it is called: what is missing or wrong is said in a line before anything is measured."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Sequence
from pathlib import Path
from types import ModuleType, SimpleNamespace

import pytest
from made_result import result
from PIL import Image, ImageSequence

from linkanim.bench import again, command, drawing, extra, recording, scaling, window
from linkanim.bench import result as results
from linkanim.bench.cost import Cost, Memory, Work
from linkanim.bench.machine import this_machine
from linkanim.cli import main
from linkanim.errors import BadInput, WorkFailed
from linkanim.picture.overlay import Overlay
from linkanim.player.show import overlay
from linkanim.player.state import State
from linkanim.scenes import load


def options(*words: str) -> Namespace:
    parser = ArgumentParser()
    command.add_arguments(parser)
    return parser.parse_args(words)


@pytest.fixture
def measured(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the extra be there, and the result be one made by hand."""
    monkeypatch.setattr(extra, "NEEDED", ())
    monkeypatch.setattr(results, "run", lambda progress: result())


@pytest.mark.parametrize("missing", ["mpmath", "pylinkage", "numba", "scipy"])
def test_what_is_missing_is_named_with_the_way_to_get_it(missing: str) -> None:
    with pytest.raises(BadInput, match=rf'{missing}, which is not .*pip install "linkanim\[bench\]"'):
        extra.require_extra(lambda name: None if name == missing else object())


def test_all_that_is_missing_is_named_at_once() -> None:
    with pytest.raises(BadInput, match="numba, scipy, which are not installed"):
        extra.require_extra(lambda name: None if name in ("numba", "scipy") else object())


def test_without_the_extra_bench_ends_in_one_line(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(extra, "NEEDED", ("a_package_that_is_not_there",))
    assert main(["bench", "--into", str(tmp_path / "new")]) == 2
    told = capsys.readouterr()
    assert told.out == ""
    assert told.err.count("\n") == 1
    assert 'pip install "linkanim[bench]"' in told.err
    assert list(tmp_path.iterdir()) == []


# Where the chart cannot go, and what of it is said.
@pytest.mark.parametrize(
    ("into", "said"),
    [
        pytest.param("a-file", "is a file", id="a file"),
        pytest.param("not-there/new", "there is no folder", id="a folder in a missing one"),
    ],
)
def test_a_wrong_folder_is_refused(measured: None, tmp_path: Path, into: str, said: str) -> None:
    (tmp_path / "a-file").touch()
    with pytest.raises(BadInput, match=said):
        command.run(options("--into", str(tmp_path / into)))


@pytest.mark.parametrize("other", ["--draw", "--record", "--scaling"])
def test_markdown_is_for_the_table_only(other: str, monkeypatch: pytest.MonkeyPatch) -> None:
    for module in (window, recording, scaling):
        monkeypatch.setattr(module, "run", pytest.fail)
    with pytest.raises(BadInput, match="--markdown"):
        command.run(options("--markdown", other))


def test_it_prints_the_table_and_writes_the_chart(
    measured: None, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["bench", "--into", str(tmp_path / "new")]) == 0
    told = capsys.readouterr()
    assert told.out.startswith("A processor")
    assert told.err == f"{tmp_path / 'new' / command.CHART}\n"
    assert (tmp_path / "new" / command.CHART).stat().st_size > 5_000


def test_json_is_all_that_is_on_stdout(
    measured: None, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    command.run(options("--json", "--into", str(tmp_path)))
    assert set(json.loads(capsys.readouterr().out)) == {"machine", "rows", "targets"}


@pytest.fixture
def with_avx512(measured: None, monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, ...]]:
    """Let the machine have AVX-512, and the run without it be another made by hand; tell how it was asked."""
    asked: list[tuple[str, ...]] = []

    def printed(features: Sequence[str], form: Sequence[str]) -> str:
        asked.append((*features, *form))
        return "{}" if "--json" in form else "the run without it"

    monkeypatch.setattr(results, "run", lambda progress: result(("X86_V3", "X86_V4", "AVX512_ICL")))
    monkeypatch.setattr(again, "printed", printed)
    return asked


@pytest.mark.parametrize("form", [(), ("--markdown",), ("--json",)])
def test_a_machine_with_avx512_shows_the_run_without_it_too(
    form: tuple[str, ...],
    with_avx512: list[tuple[str, ...]],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    command.run(options(*form, "--into", str(tmp_path)))
    out = capsys.readouterr().out
    assert with_avx512 == [("X86_V4", "AVX512_ICL", *form)]
    if form == ("--json",):
        assert json.loads(out)["without_avx512"] == {}
    else:
        assert out.endswith("\n\nthe run without it\n")


def test_a_process_of_its_own_leaves_the_features_alone() -> None:
    asked = again.wide(this_machine().features)
    tell = "from linkanim.bench.machine import this_machine; print(*this_machine().features)"
    run = [sys.executable, "-W", "ignore", "-c", tell]
    left = subprocess.run(
        run, env=again.environment(asked), capture_output=True, text=True, check=True
    ).stdout
    assert again.wide(left.split()) == ()
    assert not set(asked) & set(left.split())


def test_a_run_without_it_that_fails_is_told_in_its_own_words() -> None:
    with pytest.raises(WorkFailed, match=r"^the benchmark without X86_V4: linkanim.*--no-such-form"):
        again.printed(("X86_V4",), ["--no-such-form"])


def test_the_machine_is_told() -> None:
    machine = this_machine()
    assert all(feature in machine.line for feature in machine.features)
    assert machine.cpu
    assert machine.cores == os.cpu_count()
    assert machine.line.startswith(f"{machine.cpu}, {machine.cores} cores, Python 3.")


def test_a_machine_has_a_core_where_the_system_does_not_count_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("os.cpu_count", lambda: None)
    assert this_machine().cores == 1


# The system's own word for the processor, and what is left where it has none.
@pytest.mark.parametrize(
    ("written", "name"),
    [
        pytest.param("vendor_id\t: one\nmodel name\t: A processor\n", "A processor", id="as Linux tells it"),
        pytest.param(None, "a machine", id="no such file"),
    ],
)
def test_the_processor_has_its_name(
    written: str | None, name: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    if written is not None:
        (tmp_path / "cpuinfo").write_text(written, encoding="utf-8")
    monkeypatch.setattr("linkanim.bench.machine.Path", lambda _: tmp_path / "cpuinfo")
    monkeypatch.setattr("platform.processor", lambda: "")
    monkeypatch.setattr("platform.machine", lambda: "a machine")
    assert this_machine().cpu == name


def test_frames_of_the_press_with_all_that_is_said_are_drawn_and_timed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    seen: list[State] = []

    def watched(state: State) -> Overlay:
        seen.append(state)
        return overlay(state)

    monkeypatch.setattr(window, "overlay", watched)
    found = window.measured((320, 180), frames=3)
    assert found.size == (320, 180)
    assert 0 < found.milliseconds <= found.slowest + 1e-9
    assert found.core > 0
    assert [state.frame for state in seen] == [0, 1, 2, 3]
    ((scene, look),) = {(state.scene.name, state.look) for state in seen}
    assert (scene, look.trace, look.hud) == ("press", True, True)
    # With their dimensions, with velocities and accelerations.
    assert (look.names, look.vectors, look.chart) == (2, frozenset("va"), "C.acceleration")


def test_a_frame_s_figures_are_what_the_clocks_tell(monkeypatch: pytest.MonkeyPatch) -> None:
    walls = iter([100.0, 100.009, 200.0, 200.001, 300.0, 300.003, 400.0, 400.002, 500.0, 500.004])
    used = iter([7.0, 7.001, 8.0, 8.002, 9.0, 9.002, 10.0, 10.002, 11.0, 11.005])
    clocks = SimpleNamespace(perf_counter=lambda: next(walls), process_time=lambda: next(used))
    monkeypatch.setattr(window, "time", clocks)
    found = window.measured((320, 180), frames=5)
    assert (found.milliseconds, found.slowest, found.processor) == pytest.approx((3.0, 4.0, 2.0))
    assert found.core == pytest.approx(0.12)


@pytest.mark.parametrize("driver", [None, "x11"])
def test_drawing_is_measured_without_a_window_and_the_driver_is_put_back(
    driver: str | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    drivers: list[str | None] = []

    def measured(size: tuple[int, int]) -> window.FrameTimes:
        drivers.append(os.environ.get("SDL_VIDEODRIVER"))
        return window.FrameTimes(size, 5.0, 7.0, 5.0)

    monkeypatch.setattr(window, "measured", measured)
    monkeypatch.setattr(window, "frame_decibels", lambda scene: 51.0 if scene.name == "press" else 0.0)
    monkeypatch.setattr(window, "jitter", lambda: 0.002)
    monkeypatch.setattr(window, "first_frame", lambda: 0.25)
    monkeypatch.delenv("SDL_VIDEODRIVER", raising=False)
    if driver is not None:
        monkeypatch.setenv("SDL_VIDEODRIVER", driver)
    found = window.run()
    assert drivers == ["dummy", "dummy"]
    assert os.environ.get("SDL_VIDEODRIVER") == driver
    assert [frames.size for frames in found.frames] == [(1280, 720), (1920, 1080)]
    assert (found.first, found.decibels, found.jitter) == (0.25, 51.0, 0.002)


def test_the_start_that_compiles_does_not_count(monkeypatch: pytest.MonkeyPatch) -> None:
    starts = iter([9.0, 1.0, 2.0, 1.0])
    monkeypatch.setattr(window, "_started", lambda compiled: next(starts))
    assert window.first_frame(starts=3) == 1.0


@pytest.mark.parametrize(
    ("program", "said"), [("raise SystemExit('no screen')", "no screen"), ("pass", "it drew nothing")]
)
def test_a_window_that_does_not_start_says_why(
    program: str, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(window, "TELL_FIRST", program)
    with pytest.raises(WorkFailed, match=f"the window did not start: {said}"):
        window.first_frame(starts=1)


def test_the_first_frame_s_time_is_that_since_the_start(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(window, "TELL_FIRST", "print('a greeting'); print(12.5)")
    monkeypatch.setattr(window, "time", SimpleNamespace(time=lambda: 10.0))
    assert window.first_frame(starts=1) == 2.5


def test_the_first_frame_comes_from_the_command_itself() -> None:
    assert window.first_frame(starts=1) > 0


def drawn() -> window.WindowRun:
    frames = tuple(window.FrameTimes(size, 5.25, 7.0, 5.0) for size in window.SIZES)
    return window.WindowRun(this_machine(), frames, 0.25, 51.3, 0.002)


def test_the_figures_of_drawing_stand_beside_their_bounds() -> None:
    found = drawn()
    lines = {line.split()[0]: line.split() for line in window.as_text(found).splitlines() if line}
    assert lines["1280x720"][1:5] == ["5.2", "ms", "≤", "6"]
    assert lines["1920x1080"][1:5] == ["5.2", "ms", "≤", "10"]
    assert lines["1280x720"][-2:] == ["30", "%"]
    assert lines["first"][-5:] == ["0.25", "s", "≤", "0.4", "s"]
    assert lines["worst"][-5:] == ["51.3", "dB", "≥", "44", "dB"]
    assert lines["a"][-5:] == ["0.0020", "px", "≤", "0.1", "px"]
    told = json.loads(json.dumps(window.as_object(found)))
    assert [frames["most_ms"] for frames in told["frames"]] == [6.0, 10.0]
    assert (told["first_frame_s"], told["most_first_frame_s"]) == (0.25, 0.4)
    assert (told["dB_against_64_samples"], told["least_dB"]) == (51.3, 44.0)
    assert (told["slow_bar_px_rms"], told["most_px_rms"]) == (0.002, 0.1)


def recorded() -> recording.Recordings:
    cost = Cost("gif", 300, 3.0, 1.5, 2.14, 60.9, Memory(104.0, math.inf), Work(2.5, 1.25))
    return recording.Recordings(this_machine(), (cost,), 27.0)


# Each of the other ways to ask: what stands in its text, and what its object holds.
@pytest.mark.parametrize(
    ("word", "module", "made", "title", "holds"),
    [
        pytest.param("--draw", window, drawn, window.TITLES[0], "first_frame_s", id="draw"),
        pytest.param("--record", recording, recorded, recording.TITLES[0], "recordings", id="record"),
    ],
)
def test_each_way_to_ask_prints_its_table_or_its_object(
    word: str,
    module: ModuleType,
    made: Callable[[], object],
    title: str,
    holds: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr(module, "run", made)
    assert main(["bench", word]) == 0
    text = capsys.readouterr().out
    assert text.startswith(this_machine().line)
    assert f"\n{title}  " in text
    assert main(["bench", word, "--json"]) == 0
    text = capsys.readouterr().out
    assert text.startswith('{\n  "')
    assert holds in json.loads(text, parse_constant=pytest.fail)


def test_the_figures_of_recordings_are_the_recorders() -> None:
    costs = {
        "gif": Cost("gif", 300, 3.0, 1.5, 2.14, 60.9, Memory(104.0, 104.0), Work(2.5, 1.25)),
        "mp4": Cost(
            "mp4", 300, 4.0, 2.0, 0.4, float("inf"), Memory(100.0, float("nan")), Work(2.0, float("nan"))
        ),
    }
    asked = []

    def measure(name: str, form: str, *, frames: int) -> Cost:
        asked.append((name, form, frames))
        return costs[form]

    found = recording.run(measure, frames=300, animate=lambda name, **_: 27.0 if name == "press" else None)
    assert asked == [("press", "gif", 300), ("press", "mp4", 300)]
    text = recording.as_text(found)
    assert "2.00 ×" in text
    assert "60.9 dB" in text
    assert "104 + 104 MB" in text
    assert "2.5 + 1.2 s" in text
    gif, mp4 = recording.as_object(found)["recordings"]
    assert (gif["ratio"], mp4["dB"], mp4["peak_MB"]["encoding"]) == (2.0, None, None)
    assert (gif["processor_s"], mp4["processor_s"]["encoding"]) == ({"drawing": 2.5, "encoding": 1.25}, None)
    assert "27.0 s, 9.0 times as long" in text
    assert recording.as_object(found)["times_as_long"] == 9.0


def test_recordings_are_measured_without_matplotlib_too_and_say_what_is_missing() -> None:
    cost = Cost("gif", 300, 3.0, 1.5, 2.14, 60.9, Memory(104.0, 104.0), Work(2.5, 1.25))
    found = recording.run(lambda *_, **__: cost, frames=300, animate=lambda *_, **__: None)
    assert "matplotlib is not installed" in recording.as_text(found)
    assert recording.as_object(found)["times_as_long"] is None


def test_matplotlib_animates_what_a_scene_holds(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib", reason="only the bench extra has it")
    from linkanim.bench.animation import animate

    animate(load("press"), tmp_path / "out.gif", size=(320, 180), frames=4, fps=25.0)
    with Image.open(tmp_path / "out.gif") as made:
        assert (len(list(ImageSequence.Iterator(made))), made.size) == (4, (320, 180))


def test_the_chart_has_the_name_that_is_promised() -> None:
    assert command.CHART == "speed-vs-error.png"
    assert drawing.SIZE[0] == 1280
