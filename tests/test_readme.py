"""What the README says is so: its commands parse, its snippets run, its key table is the window's."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

import linkanim
from linkanim.cli.command_table import COMMANDS, parse
from linkanim.player.keys import as_markdown
from linkanim.scenes import chapters
from linkanim.scenes.schema import reference

ROOT = Path(__file__).parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    """Return the fenced blocks of a language, in order."""
    return re.findall(rf"^```{language}\n(.*?)^```$", README, re.DOTALL | re.MULTILINE)


def linkanim_lines() -> list[str]:
    """Return the arguments of every `linkanim ...` that the README's bash and console blocks run."""
    commands = "\n".join([*blocks("bash"), *blocks("console")])
    return re.findall(r"\.venv/bin/linkanim\b([^\n&|]*)", commands)


def examples() -> list[str]:
    return [example for _, *examples in COMMANDS.values() for example in examples]


def test_the_first_two_blocks_do_all_their_own_set_up() -> None:
    first, second, *_ = blocks("bash")
    for block in (first, second):
        assert block.startswith("python3 -m venv .venv && .venv/bin/pip install -q ")
        assert block.count("\n") == 1
    assert ".venv/bin/linkanim record press" in first
    assert second.rstrip().endswith(".venv/bin/pytest")


@pytest.mark.parametrize("line", [*linkanim_lines(), *examples()])
def test_every_command_shown_parses(line: str) -> None:
    words = shlex.split(line.removeprefix("linkanim"))
    assert parse(words).command in COMMANDS


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_is_in_the_readme(name: str) -> None:
    assert re.search(rf"^\| `linkanim \[?{name}\b", README, re.MULTILINE)


@pytest.mark.parametrize("name", COMMANDS)
def test_every_help_ends_in_an_example(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        parse([name, "--help"])
    assert capsys.readouterr().out.splitlines()[-1].startswith(f"  linkanim {name}")


def test_the_key_table_is_the_windows() -> None:
    assert as_markdown() in README


def test_the_reference_of_scene_files_is_that_of_their_form() -> None:
    shown = README.split("<!-- scene-file -->\n")[1].split("\n<!-- /scene-file -->")[0]
    assert shown == reference()


@pytest.mark.parametrize("text", blocks("toml"), ids=lambda text: text.splitlines()[0])
def test_every_scene_shown_is_one_that_runs(text: str, tmp_path: Path) -> None:
    path = tmp_path / "my-linkage.toml"
    path.write_text(text, encoding="utf-8")
    scene = linkanim.load(path)
    first, last = scene.solve(phase=[0.0, scene.period]).position["B"]
    assert first == pytest.approx(last, rel=1e-12)


@pytest.mark.parametrize("snippet", blocks("python"))
@pytest.mark.slow
def test_every_snippet_runs(snippet: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    exec(compile(snippet.replace("(1280, 720)", "(160, 90)"), "README.md", "exec"), {})
    assert [path.name for path in tmp_path.iterdir()] == re.findall(r'record\(scene, "(.+?)"', snippet)


@pytest.mark.parametrize(("chapter", "members"), chapters().items())
def test_every_chapter_is_there_with_all_its_names_and_some_pictures(
    chapter: str, members: tuple[str, ...]
) -> None:
    section = README.split(f"### {chapter.capitalize()}\n")[1].split("\n#")[0]
    assert [name for name in members if f"`{name}`" not in section] == []
    shown = [name for name in members if f"(recordings/{name}.gif)" in section]
    assert min(2, len(members)) <= len(shown) <= 3


def test_every_file_named_is_there() -> None:
    names = re.findall(r"\]\((?!http)([^)#]+)\)", README)
    assert [name for name in names if not (ROOT / name).exists()] == []


def test_the_changelog_begins_with_this_version() -> None:
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert re.findall(r"^## (\S+)", changes, re.MULTILINE)[0] == linkanim.__version__
