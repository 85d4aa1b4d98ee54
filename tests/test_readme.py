"""What README and the manual say is so: what is pasted runs in a fresh folder, pictures are as made."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator
from importlib.resources import files
from pathlib import Path

import imageio.v3 as iio
import numpy as np
import pygame
import pytest
from fidelity import psnr
from numpy.typing import NDArray
from PIL import Image

import linkanim
from linkanim.bench import drawing
from linkanim.cli import main
from linkanim.cli.command_table import COMMANDS, parse
from linkanim.cli.commands import manual, new, play
from linkanim.manual import FOLDER
from linkanim.player.lesson import read
from linkanim.recorder.gallery import contact_sheet, make_gallery
from linkanim.scenes import load, names
from linkanim.scenes.files import is_lesson

ROOT = Path(__file__).parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")
PAGES = {path.stem: path.read_text(encoding="utf-8") for path in FOLDER.glob("*.md")}
PAGES["README"] = README
ALIKE, PRINTED = 30, 24.5
"""In dB: the same picture on another machine, and at half its size the same figure with a browser's words."""


def blocks(language: str) -> dict[str, str]:
    """Return the fenced blocks of a language in README and the manual, by page and number."""
    found: dict[str, str] = {}
    for page, text in PAGES.items():
        of_page = re.findall(rf"^```{language}\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)
        found |= {f"{page} {number}": block for number, block in enumerate(of_page, 1)}
    return found


def linkanim_lines(block: str) -> Iterator[list[str]]:
    """Yield the words after `linkanim` of each line that runs it."""
    for line in block.splitlines():
        words = re.match(r"(?:.*&& )?(?:\.venv/bin/)?linkanim\b(.*)", line)
        if words:
            yield shlex.split(words[1], comments=True)


PASTED = blocks("bash")
TYPED = {f"sh of {name}": block for name, block in blocks("sh").items()}
SHOWN = {**PASTED, **TYPED}


def examples() -> list[str]:
    return [example for _, *examples in COMMANDS.values() for example in examples]


def test_readme_is_short_and_its_first_two_blocks_do_all_their_own_set_up() -> None:
    assert README.count("\n") <= 200
    first, second = PASTED["README 1"], PASTED["README 2"]
    for block in (first, second):
        assert block.startswith("python3 -m venv .venv && .venv/bin/pip install -q ")
        assert block.count("\n") == 1
    assert ".venv/bin/linkanim record press" in first
    assert second.rstrip().endswith(".venv/bin/pytest")


def test_nothing_that_is_pasted_begins_with_a_prompt() -> None:
    assert [
        name for name, block in {**PASTED, **TYPED}.items() if re.search(r"^\$", block, re.MULTILINE)
    ] == []
    assert blocks("console") == {}


@pytest.mark.parametrize("block", SHOWN.values(), ids=SHOWN)
def test_every_command_shown_parses(block: str) -> None:
    for words in linkanim_lines(block):
        if words != ["--version"]:
            assert parse(words).command in COMMANDS


@pytest.mark.parametrize("line", examples())
def test_every_example_of_a_help_parses(line: str) -> None:
    assert parse(shlex.split(line.removeprefix("linkanim"))).command in COMMANDS


@pytest.mark.parametrize("name", COMMANDS)
def test_every_help_ends_in_an_example(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        parse([name, "--help"])
    assert capsys.readouterr().out.splitlines()[-1].startswith(f"  linkanim {name}")


@pytest.fixture
def fresh(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a folder with nothing in it but what a clone has, and no window that would stay open."""
    for name in ("linkanim", "recordings"):
        (tmp_path / name).symlink_to(ROOT / name)
    monkeypatch.chdir(tmp_path)
    for command in (play, new):
        monkeypatch.setattr(command, "play", lambda *_, **__: None)
    monkeypatch.setattr(manual, "_has_screen", lambda: False)
    return tmp_path


SMALL = {"record": ["--size", "96x54"]}
"""What makes a command quick without making it another."""


MINUTES = {
    *("synthesis 1", "synthesis 2", "synthesis 3", "synthesis 5", "make 1", "hand-outs 1", "hand-outs 4"),
    *("loops 1", "figures 4", "figures 5", "figures 6", "first-hour 8"),
}
"""Blocks whose commands other tests run, too, and that take long."""


@pytest.mark.slow
@pytest.mark.parametrize(
    "block",
    [
        pytest.param(block, id=name, marks=[pytest.mark.long] if name in MINUTES else [])
        for name, block in PASTED.items()
    ],
)
def test_what_is_pasted_into_a_fresh_folder_runs(block: str, fresh: Path) -> None:
    for words in linkanim_lines(block):
        assert main([*words, *SMALL.get(words[0] if words else "", [])]) == 0, words
    if "README" not in block:
        others = [line for line in block.splitlines() if not re.search(r"(^|&& |/)linkanim\b|pytest$", line)]
        assert others == []


@pytest.mark.parametrize("text", blocks("toml").values(), ids=blocks("toml"))
def test_every_scene_shown_is_one_that_runs(text: str, tmp_path: Path) -> None:
    path = tmp_path / "my-linkage.toml"
    path.write_text(text, encoding="utf-8")
    if is_lesson(path):
        assert len(read(path)) == text.count("[[step]]")
        return
    scene = linkanim.load(path)
    first, last = scene.solve(phase=[0.0, scene.period]).position["B"]
    assert first == pytest.approx(last, rel=1e-12)


def test_the_tutorial_s_scene_is_the_example() -> None:
    (scene,) = (text for name, text in blocks("toml").items() if name.startswith("first-hour"))
    assert scene == (files("linkanim") / "examples" / "my-linkage.toml").read_text(encoding="utf-8")


@pytest.mark.parametrize("snippet", blocks("python").values(), ids=blocks("python"))
@pytest.mark.slow
def test_every_snippet_runs(snippet: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    exec(compile(snippet.replace("(1280, 720)", "(160, 90)"), "README.md", "exec"), {})
    assert [path.name for path in tmp_path.iterdir()] == re.findall(r'record\(.+?, "(.+?)"', snippet)


def test_every_file_named_is_there() -> None:
    named = re.findall(r"\]\((?!http)([^)#]+)\)", README)
    assert [name for name in named if not (ROOT / name).exists()] == []


def test_readme_counts_the_scenes() -> None:
    assert f"There are {len(names())} built-in" in " ".join(README.split())


def test_readme_s_five_rows_and_its_sentence_are_those_of_the_manual() -> None:
    table = re.search(r"\n(\| method.*?)\n\n", README, re.DOTALL)
    assert table
    head, rule, *rows = table[1].splitlines()
    measured = PAGES["measurements"].splitlines()
    assert len(rows) == 5
    assert {head, rule, *rows} <= set(measured)
    ours = "".join(line for line in measured if line.startswith("| linkanim, "))
    worst = max(float(number) for number in re.findall(r"\d\.\d+e-\d+", ours))
    for page in (README, PAGES["measurements"]):
        (said,) = re.findall(r"ever off by more than (\d+e-\d+)", page)
        assert worst <= float(said)


def test_the_changelog_begins_with_this_version() -> None:
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert re.findall(r"^## (\S+)", changes, re.MULTILINE)[0] == linkanim.__version__
    citation = (ROOT / ".github" / "CITATION.cff").read_text(encoding="utf-8")
    assert f"\nversion: {linkanim.__version__}\n" in citation


def test_the_newest_changes_begin_with_ten_lines() -> None:
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8").split("\n## ")[1]
    summary = changes.partition("\n### Details\n")[0]
    assert re.findall(r"^(\d+)\. ", summary, re.MULTILINE) == [str(n) for n in range(1, 11)]


# The pictures that a command of the manual writes, and the command.
DRAWN = {
    "figure": 'draw crank-rocker --angle "60 deg" --names --names --polygons --size 800x450 -o figure.png',
    "chart": "chart crank-rocker --quantity rocker.angular_velocity --size 800x400 -o chart.png",
    "side-left": (
        'draw double-rocker --phase "70 deg" --ghost --names --no-trace --size 640x360 -o side-left.png'
    ),
    "side-forward": (
        'draw slider-crank --angle "60 deg" --ghost --names --no-trace --size 640x360 -o side-forward.png'
    ),
}


def levels(path: Path) -> NDArray[np.float64]:
    with Image.open(path) as picture:
        return np.asarray(picture.convert("RGB"), float)


@pytest.mark.parametrize("name", DRAWN)
def test_a_picture_is_what_its_command_writes(name: str, fresh: Path) -> None:
    line = DRAWN[name]
    assert any(f"linkanim {line}\n" in block for block in PASTED.values())
    assert main(shlex.split(line)) == 0
    kept, made = levels(FOLDER / "pictures" / f"{name}.png"), levels(Path(f"{name}.png"))
    assert kept.shape == made.shape
    assert psnr(kept, made) > ALIKE, f"make it anew: linkanim {line}"


_SMALL, _LARGER = (f"--size {size} --fps 12.5 --no-hud" for size in ("480x270", "640x360"))
RECORDED = {
    "first-look": ["record press --vectors v --chart 5.travel_velocity --size 560x315 --fps 16.6667"],
    "figure": [f"record crank-rocker --names --names --polygons {_LARGER}"],
    "solution": [
        f"record slider-crank --vectors v,a --instant-centres --chart slider.travel_acceleration {_LARGER}"
    ],
    "follower": [
        "path linkanim/examples/curve.csv --count 1 -o follower.toml",
        f"record follower.toml {_SMALL}",
    ],
    "building": ["record recordings/building.tape.json --size 576x324 --fps 15"],
    "play": ["record recordings/play.tape.json --size 640x360 --fps 20"],
}
"""README's moving pictures that are no part of the gallery: the commands that make them."""
LARGEST_GIF = 400_000


@pytest.mark.thinned(4)
@pytest.mark.slow
@pytest.mark.parametrize("name", RECORDED)
def test_a_moving_picture_is_what_its_command_records(name: str, fresh: Path) -> None:
    *before, last = RECORDED[name]
    for line in before:
        assert main(shlex.split(line)) == 0
    assert main([*last.split(), "-o", "made.gif"]) == 0
    kept_file = ROOT / "recordings" / f"{name}.gif"
    assert kept_file.stat().st_size < LARGEST_GIF
    with Image.open("made.gif") as made, Image.open(kept_file) as kept:
        assert made.size == kept.size
        assert getattr(made, "n_frames", 1) == getattr(kept, "n_frames", 1)
        for frame in {0, 12, 25, getattr(made, "n_frames", 1) - 1}:
            made.seek(frame)
            kept.seek(frame)
            assert psnr(*(np.asarray(one.convert("RGB"), float) for one in (made, kept))) > ALIKE


@pytest.mark.slow
@pytest.mark.parametrize("first", [0, 20, 44])
def test_the_sheet_of_all_scenes_has_each_as_it_is_now(first: int) -> None:
    """Three of a row each time: a scene that changed its look needs the sheet made anew."""
    some = [load(name) for name in names()[first : first + 3]]
    (left, top), (wide, high) = (406 * (first % 4), 231 * (first // 4)), (406 * len(some), 231)
    with Image.open(ROOT / "recordings" / "contact-sheet.png") as sheet:
        kept = np.asarray(sheet.convert("RGB").crop((left, top, left + wide, top + high)), float)
    made = iio.imread(contact_sheet(some))[:high, :wide, :3].astype(float)
    assert psnr(kept, made) > ALIKE, "make it anew: linkanim gallery"


# The gallery's moving pictures in README: a scene that changed its look has to be recorded anew.
@pytest.mark.thinned(2)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["whitworth", "press"])
def test_a_picture_of_the_gallery_is_what_the_gallery_records(name: str, fresh: Path) -> None:
    make_gallery(Path("made"), [name])
    with (
        Image.open(Path("made") / f"{name}.gif") as made,
        Image.open(ROOT / "recordings" / f"{name}.gif") as kept,
    ):
        assert made.size == kept.size
        assert psnr(*(np.asarray(one.convert("RGB"), float) for one in (made, kept))) > ALIKE


def test_the_chart_of_speed_and_error_is_that_of_the_manual_s_table() -> None:
    """The file holds the table that it was drawn from."""
    shown = PAGES["measurements"].partition("<!-- bench -->\n")[2].partition("<!-- /bench -->")[0]
    with Image.open(ROOT / "recordings" / "speed-vs-error.png") as chart:
        assert chart.size == drawing.SIZE
        assert chart.info[drawing.TABLE] == shown, "make both anew: tests/bench/peers.py"


def words_of(page: str) -> str:
    """Return a page's words; what is lowered or raised stands in the word that it belongs to."""
    bare = re.sub(r"<style>.*?</style>|</?(tspan|sub|sup)\b[^>]*>", "", page, flags=re.DOTALL)
    return re.sub(r"<[^>]*>", " ", bare)


@pytest.mark.long
@pytest.mark.slow
def test_the_printed_page_is_the_report_s(tmp_path: Path) -> None:
    """Its words were read off the page when it was printed, and are kept in the picture's file."""
    (line,) = re.findall(r"linkanim (report press .*) -o press-report$", PAGES["hand-outs"], re.MULTILINE)
    report = tmp_path / "press-report"
    assert main([*shlex.split(line), "-o", str(report)]) == 0
    with Image.open(FOLDER / "pictures" / "report.png") as page:
        printed, place = page.info["words"].split(), page.info["figure"].split()
        left, top, right, bottom = (round(float(side)) for side in place)
        half = (right - left) // 2, (bottom - top) // 2  # at which the edges of words say little
        figure = page.convert("RGB").crop((left, top, right, bottom)).resize(half, Image.Resampling.BOX)
        theirs = np.asarray(figure, float)
    written = set(words_of((report / "report.html").read_text(encoding="utf-8")).split())
    assert "67.21" in printed
    assert [word for word in printed if word not in written] == [], "make it anew: .ci/report-page"
    drawn = pygame.transform.smoothscale(pygame.image.load(report / "figure.svg"), half)
    mine = pygame.surfarray.array3d(drawn).transpose(1, 0, 2).astype(float)
    assert psnr(mine, theirs) > PRINTED, "make it anew: .ci/report-page"
