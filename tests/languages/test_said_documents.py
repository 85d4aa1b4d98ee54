"""Worked solutions, exercises, quizzes and pages that move, in every language: no word stays behind."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from unicodedata import east_asian_width

import pytest
from pseudo import plain_words, spoken_pseudo, visible

from linkanim import load, tolerance
from linkanim.cli import main
from linkanim.explain.documents import HTML
from linkanim.explain.exercise import Level, exercise
from linkanim.explain.solution import PoseRequest, solution
from linkanim.paper.chart import Page
from linkanim.paper.construction import ConstructionPage
from linkanim.paper.curves import Pace, curves_of
from linkanim.paper.polar import PolarPage
from linkanim.paper.tolerances import ToleranceChart
from linkanim.picture.items import words_of
from linkanim.play.quiz import as_html, as_text, questions
from linkanim.share.page import Shared, packaged, script_words
from linkanim.share.page import document as page
from linkanim.words import speaking

_KNOWN = frozenset({"cos", "sin", "tan", "rad", "rpm", "linkanim"})
SOLVED = {
    "crank-rocker": "bars in line, half angles, a swing",
    "press": "a slider, springs and masses, and a force in each joint",
    "crank-shaper": "a slot, and dead centres by search",
    "elliptic-trammel": "two sliders on one rod",
    "oscillating-cylinder": "a cylinder",
    "landing-gear": "an input that swings, with its limits",
    "double-butterfly": "links that are solved together",
    "geared-five-bar-2-1": "gears",
    "oldham": "a slot on a link that moves",
}
"""Scenes that need sentences of each kind, and which."""


def _solved(name: str, *, forces: bool = False) -> str:
    scene = load(name)
    request = PoseRequest(scene, "phase", 0.7, scene.linkage.drive.speed, forces=forces)
    return HTML.document(solution(request))


@pytest.mark.parametrize("name", SOLVED)
def test_no_word_of_a_solution_stays_behind(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    with spoken_pseudo(monkeypatch):
        text = visible(_solved(name, forces=name == "press"))
    assert plain_words(text, _KNOWN) == set()


@pytest.mark.parametrize(
    "level",
    [
        pytest.param("drawing", marks=pytest.mark.slow),
        "hints",
        pytest.param("formulas", marks=pytest.mark.slow),
    ],
)
def test_no_word_of_an_exercise_stays_behind(level: Level, monkeypatch: pytest.MonkeyPatch) -> None:
    with spoken_pseudo(monkeypatch):
        found = [
            solution(PoseRequest(load(name), "phase", 0.7, 1.0, forces=name == "press"))
            for name in ("crank-rocker", "press")
        ]
        text = visible(exercise(found, HTML, level))
    assert plain_words(text, _KNOWN) == set()


@pytest.mark.slow
def test_no_word_of_a_quiz_stays_behind(monkeypatch: pytest.MonkeyPatch) -> None:
    names = ("crank-rocker", "press", "whitworth", "jansen", "double-rocker", "landing-gear")
    with spoken_pseudo(monkeypatch):
        asked = questions([load(name) for name in names], 36, 1)
        text = as_text(asked) + visible(as_html(asked[:3], asked[0].scene.title))
    titles = set(re.findall(r"[A-Za-z]{3,}", asked[0].scene.title))
    assert plain_words(text, _KNOWN | titles) == set()


@pytest.mark.slow
def test_a_quiz_is_the_same_in_every_language() -> None:
    scenes = [load(name) for name in ("crank-rocker", "press", "whitworth")]
    rounds = {}
    for language in ("en", "zh_TW", "zh_CN"):
        with speaking(language):
            rounds[language] = [
                (one.question_id, one.right, len(one.answers)) for one in questions(scenes, 24, 5)
            ]
    assert rounds["zh_TW"] == rounds["en"] == rounds["zh_CN"]


@pytest.mark.parametrize(
    "name",
    [
        "crank-rocker",
        *(pytest.param(one, marks=pytest.mark.slow) for one in ("press", "geared-five-bar-2-1")),
    ],
)
def test_no_word_of_a_page_that_moves_stays_behind(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    with spoken_pseudo(monkeypatch):
        text = page(Shared(load(name), names=1))
    shown = visible(text)
    assert plain_words(shown, _KNOWN) == set()
    data = json.loads(re.findall(r'id="data">(.*?)</script>', text)[0])
    script = "\n".join(map(packaged, ("lengths.js", "page.js")))
    assert data["said"].keys() == set(script_words(script))
    labels = [row["label"] for side in data["sides"] for row in side["rows"]]
    labels += [slider["label"] for slider in data["model"]["sliders"]] if "model" in data else []
    assert plain_words(" ".join(labels), _KNOWN) == set()


LANGUAGES = {"en": "en", "zh_TW": "zh-Hant", "zh_CN": "zh-Hans"}


@pytest.mark.slow
@pytest.mark.parametrize(("language", "tag"), LANGUAGES.items())
def test_a_page_says_which_language_it_is_in(
    language: str, tag: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    commands = (["explain", "crank-rocker"], ["quiz", "crank-rocker", "-n", "2"], ["share", "crank-rocker"])
    for command in commands:
        assert main([*command, "-o", f"{command[0]}.html", "--lang", language]) == 0
        text = (tmp_path / f"{command[0]}.html").read_text("utf-8")
        assert re.search(r"<html lang=['\"](.*?)['\"]", text)[1] == tag  # type: ignore[index]


TEX = {
    "zh_TW": "fontset=none",  # Fandol, which ctex takes, has no traditional letters
    "zh_CN": "[UTF8,scheme=plain]",
}


@pytest.mark.parametrize(("language", "fonts"), TEX.items())
def test_latex_names_fonts_that_have_its_letters(language: str, fonts: str, tmp_path: Path) -> None:
    target = tmp_path / "solution.tex"
    assert main(["explain", "crank-rocker", "-o", str(target), "--lang", language]) == 0
    assert fonts in target.read_text("utf-8").partition("\n\\begin{document}")[0]


@pytest.mark.long
@pytest.mark.skipif(shutil.which("xelatex") is None, reason="needs xelatex, and fonts with its letters")
@pytest.mark.parametrize("language", TEX)
def test_no_letter_of_a_compiled_solution_is_missing(language: str, tmp_path: Path) -> None:
    target = tmp_path / "solution.tex"
    assert main(["explain", "crank-rocker", "-o", str(target), "--lang", language]) == 0
    command = ["xelatex", "-interaction=nonstopmode", "-halt-on-error", target.name]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    assert "Missing character" not in (tmp_path / "solution.log").read_text("utf-8", "replace")


def test_a_language_that_is_not_there_is_refused_with_those_that_are(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["explain", "crank-rocker", "--lang", "klingon"]) == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert all(word in told for word in ("klingon", "en", "zh_TW", "zh_CN"))


def _chart(name: str, *tokens: str) -> Page:
    scene = load(name)
    return Page(curves_of(scene, tokens, (Pace(scene.linkage.drive.speed, ""),)))


PAGES: dict[str, Callable[[], Page | PolarPage | ConstructionPage | ToleranceChart]] = {
    "chart": lambda: _chart("crank-rocker", "rocker.angle"),
    "chart of several": lambda: _chart("crank-rocker", "rocker.angular_velocity", "coupler.angular_velocity"),
    "polar diagram": lambda: PolarPage(load("press"), "2.A.force", (Pace(2.0, ""),)),
    "dead centres": lambda: ConstructionPage(load("crank-rocker"), kind="dead-centres"),
    "instant centres": lambda: ConstructionPage(load("crank-rocker"), kind="centres"),
    "tolerances": lambda: ToleranceChart(tolerance(load("crank-rocker"), 0.1)),
}


@pytest.mark.parametrize("name", PAGES)
def test_no_word_of_a_drawn_page_stays_behind(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    with spoken_pseudo(monkeypatch):
        drawn = PAGES[name]()
        text = f"{drawn.title} {drawn.words} {words_of(drawn.groups())}"
    assert plain_words(text, _KNOWN) == set()


READ_BY_PROGRAMS = {
    "the environment's language": ([], "Which way"),
    "a language that the command line names": (["--lang", "zh_TW"], "方向"),
}


@pytest.mark.parametrize(("words", "asked"), READ_BY_PROGRAMS.values(), ids=READ_BY_PROGRAMS)
def test_json_is_in_english_unless_the_command_line_names_a_language(
    words: list[str], asked: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("LANGUAGE", "zh_TW")
    assert main(["quiz", "press", "-n", "1", "--json", *words]) == 0
    (question,) = json.loads(capsys.readouterr().out)
    assert asked in question["question"]


@pytest.mark.parametrize("name", ["klann", "crank-rocker", "knee-cylinder"])
def test_closures_are_a_table_in_the_reader_s_language(
    name: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("LANGUAGE", "zh_TW")
    assert main(["closures", name]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) > 1
    assert plain_words(" ".join(lines)) == set()
    assert len({sum(2 if east_asian_width(one) in "WF" else 1 for one in line) for line in lines}) == 1
