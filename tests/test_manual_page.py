"""The manual as a page and in the terminal: all of it is there, links lead somewhere, the search finds."""

from __future__ import annotations

import re
import shutil
import subprocess
import webbrowser
from html import unescape
from pathlib import Path

import pytest

from linkanim import manual
from linkanim.cli import main
from linkanim.cli.commands import manual as command

PAGES = sorted(manual.FOLDER.glob("*.md"))
PAGE = manual.page()


def test_the_contents_list_every_page_once() -> None:
    listed = [chapter for _, chapters in manual.parts() for chapter in chapters]
    assert sorted([*listed, manual.CONTENTS]) == [path.stem for path in PAGES]


def test_titles_in_the_contents_are_those_of_the_pages() -> None:
    contents = (manual.FOLDER / "README.md").read_text(encoding="utf-8")
    titles = dict(re.findall(r"^- \[(.+?)\]\((.+?)\.md\)", contents, re.MULTILINE))
    assert {stem: title for title, stem in titles.items()} == {
        one.chapter: one.heading for one in manual.sections() if one.level == 1
    }


def test_every_link_leads_to_a_section_and_every_anchor_is_one() -> None:
    anchors = re.findall(r'<section id="([^"]+)"', PAGE)
    assert len(anchors) == len(set(anchors))
    linked = set(re.findall(r'href="#([^"]+)"', PAGE))
    assert linked - set(anchors) == set()
    assert set(re.findall(r'(?:href|src)="(?!#|data:)([^"]*)"', PAGE)) == set()


CODE_IN_LINKS = {
    "alone": ("[`solve`](commands.md)", '<a href="#commands"><code>solve</code></a>'),
    "after code": (
        "`a` [the `b` of *it*](#c)",
        '<code>a</code> <a href="#here--c">the <code>b</code> of <em>it</em></a>',
    ),
    "to another place": ("`a` and [`b`](https://c.de)", "<code>a</code> and <code>b</code>"),
    "escaped": (r"`a` [\*b\* < c](d.md)", '<code>a</code> <a href="#d">*b* &lt; c</a>'),
}


@pytest.mark.parametrize(("markup", "html"), CODE_IN_LINKS.values(), ids=CODE_IN_LINKS)
def test_code_may_stand_in_the_words_of_a_link(markup: str, html: str) -> None:
    assert manual._inline(markup, "here") == html


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.stem)
def test_every_file_that_a_page_names_is_there(path: Path) -> None:
    names = re.findall(r"\]\((?!http)([^)#]+)", path.read_text(encoding="utf-8"))
    assert [name for name in names if not (path.parent / name).exists()] == []


def test_every_picture_is_shown_and_says_what_it_shows() -> None:
    text = "".join(path.read_text(encoding="utf-8") for path in PAGES)
    shown = {name: words for words, name in re.findall(r"!\[(.*?)\]\(pictures/(.+?)\)", text)}
    assert shown.keys() == {path.name for path in (manual.FOLDER / "pictures").iterdir()}
    assert all(len(words) > 20 for words in shown.values())


def plain(html: str) -> str:
    return " ".join(unescape(re.sub(r"<[^>]*>", " ", html)).split())


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.stem)
def test_markdown_is_read_as_others_read_it(path: Path) -> None:
    """A page's words, in order, and its headings, rows, items and links are those of another reader."""
    markdown_it = pytest.importorskip("markdown_it")
    text = re.sub(r"^<!-- .* -->$", "", path.read_text(encoding="utf-8"), flags=re.MULTILINE)
    theirs = markdown_it.MarkdownIt("commonmark", {"html": False}).enable("table").render(text)
    sections = list(manual._sections(path.stem))
    mine = "".join(
        f"<h{one.level}>{manual._inline(one.heading, path.stem)}</h{one.level}>{manual._html(one)}"
        for one in sections
    )
    for tag in ("h1", "h2", "h3", "tr", "td", "li", "pre", "strong", "em", "img", "p"):
        count = [len(re.findall(rf"<{tag}[ >]", html)) for html in (mine, theirs)]
        assert count[0] == count[1], tag
    assert plain(mine).replace(" ", "") == plain(theirs).replace(" ", "")


# What is looked for, and the chapter in which the first answer stands.
SOUGHT = {
    "toggle": "solver",
    "GIF size": "loops",
    "six-bar": "scenes",
    "torque": "own-linkage",
    "change point": "solver",
    "draft": "files",
    "exit codes": "commands",
    "photograph": "build",
    "bash completion": "commands",
}


@pytest.mark.parametrize("words", SOUGHT)
def test_the_search_answers(words: str) -> None:
    assert SOUGHT[words] in [one.chapter for one in manual.search([words])[:3]]


@pytest.mark.thinned(3)
@pytest.mark.slow
@pytest.mark.skipif(shutil.which("chromium") is None, reason="needs a browser")
@pytest.mark.parametrize("words", ["toggle", "GIF size", "six-bar"])
def test_the_page_s_search_is_that_of_the_terminal(words: str, tmp_path: Path) -> None:
    path = tmp_path / "manual.html"
    path.write_text(PAGE, encoding="utf-8")
    run = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={tmp_path / 'user'}"]
    address = f"{path.as_uri()}#search={words.replace(' ', '%20')}"
    done = subprocess.run(
        [*run, "--dump-dom", address], capture_output=True, text=True, check=True, timeout=120
    )
    found = done.stdout.partition('id="found"')[2].partition('id="contents"')[0]
    assert re.findall(r'href="#([^"]+)"', found) == [one.anchor for one in manual.search([words])[:40]]


def test_a_chapter_and_a_section_are_printed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["manual", "first-hour"]) == 0
    chapter = capsys.readouterr().out
    assert chapter.startswith("First hour\n==========\n")
    assert "![" not in chapter
    assert main(["manual", "GIF", "size"]) == 0
    section = capsys.readouterr().out
    assert section.startswith("[loops] GIF size\n")
    assert "\nAlso " in section
    assert max(map(len, section.splitlines())) <= 120


def test_every_chapter_is_printed_to_a_narrow_terminal() -> None:
    for _, chapters in manual.parts():
        for chapter in chapters:
            assert manual.printed(chapter, 60).count("\n") > 10


def test_a_word_that_is_nowhere_is_said(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["manual", "xylophone"]) == 2
    assert 'the manual has nothing on "xylophone"' in capsys.readouterr().err
    assert main(["manual", "torque", "-o", "x.html"]) == 2


def test_the_page_is_written_and_opened_where_there_is_a_screen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    opened: list[str] = []
    monkeypatch.setattr(command, "kept_as", lambda name: tmp_path / "data" / name)
    monkeypatch.setattr(webbrowser, "open", opened.append)
    monkeypatch.setattr(command, "_has_screen", lambda: False)
    assert main(["manual"]) == 0
    path = tmp_path / "data" / "manual.html"
    assert capsys.readouterr().out == f"{path}\n"
    assert path.read_text(encoding="utf-8") == PAGE
    assert opened == []
    monkeypatch.setattr(command, "_has_screen", lambda: True)
    assert main(["manual"]) == 0
    assert opened == [path.as_uri()]
    assert main(["manual", "-o", str(tmp_path / "mine.html")]) == 0
    assert (tmp_path / "mine.html").read_text(encoding="utf-8") == PAGE
    assert len(opened) == 1


def test_the_page_is_no_burden() -> None:
    assert len(PAGE) < 750_000
    assert sum(path.stat().st_size for path in (manual.FOLDER / "pictures").iterdir()) < 300_000
