"""The manual: the Markdown pages beside this file, as a page that can be searched, or printed to a terminal.

`README.md` lists the pages in their order. They are written in the part of Markdown that `_html` reads:
headings, paragraphs, lists of one level, tables, code, pictures, links, bold, italics and code in a line. A
section is the text under one heading. A search ranks sections; the page's script ranks them in the same way.
"""

from __future__ import annotations

import re
import textwrap
from base64 import b64encode
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from html import escape, unescape
from pathlib import Path
from typing import NamedTuple

FOLDER = Path(__file__).parent
CONTENTS = "README"
_IN_HEADING, _IN_TITLE, _MOST_IN_TEXT = 10, 5, 5
"""The points for a word in a section's heading, in its chapter's title, and, at most, in its text."""
_LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\[\]]*\])*)\]\(([^)\s]+)\)")
_CODE = re.compile(r"(`+)(.+?)\1")
_ROW = re.compile(r"(?<!\\)\|")
_RULE = re.compile(r"\|(\s*:?-+:?\s*\|)+")


class ManualSection(NamedTuple):
    """The text under one heading: its chapter's file name and title, its level, heading and Markdown."""

    chapter: str
    title: str
    level: int
    heading: str
    body: str

    @property
    def anchor(self) -> str:
        """The name by which the page links to it."""
        return self.chapter if self.level == 1 else f"{self.chapter}--{slug(self.heading)}"


def slug(heading: str) -> str:
    """Return the anchor of a heading, as websites that show Markdown make it."""
    return re.sub(r"[^\w\- ]", "", _words(heading).lower()).replace(" ", "-")


@cache
def parts() -> tuple[tuple[str, tuple[str, ...]], ...]:
    """Return the manual's parts in order: the title of each, and the names of its chapters' files."""
    pages = re.split(r"^## ", (FOLDER / f"{CONTENTS}.md").read_text(encoding="utf-8"), flags=re.MULTILINE)
    named = ((part.partition("\n")[0], re.findall(r"\]\(([\w-]+)\.md\)", part)) for part in pages[1:])
    return tuple((name, tuple(chapters)) for name, chapters in named)


@cache
def sections() -> tuple[ManualSection, ...]:
    """Return all sections in the order of the chapters."""
    return tuple(one for _, chapters in parts() for chapter in chapters for one in _sections(chapter))


def _sections(chapter: str) -> Iterator[ManualSection]:
    title, lines, level, heading, in_code = "", [""], 0, "", False
    for line in (FOLDER / f"{chapter}.md").read_text(encoding="utf-8").splitlines():
        in_code ^= line.startswith("```")
        head = None if in_code else re.match(r"(#{1,3}) (.+)", line)
        if head is None:
            lines.append(line)
            continue
        if level:
            yield ManualSection(chapter, title, level, heading, "\n".join(lines).strip("\n"))
        level, heading, lines = len(head[1]), head[2], []
        title = title or _words(heading)
    yield ManualSection(chapter, title, level, heading, "\n".join(lines).strip("\n"))


def search(words: Sequence[str]) -> list[ManualSection]:
    """Return the sections that contain all words, upper or lower case, the most relevant first."""
    sought = [word for text in words for word in text.lower().split()]
    ranked = [(_rank(one, sought), one) for one in sections()]
    return [one for rank, one in sorted(ranked, key=lambda match: -match[0]) if rank]


def _rank(section: ManualSection, words: Sequence[str]) -> int:
    heading, title, text = _words(section.heading).lower(), section.title.lower(), _text(section)
    ranks = [
        _IN_HEADING * (word in heading) + _IN_TITLE * (word in title) + min(text.count(word), _MOST_IN_TEXT)
        for word in words
    ]
    return sum(ranks) if all(ranks) else 0


@cache
def _text(section: ManualSection) -> str:
    """Return a section's text without its heading, as a browser gives it to the page's script."""
    return unescape(re.sub(r"<[^>]*>", "", _html(section))).lower()


def page() -> str:
    """Return the whole manual as one page of HTML: no network, no other file, its search within it."""
    template = (FOLDER / "page.html").read_text(encoding="utf-8")
    titles = {one.chapter: one.title for one in sections() if one.level == 1}
    contents = "".join(
        f"<h2>{escape(part)}</h2><ul>{''.join(_entry(name, titles[name]) for name in chapters)}</ul>"
        for part, chapters in parts()
    )
    body = "".join(
        f'<section id="{one.anchor}" data-title="{escape(one.title)}">'
        f"<h{one.level}>{_inline(one.heading, one.chapter)}</h{one.level}>"
        f"<div>{_html(one)}</div></section>"
        for one in sections()
    )
    return template.replace("CONTENTS", contents).replace("SECTIONS", body)


def _entry(chapter: str, title: str) -> str:
    return f'<li><a href="#{chapter}">{escape(title)}</a></li>'


@cache
def _html(section: ManualSection) -> str:
    return "\n".join(_block(kind, lines, section.chapter) for kind, lines in _blocks(section.body))


def _blocks(body: str) -> Iterator[tuple[str, list[str]]]:
    """Yield the kind and the lines of each block; comments are left out."""
    lines = [line for line in body.splitlines() if not re.fullmatch(r"<!-- /?[\w-]+ -->", line)]
    at = 0
    while at < len(lines):
        first, end = lines[at], at + 1
        if first.startswith("```"):
            while not lines[end].startswith("```"):
                end += 1
            yield "code", lines[at + 1 : end]
            at = end + 1
            continue
        kind = _kind(first)
        if kind:
            while end < len(lines) and (
                _kind(lines[end]) == kind
                or (kind == "list" and lines[end].startswith("  "))
                or (
                    kind == "indented"
                    and not lines[end]
                    and end + 1 < len(lines)
                    and _kind(lines[end + 1]) == kind
                )
            ):
                end += 1
            yield kind, lines[at:end]
        at = end


