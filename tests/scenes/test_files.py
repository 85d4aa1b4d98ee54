"""Scenes come by name from the catalogue, or by path from a file."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import linkanim.scenes
from linkanim.errors import BadInput, SceneError
from linkanim.scenes import chapter_of, chapters, load, names, titles
from linkanim.scenes.scene import Scene

FOUR_BAR = "[four-bar]\nground = 100\ncrank = 30\ncoupler = 90\nrocker = 80\n"


def test_the_catalogue_begins_with_a_crank_rocker() -> None:
    assert names()[0] == "crank-rocker"


def test_every_scene_is_in_one_chapter_and_says_which() -> None:
    assert [name for members in chapters().values() for name in members] == list(names())
    assert len(set(names())) == len(names())
    for chapter, members in chapters().items():
        assert [load(name).chapter for name in members] == [chapter] * len(members)
        assert {chapter_of(name) for name in members} == {chapter}
    assert chapter_of("mine") is None


def test_every_file_of_the_catalogue_is_in_a_chapter() -> None:
    folder = Path(linkanim.scenes.__file__).parent / "catalogue"
    assert sorted(path.stem for path in folder.rglob("*.toml")) == sorted(names())


def test_a_file_of_ones_own_needs_no_chapter_and_may_have_one(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(FOUR_BAR)
    assert (load(path).chapter, load(path).look_at) == ("", "")
    path.write_text('chapter = "mine"\nlook_at = "The rocker."\n' + FOUR_BAR)
    assert (load(path).chapter, load(path).look_at) == ("mine", "The rocker.")


def test_a_file_is_named_by_its_stem(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(FOUR_BAR)
    assert load(path).name == load(str(path)).name == "mine"
    assert load(path).linkage == load(str(path)).linkage


def test_a_byte_order_mark_is_no_hindrance(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_bytes(b"\xef\xbb\xbf" + FOUR_BAR.encode())
    assert load(path).linkage.joints


def test_a_path_object_is_a_path_even_without_suffix(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("press").write_text(FOUR_BAR)
    assert "rocker" in {body.name for body in load(Path("press")).linkage.bodies}
    assert "7" in {body.name for body in load("press").linkage.bodies}


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ("pres", 'did you mean "press"?'),
        ("drag_link", 'did you mean "drag-link"?'),
        ("zzz", "`linkanim scenes` lists them"),
        ("", "`linkanim scenes` lists them"),
        ("a\nb", "`linkanim scenes` lists them"),
    ],
)
def test_an_unknown_name_is_answered_with_the_nearest(asked: str, said: str) -> None:
    with pytest.raises(BadInput) as refusal:
        load(asked)
    assert said in str(refusal.value)
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize(
    ("path", "content", "said"),
    [
        ("none.toml", None, "no such file"),
        ("press.toml", None, 'did you mean "press"?'),
        ("nowhere/press.toml", None, "no such file"),
        ("a\0b.toml", None, "cannot be read"),
        ("x" * 300 + ".toml", None, "cannot be read"),
        ("big.toml", b"# " + b"x" * 1_000_000, "larger than 1 MB"),
        ("latin.toml", b"title = 'x'\n# \xe9t\xe9\n", "not UTF-8 text (line 2)"),
        ("zip.toml", b"PK\x03\x04\xff\xfe\x00", "not UTF-8"),
        ("nul.toml", b"\x00" * 10, "not TOML"),
        ("words.toml", b"this is\nnot a scene\n", "not TOML"),
        ("empty.toml", b"", "describes no linkage"),
    ],
)
def test_a_file_that_is_no_scene_is_refused_by_name(
    path: str, content: bytes | None, said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    if content is not None:
        Path(path).write_bytes(content)
    with pytest.raises(SceneError) as refusal:
        load(path)
    assert str(refusal.value).startswith(path.replace("\0", "?"))
    assert said in str(refusal.value)
    assert "\n" not in str(refusal.value)


def test_a_folder_is_not_a_scene(tmp_path: Path) -> None:
    folder = tmp_path / "folder.toml"
    folder.mkdir()
    with pytest.raises(SceneError, match=r"folder\.toml: is a folder"):
        load(folder)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="pipes with names are a POSIX thing")
def test_a_pipe_is_refused_rather_than_waited_for(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe.toml"
    os.mkfifo(pipe)
    with pytest.raises(SceneError, match="not a file"):
        load(pipe)


def test_titles_are_told_for_every_name() -> None:
    assert tuple(titles()) == names()
    assert all(title and title[0].isupper() for title in titles().values())


def test_listing_the_catalogue_needs_no_window_encoder_or_arrays() -> None:
    heavy = "{'pygame', 'imageio_ffmpeg', 'PIL', 'numpy'}"
    check = f"import sys; from linkanim.scenes import titles; titles(); assert not {heavy} & set(sys.modules)"
    assert subprocess.run([sys.executable, "-c", check], check=False).returncode == 0


# What a library call is given is looked at before anything is solved.
ASKED: list[tuple[Callable[[Scene], object], str]] = [
    (lambda scene: scene.pose("1"), "pose"),  # type: ignore[arg-type]
    (lambda scene: scene.pose(1.0, speed="2"), "numbers"),  # type: ignore[arg-type]
    (lambda scene: scene.pose(1.0, derivatives=7), "derivatives=7"),
    (lambda scene: scene.solve(phase=1.0, derivatives=-1), "derivatives=-1"),
    (lambda scene: scene.cycle(2.5), "2.5"),  # type: ignore[arg-type]
    (lambda scene: scene.cycle(0), "whole number"),
]


@pytest.mark.parametrize(("ask", "message"), ASKED, ids=[message for _, message in ASKED])
def test_a_call_with_what_it_does_not_take_is_refused(ask: Callable[[Scene], object], message: str) -> None:
    with pytest.raises(BadInput, match=re.escape(message)):
        ask(load("press"))


def test_whole_numbers_of_any_kind_are_numbers() -> None:
    scene = load("press")
    assert scene.pose(np.float64(1.0), 1).position == scene.pose(1, 1).position
    count: Any = np.int64(3)
    assert scene.cycle(count).phase.shape == (3,)
