"""What a recording costs."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from linkanim.bench import cost as costs
from linkanim.bench.cost import FRAMES, SIZE, Cost, Memory, Work, cost
from linkanim.bench.process import printed_by
from linkanim.errors import WorkFailed
from linkanim.recorder.encode import Stream
from linkanim.recorder.plan import Format, Plan
from linkanim.scenes import load


@pytest.mark.parametrize(("form", "least"), [("gif", 50.0), ("mp4", 35.0)])
def test_the_cost_of_a_recording_is_measured(form: Format, least: float) -> None:
    found = cost("slider-crank", form, frames=8)
    assert (found.form, found.frames) == (form, 8)
    assert least < found.decibels < 100
    assert 0.001 < found.megabytes < 1
    assert found.seconds > 0
    assert found.encode_seconds > 0
    assert all(0.01 < spent < 100 for spent in found.work if not math.isnan(spent))
    assert all(20 < megabytes < 1000 for megabytes in found.memory if not math.isnan(megabytes))


def test_a_cost_has_the_figures_of_its_parts(monkeypatch: pytest.MonkeyPatch) -> None:
    done: list[str] = []
    times = iter([(2.0, Work(1.0, 0.5)), (3.0, Work(2.5, 1.25))])

    def timed(work: Callable[[], object]) -> tuple[float, Work]:
        work()
        return next(times)

    def write(_: object, plan: Plan, target: Path) -> None:
        done.append(f"{plan.frames} frames written")
        target.write_bytes(bytes(2_500_000))

    monkeypatch.setattr(costs, "peak_memory", lambda *asked, frames: Memory(104.0, float(frames)))
    monkeypatch.setattr(costs, "_stored", lambda *_: np.zeros((8, 4), np.uint8))
    monkeypatch.setattr(costs, "_encode", lambda *_: done.append("encoded"))
    monkeypatch.setattr(costs, "_timed", timed)
    monkeypatch.setattr(costs, "write", write)
    monkeypatch.setattr(costs, "_decibels", lambda shown, stored: 60.0 + len(stored))
    found = cost("slider-crank", "gif", frames=8)
    assert found == Cost("gif", 8, 3.0, 2.0, 2.5, 68.0, Memory(104.0, 8.0), Work(2.5, 1.25))
    assert found.ratio == 1.5
    assert done == ["encoded", "8 frames written"]


def test_a_recording_that_fails_in_a_process_of_its_own_says_why() -> None:
    with pytest.raises(WorkFailed, match=r"^the GIF whose memory is measured: .*no-such-scene"):
        costs.peak_memory("no-such-scene", "gif", frames=3)


# Its last line is the reason; where it says nothing, what is left is how it ended.
@pytest.mark.parametrize(
    ("program", "said"),
    [
        pytest.param("import sys; print('one', file=sys.stderr); sys.exit('two')", "two", id="in two lines"),
        pytest.param("raise SystemExit(3)", "it ended with 3", id="in no word"),
    ],
)
def test_a_process_that_fails_is_told_of_in_one_line(program: str, said: str) -> None:
    with pytest.raises(WorkFailed, match=f"^the work: {said}$"):
        printed_by([sys.executable, "-c", program], "the work")


def test_the_readme_tells_of_so_many_frames_of_such_a_size() -> None:
    readme = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
    width, height = SIZE
    assert f"of the press, {FRAMES} frames at {width}×{height}" in " ".join(readme.split())


@pytest.mark.parametrize("form", ["gif", "mp4"])
def test_all_frames_are_encoded_in_their_format(form: Format, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[tuple[Stream, Format, Path]] = []
    sent: list[bytes] = []

    @contextmanager
    def encoding(stream: Stream, form: Format, target: Path, _: object) -> Iterator[Callable[..., None]]:
        asked.append((stream, form, target))
        yield lambda frame: sent.append(bytes(frame))

    monkeypatch.setattr(costs, "encoding", encoding)
    scene, target = load("slider-crank"), Path(f"out.{form}")
    plan = costs._plan(scene, form, 3)
    costs._encode(np.arange(6, dtype=np.uint8).reshape(3, 2), scene, plan, target)
    assert asked == [(Stream(SIZE, plan.rate), form, target)]
    assert sent == [b"\x00\x01", b"\x02\x03", b"\x04\x05"]


# Of this process and of those it started, each by itself and by the system for it; none told is not known.
@pytest.mark.parametrize(("started", "told"), [((0.5, 0.75), 1.25), ((0.0, 0.0), None)])
def test_processor_time_is_what_was_added(
    started: tuple[float, float], told: float | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    spent = iter([(10.0, 20.0, 30.0, 40.0, 50.0), (11.0, 22.0, 30.0 + started[0], 40.0 + started[1], 90.0)])
    clock = iter([100.0, 104.0])
    monkeypatch.setattr(costs, "os", SimpleNamespace(times=lambda: next(spent)))
    monkeypatch.setattr(costs, "time", SimpleNamespace(perf_counter=lambda: next(clock)))
    done: list[str] = []
    seconds, work = costs._timed(lambda: done.append("once"))
    assert (seconds, done) == (4.0, ["once"])
    assert work == (Work(3.0, told) if told else (3.0, pytest.approx(math.nan, nan_ok=True)))


# Linux's word for the largest memory so far, and what is known where it has none.
@pytest.mark.parametrize(
    ("status", "megabytes"),
    [
        pytest.param("VmPeak:\t  300000 kB\nVmHWM:\t  104500 kB\n", 104.5, id="as Linux tells it"),
        pytest.param("Name:\tlinkanim\n", None, id="nothing of it"),
        pytest.param(None, None, id="no such file"),
    ],
)
def test_a_process_has_its_largest_memory(
    status: str | None, megabytes: float | None, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    if status is not None:
        (tmp_path / "proc-self-status").write_text(status, encoding="utf-8")
    monkeypatch.setattr(costs, "Path", lambda path: tmp_path / path.strip("/").replace("/", "-"))
    found = costs._peak("self")
    assert math.isnan(found) if megabytes is None else found == megabytes