def _kind(line: str) -> str:
    """Return the kind of block that a line outside code belongs to; empty for a blank line."""
    if not line.strip():
        return ""
    if line.startswith("    "):
        return "indented"
    if line.startswith("|"):
        return "table"
    return "list" if line.startswith("- ") else "paragraph"


def _block(kind: str, lines: list[str], chapter: str) -> str:
    match kind:
        case "code":
            return f"<pre>{escape(chr(10).join(lines))}</pre>"
        case "indented":
            return f"<pre>{escape(textwrap.dedent(chr(10).join(lines)))}</pre>"
        case "table":
            head, *rows = _cells(lines)
            top = " ".join(f"<th>{_inline(cell, chapter)}</th>" for cell in head)
            body = "\n".join(
                f"<tr>{' '.join(f'<td>{_inline(cell, chapter)}</td>' for cell in row)}</tr>" for row in rows
            )
            return f"<table><thead><tr>{top}</tr></thead>\n<tbody>{body}</tbody></table>"
        case "list":
            items = "\n".join(f"<li>{_inline(item, chapter)}</li>" for item in _items(lines))
            return f"<ul>{items}</ul>"
    return f"<p>{_inline(' '.join(lines), chapter)}</p>"


def _cells(lines: list[str]) -> list[list[str]]:
    """Return a table's cells row by row, without the rule under its head."""
    rows = [line for line in lines if not _RULE.fullmatch(line.strip())]
    return [[cell.strip().replace("\\|", "|") for cell in _ROW.split(row.strip())[1:-1]] for row in rows]


def _items(lines: list[str]) -> list[str]:
    return [" ".join(item.split()) for item in re.split(r"^- ", "\n".join(lines), flags=re.MULTILINE)[1:]]


def _inline(text: str, chapter: str) -> str:
    """Return a line's markup as HTML; code is taken out first, as nothing in it is markup."""
    kept: list[str] = []

    def keep(html: str) -> str:
        kept.append(html)
        return f"\0{len(kept) - 1}\0"

    text = _CODE.sub(lambda match: keep(f"<code>{escape(match[2])}</code>"), text)
    text = re.sub(r"\\([^A-Za-z0-9\s])", lambda match: keep(escape(match[1])), text)
    text = _LINK.sub(lambda match: _linked(match, chapter, keep), text)
    text = escape(text, quote=False)
    text = re.sub(r"\*\*(.+?)\*\*", r"<strong>\1</strong>", text)
    text = re.sub(r"\*(.+?)\*", r"<em>\1</em>", text)
    while "\0" in text:
        text = re.sub(r"\0(\d+)\0", lambda match: kept[int(match[1])], text)
    return text


def _linked(match: re.Match[str], chapter: str, keep: Callable[[str], str]) -> str:
    """Return a picture embedded in the page, or a link to another section; for other links the words.

    What is HTML already is kept; words are markup still.
    """
    picture, words, target = match.groups()
    if picture:
        data = b64encode((FOLDER / target).read_bytes()).decode()
        return keep(f'<img alt="{escape(words)}" src="data:image/png;base64,{data}">')
    file, _, place = target.partition("#")
    if file and not re.fullmatch(r"[\w-]+\.md", file):
        return words
    name = file.removesuffix(".md") or chapter
    return keep(f'<a href="#{f"{name}--{place}" if place else name}">') + words + keep("</a>")


def _words(text: str) -> str:
    """Return a line without its markup."""
    text = _LINK.sub(lambda match: f"[picture: {match[2]}]" if match[1] else match[2], text)
    text = re.sub(r"\*\*(.+?)\*\*|\*(.+?)\*", lambda match: match[1] or match[2], text)
    return re.sub(r"\\([^A-Za-z0-9\s])", r"\1", _CODE.sub(r"\2", text))


def printed(chapter: str, width: int) -> str:
    """Return a chapter as lines of text for a terminal."""
    return "\n\n".join(section_text(one, width) for one in sections() if one.chapter == chapter)


def section_text(section: ManualSection, width: int) -> str:
    """Return a section as lines of text, each of at most `width` letters where words allow."""
    heading = _words(section.heading)
    blocks = [f"{heading}\n{'=-~'[section.level - 1] * len(heading)}"]
    for kind, lines in _blocks(section.body):
        match kind:
            case "code" | "indented":
                blocks.append(textwrap.indent(textwrap.dedent("\n".join(lines)), "    "))
            case "table":
                blocks.append(_table_text(_cells(lines), width))
            case "list":
                blocks.append("\n".join(_wrapped(_words(item), width, "- ", "  ") for item in _items(lines)))
            case _:
                blocks.append(_wrapped(_words(" ".join(lines)), width))
    return "\n\n".join(blocks)


def _table_text(rows: list[list[str]], width: int) -> str:
    """Return a table in columns, or, where they are too wide, each row as its first cell and the others."""
    plain = [[_words(cell) for cell in row] for row in rows]
    widths = [max(map(len, column)) for column in zip(*plain, strict=True)]
    if sum(widths) + 2 * len(widths) <= width:
        lines = ("  ".join(map(str.ljust, row, widths)).rstrip() for row in plain)
        return "\n".join(lines)
    said = (["; ".join(cell for cell in row[1:] if cell), row[0]] for row in plain[1:])
    return "\n".join(f"{first}\n{_wrapped(rest, width, '    ', '    ')}" for rest, first in said)


def _wrapped(text: str, width: int, first: str = "", others: str = "") -> str:
    return textwrap.fill(
        text,
        width,
        initial_indent=first,
        subsequent_indent=others,
        break_long_words=False,
        break_on_hyphens=False,
    )
