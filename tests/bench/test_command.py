"""`bench` as it is called: what is missing or wrong is said in a line before anything is measured."""

from __future__ import annotations

import json
import os
from argparse import Namespace
from pathlib import Path

import pytest
from made_result import result

from linkanim.bench import command
from linkanim.bench import result as results
from linkanim.bench.result import this_machine
from linkanim.cli import main
from linkanim.cli.command_table import parse
from linkanim.errors import BadInput


def options(*words: str) -> Namespace:
    return parse(["bench", *words])


@pytest.fixture
def measured(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the extra be there, and the result be one made by hand."""
    monkeypatch.setattr(command, "NEEDED", ())
    monkeypatch.setattr(results, "run", lambda progress: result())


@pytest.mark.parametrize("missing", ["mpmath", "matplotlib"])
def test_what_is_missing_is_named_with_the_way_to_get_it(missing: str) -> None:
    with pytest.raises(BadInput, match=rf'{missing}, which is not .*pip install "linkanim\[bench\]"'):
        command.require_extra(lambda name: None if name == missing else object())


def test_all_that_is_missing_is_named_at_once() -> None:
    with pytest.raises(BadInput, match="mpmath and matplotlib, which are not installed"):
        command.require_extra(lambda name: None)


def test_without_the_extra_bench_ends_in_one_line(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(command, "NEEDED", ("a_package_that_is_not_there",))
    assert main(["bench", "--into", str(tmp_path / "new")]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.count("\n") == 1
    assert 'pip install "linkanim[bench]"' in printed.err
    assert list(tmp_path.iterdir()) == []


# Where the chart cannot go, and what of it is said.
@pytest.mark.parametrize(
    ("into", "message"),
    [
        pytest.param("a-file", "is a file", id="a file"),
        pytest.param("not-there/new", "there is no folder", id="a folder in a missing one"),
    ],
)
def test_a_wrong_folder_is_refused(measured: None, tmp_path: Path, into: str, message: str) -> None:
    (tmp_path / "a-file").touch()
    with pytest.raises(BadInput, match=message):
        command.run(options("--into", str(tmp_path / into)))


def test_it_prints_the_table_and_writes_the_chart(
    measured: None, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("matplotlib")
    assert main(["bench", "--into", str(tmp_path / "new")]) == 0
    printed = capsys.readouterr()
    assert printed.out.startswith("A processor")
    assert printed.err == f"{tmp_path / 'new' / command.CHART}\n"
    assert (tmp_path / "new" / command.CHART).stat().st_size > 5_000


def test_json_is_all_that_is_on_stdout(
    measured: None, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("matplotlib")
    command.run(options("--json", "--into", str(tmp_path)))
    assert set(json.loads(capsys.readouterr().out)) == {"machine", "rows"}


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
    monkeypatch.setattr("linkanim.bench.result.Path", lambda _: tmp_path / "cpuinfo")
    monkeypatch.setattr("platform.processor", lambda: "")
    monkeypatch.setattr("platform.machine", lambda: "a machine")
    assert this_machine().cpu == name


def test_the_chart_has_the_name_that_is_promised(capsys: pytest.CaptureFixture[str]) -> None:
    assert command.CHART == "speed-vs-error.png"
    assert main(["bench", "--help"]) == 0
    assert f"where {command.CHART} goes" in " ".join(capsys.readouterr().out.split())
