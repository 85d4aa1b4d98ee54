"""What would take the machine's memory or its user's time is refused before work begins, with the bound."""

from __future__ import annotations

from pathlib import Path

import pytest
import tomli_w
from random_scenes import chain

from linkanim.bounds import (
    MOST_ASKED,
    MOST_CHARTED,
    MOST_DRAWN,
    MOST_NUMBERS,
    MOST_NUMBERS_READ,
    MOST_PIXELS,
    MOST_POSES,
    MOST_VERSIONS,
)
from linkanim.cli import main
from linkanim.scenes import load, names

# The words of a command, and what its refusal says; `chain.toml` has 62 dyads, each with a mass.
REFUSED = {
    "many poses of many joints": ("draw chain.toml --poses 360", "a figure holds 40 poses"),
    "many poses on many pixels": (
        "draw chain.toml --poses 40 -o a.png --size 3840x2160",
        "a figure holds 10 poses at 3840x2160; take 10 or fewer",
    ),
    "a picture of many pixels": ("draw kite -o a.png --size 16384x16384", "33,177,600 are the most"),
    "a chart of many pixels": ("chart kite --quantity B.velocity --size 9000x9000", "33,177,600 are the"),
    "a recording of many pixels": ("record kite --size 16384x16384", "33,177,600 are the most"),
    "many questions on many joints": ("quiz chain.toml -n 200", "a round has 3 questions at the most"),
    "a sheet of many figures": ("quiz chain.toml -n 24 -o sheet.html", "a round has 3 questions"),
    "many versions of many joints": (
        "explain chain.toml --exercise --versions 26 -o a.html",
        "--versions 26: give a number from 1 to 3; chain has 126 joints",
    ),
    "a report of all quantities": (
        "report chain.toml --all -o report",
        "chain has 3,004 quantities, and a report holds 1,200",
    ),
    "a report of all quantities at several speeds": (
        "report kite --all -o report --speeds " + ",".join(f"{n}rpm" for n in range(1, 37)),
        "quantities at 36 speeds, and a report holds 1,200",
    ),
    "a report at many speeds": (
        "report chain.toml -o report --speeds " + ",".join(f"{n}rpm" for n in range(1, 38)),
        "a list has 36 at the most",
    ),
    "a long table of many columns": (
        "solve chain.toml --sweep 0:36000:0.1 --csv all.csv",
        "947,162,631 numbers, and 100,000,000 are the most",
    ),
    "a long list": ("solve chain.toml --sweep 0:36000:0.1 --json", "take a longer step"),
    "a long table to read": ("solve kite --sweep 0:36000:0.1", "write them with --csv or --json"),
}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a folder to work in, with a long chain."""
    monkeypatch.chdir(tmp_path)
    Path("chain.toml").write_text(tomli_w.dumps(chain(62, weighed=True)), encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(
            name, marks=[pytest.mark.slow] * (name in ("a long table of many columns", "a long list"))
        )
        for name in REFUSED
    ],
)
def test_what_is_too_much_is_refused_with_the_bound(
    name: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words, sentence = REFUSED[name]
    assert main(words.split()) == 2
    said = capsys.readouterr()
    assert sentence in said.err
    assert said.err.count("\n") == 1
    assert said.out == ""
    assert [path.name for path in folder.iterdir()] == ["chain.toml"]


def test_an_outline_has_no_pixels_to_hold(folder: Path) -> None:
    assert (
        main(["draw", "kite", "--phase", "1 rad", "-o", "kite.svg", "--size", "16384x16384", "--poses", "20"])
        == 0
    )


def test_the_bounds_leave_room_for_every_built_in_scene() -> None:
    joints = max(len(load(name).linkage.joints) for name in names())
    assert joints * MOST_POSES <= MOST_DRAWN
    assert joints**2 * 200 <= MOST_ASKED
    assert joints * 26 <= MOST_VERSIONS
    quantities = max(len(load(name).quantities) for name in names())
    assert 4 * quantities <= MOST_CHARTED
    assert MOST_PIXELS > 3840 * 2160
    assert 10_000 * quantities <= MOST_NUMBERS_READ
    assert 360_000 * quantities <= MOST_NUMBERS
