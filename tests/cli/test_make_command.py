"""`linkanim make`: the folders of the three ways, the object, and what is said of what cannot be made."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from linkanim.cli import main
from linkanim.cli.command_table import build
from linkanim.ui import window
from linkanim.workshop import documents, layers

Capture = pytest.CaptureFixture[str]

FILES = {
    "cardboard": {"parts.pdf"},
    "laser": {"parts-3mm.svg", "parts-3mm.dxf"},
    "print": {
        *("part-1-ground.stl", "part-2-crank.stl", "part-3-coupler.stl", "part-4-rocker.stl", "cap.stl"),
        *("pin-A.stl", "pin-B.stl", "pin-O2.stl", "pin-O4.stl"),
    },
}


@pytest.mark.parametrize("way", FILES)
def test_a_way_of_making_writes_its_files(way: str, tmp_path: Path, capsys: Capture) -> None:
    folder = tmp_path / "made"
    assert main(["make", "crank-rocker", "-o", str(folder), "--way", way, "--fit", "A4"]) == 0
    assert capsys.readouterr().out.splitlines() == [
        str(folder / "assembly.html"),
        "4 parts in 2 layers on the ground, 2.2 times as large as the scene",
    ]
    always = {"assembly.html", "make.json", ".linkanim-make.json"}
    assert {path.name for path in folder.iterdir()} == FILES[way] | always
    before = {path.name: path.read_bytes() for path in folder.iterdir() if path.suffix != ".dxf"}
    # the same again has the same bytes, and takes the place of the old
    assert main(["make", "crank-rocker", "-o", str(folder), "--way", way, "--fit", "A4"]) == 0
    after = {path.name: path.read_bytes() for path in folder.iterdir() if path.suffix != ".dxf"}
    del before[".linkanim-make.json"], after[".linkanim-make.json"]
    assert after == before


def test_a_search_for_fewer_layers_that_was_given_up_is_told(
    tmp_path: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(layers, "_MOST_FEWER", 50)
    for scene, told in (("crank-rocker", ""), ("six-bar", "there may be a way with fewer layers")):
        assert main(["make", scene, "-o", str(tmp_path / scene), "--way", "laser"]) == 0
        assert capsys.readouterr().err.partition(";")[0].strip() == told


def test_another_way_replaces_what_was_ours_and_leaves_the_rest(tmp_path: Path) -> None:
    folder = tmp_path / "made"
    for way in ("cardboard", "laser"):
        (folder / "mine.txt").parent.mkdir(exist_ok=True)
        (folder / "mine.txt").write_text("mine")
        assert main(["make", "crank-rocker", "-o", str(folder), "--way", way]) == 0
    assert not (folder / "parts.pdf").exists()
    assert (folder / "mine.txt").read_text() == "mine"


def test_the_object_is_the_one_that_is_written(tmp_path: Path, capsys: Capture) -> None:
    folder = tmp_path / "made"
    assert main(["make", "crank-rocker", "-o", str(folder), "--json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    assert printed == json.loads((folder / "make.json").read_text(encoding="utf-8"))
    assert printed["layers"] == 2
    assert printed["refused"] is None
    assert [part["body"] for part in printed["parts"]] == ["crank", "coupler", "rocker"]
    assert {(pin["joint"], pin["from"], pin["to"]) for pin in printed["pins"]} == {
        *(("O2", 0, 1), ("O4", 0, 1)),
        *(("A", 1, 2), ("B", 1, 2)),
    }


def test_what_cannot_be_made_says_so_in_the_object_and_writes_nothing(
    tmp_path: Path, capsys: Capture
) -> None:
    assert main(["make", "drag-link", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["layers"], found["parts"], found["pins"]) == (0, [], [])
    assert "crank would meet the pin at O4 (phase 0.0 deg)" in found["refused"]
    assert main(["make", "drag-link", "-o", str(tmp_path / "made"), "--json"]) == 2
    captured = capsys.readouterr()
    assert json.loads(captured.out) == found
    assert captured.err.strip().endswith(found["refused"])
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("suffix", ["svg", "png", "pdf"])
def test_a_picture_of_the_layers_needs_no_folder(suffix: str, tmp_path: Path, capsys: Capture) -> None:
    picture = tmp_path / f"leg.{suffix}"
    assert main(["make", "jansen", "--preview", str(picture)]) == 0
    assert capsys.readouterr().out.splitlines() == [
        str(picture),
        "8 parts in 3 layers on the ground, in true size",
    ]
    assert [*tmp_path.iterdir()] == [picture]


def test_a_folder_and_a_picture_are_written_at_once(tmp_path: Path, capsys: Capture) -> None:
    folder, picture = tmp_path / "made", tmp_path / "layers.svg"
    assert main(["make", "crank-rocker", "-o", str(folder), "--preview", str(picture), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["layers"] == 2
    assert (folder / "assembly.html").exists()
    assert picture.read_text("utf-8").count('<g id="') == 2


# each with what is said of it
BAD = [
    (
        ["crank-rocker"],
        "name a folder for the parts (-o FOLDER), take --preview to see them, or --json",
    ),
    (["crank-rocker", "-o", "parts", "--preview"], "--preview without a picture's name opens the window"),
    (["crank-rocker", "--json", "--hole", "9", "--bar", "8"], "a hole of 9 mm is no narrower than its bar"),
    (["crank-rocker", "--json", "--thickness", "0"], "thickness=0: give a length in mm"),
    (["crank-rocker", "--json", "--bar", "wide"], '"wide" is not a length'),
    (["crank-rocker", "--json", "--bar", "3 apples"], "is not one of its units, mm, cm, m, in"),
    (["crank-rocker", "--json", "--sheet", "600"], '"600" is no sheet: take A4, Letter, or a size'),
    (["crank-rocker", "--json", "--sheet", "0x400"], '"0" is not a number greater than zero'),
    (["crank-rocker", "--json", "--fit", "A3"], 'fit="A3": take A4 or Letter'),
    (["crank-rocker", "--preview", "layers.gif"], "use one of .svg, .png, .pdf"),
    (["drag-link", "--preview", "layers.svg"], "crank would meet the pin at O4 (phase 0.0 deg)"),
    (["excavator", "-o", "made"], "a cylinder drives it, which no flat parts are"),
    (["press", "-o", "made", "--way", "laser"], "which a sheet of 600 x 400 mm does not hold"),
    (["crank-rocker", "-o", "no/such/folder"], "there is no folder"),
]


@pytest.mark.parametrize(("words", "said"), BAD, ids=[said[:30] for _, said in BAD])
def test_bad_input_is_named_with_the_way_out(
    words: list[str], said: str, tmp_path: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["make", *words]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert said in line
    assert list(tmp_path.iterdir()) == []


def test_lengths_may_have_their_unit(capsys: Capture) -> None:
    assert main(["make", "crank-rocker", "--json", "--bar", "1.2 cm", "--hole", "4mm"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert {hole[2] for part in found["parts"] for hole in part["holes"]} == {4.0}


@pytest.mark.parametrize(
    ("way", "library"), [("cardboard", "fpdf"), ("laser", "ezdxf"), ("print", "manifold3d")]
)
def test_a_library_of_the_extra_that_is_missing_is_named(
    way: str, library: str, tmp_path: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(documents, "find_spec", lambda name: None if name == library else name)
    assert main(["make", "crank-rocker", "-o", str(tmp_path / "made"), "--way", way]) == 2
    said = capsys.readouterr().err
    assert f"needs {library}, which is not installed" in said
    assert 'pip install "linkanim[make]"' in said
    assert list(tmp_path.iterdir()) == []


def test_a_preview_without_a_name_opens_the_window_with_the_options_that_were_given(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    opened: dict[str, object] = {}
    monkeypatch.setattr(window, "run", lambda scene, **more: opened.update(scene=scene, **more))
    words = ["--bar", "12", "--sheet", "500x300", "--fit", "A4", "--bridge"]
    assert main(["make", "crank-rocker", *words, "--preview"]) == 0
    assert opened["scene"] == "crank-rocker"
    again = build().parse_args(["make", "crank-rocker", *opened["layers"]])  # type: ignore[misc]
    given = build().parse_args(["make", "crank-rocker", *words])
    assert vars(again) == vars(given)
