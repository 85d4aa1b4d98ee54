"""What the manual's page on files says is so: its folders, names and numbers are the program's."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

import platformdirs.macos
import platformdirs.unix
import platformdirs.windows
import pytest
from platformdirs.api import PlatformDirsABC

from linkanim.atomic_files import Claim, set_aside
from linkanim.bounds import LARGEST_SIDE
from linkanim.picture.photograph import _MILLIONS, _MOST_BYTES
from linkanim.play.scores import _MOST_BEST, _MOST_MISSED
from linkanim.player.files import DraftFile

PAGE = (files("linkanim") / "manual" / "files.md").read_text(encoding="utf-8")
WORDS = " ".join(PAGE.split())


def test_the_data_folder_is_the_system_s(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("XDG_DATA_HOME", "LOCALAPPDATA", "USERPROFILE"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(platformdirs.windows, "get_win_folder", lambda _: r"%LOCALAPPDATA%")
    systems: dict[str, type[PlatformDirsABC]] = {
        "Linux": platformdirs.unix.Unix,
        "macOS": platformdirs.macos.MacOS,
        "Windows": platformdirs.windows.Windows,
    }
    for system, of in systems.items():
        folder = of("linkanim", False).user_data_dir.replace(str(Path.home()), "~").replace("%/", "%\\")
        assert f"| {system} | `{folder}`" in PAGE


def test_its_numbers_are_the_program_s() -> None:
    assert f"{_MILLIONS['JPEG']} million pixels as JPEG, {_MILLIONS['PNG']} million as PNG or BMP" in WORDS
    assert f"{_MILLIONS['WEBP']} million as WebP, {LARGEST_SIDE:,} along a side" in WORDS
    assert f"and {_MOST_BYTES // 1_000_000} MB" in WORDS
    assert f"more than {_MOST_BEST:,} best scores" in WORDS
    assert f"more than {_MOST_MISSED} missed questions" in WORDS


def test_its_names_are_the_program_s(tmp_path: Path) -> None:
    for name in ("scores.json", "draft.json"):
        assert Claim.on(tmp_path / name)
        (tmp_path / name).touch()
        assert set_aside(tmp_path / name)
    made = [path.name for path in tmp_path.iterdir()]
    made += [path.name for path in [*DraftFile(Path("draft.json"))._names()][:2]]
    assert [name for name in made if f"`{name}`" not in PAGE] == []
