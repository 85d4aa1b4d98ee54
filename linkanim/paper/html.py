"""A report as one page of HTML: everything in it, no script, fit to be printed on A4.

Chapters, figures and tables are numbered here, each in its order. Only the functions of this module make
markup; all else is text.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from html import escape
from itertools import chain, count
from typing import Literal

from linkanim.explain.documents import body_style, math_style
from linkanim.frozen import frozen
from linkanim.paper.findings import Column, Sheet, ValueTable
from linkanim.paper.svg import RIMMED, in_steps
from linkanim.units import signed
from linkanim.words import html_language, said

_STYLE = f"""
:root {{ color-scheme: light; }}{body_style("15px/1.45", 60)}\
h1, h2, h3 {{ break-after: avoid; }} h1 {{ font-size: 1.9rem; line-height: 1.2; margin: 0 0 .2rem; }}
h2 {{ font-size: 1.35rem; margin: 2rem 0 .6rem; border-bottom: 2px solid #d0d7de; }}
h3 {{ font-size: 1.05rem; margin: 1.2rem 0 .3rem; }}
p {{ margin: .4rem 0; }} p.source {{ color: #57606a; margin-top: 0; }}
nav ul {{ columns: 3; margin: .4rem 0 0; padding: 0; list-style: none; }} nav a {{ color: inherit; }}
table {{ border-collapse: collapse; margin: .3rem 0 .2rem; font-variant-numeric: tabular-nums; }}
th, td {{ padding: .12rem .9rem .12rem 0; text-align: left; vertical-align: top; font-weight: 400; }}
thead th {{ font-weight: 600; vertical-align: bottom; }}
thead tr:last-child > * {{ border-bottom: 1px solid #8c959f; }}
th[scope=colgroup] {{ text-align: center; }} .n {{ text-align: right; white-space: nowrap; }}
table.facts td {{ white-space: nowrap; }} table.values .n {{ padding-left: .9rem; padding-right: 0; }}
table.values {{ width: 100%; }} tbody th[scope=rowgroup] {{ font-weight: 600; padding: .4rem 0 .05rem; }}
caption, figcaption {{ text-align: left; color: #424a53; font-size: .92em; padding: .1rem 0 .25rem; }}
sub {{ font-size: .75em; line-height: 0; }}
p.note {{ color: #57606a; font-size: .92em; margin-top: 0; }}
p.seen {{ font-size: .92em; margin: 0; }}
.figures ul {{ columns: 3; margin: .2rem 0 0; padding: 0; list-style: none; font-size: .85em; }}
.figures li {{ break-inside: avoid; }}
.figures a {{ color: inherit; }}
.derivation {{ columns: 2; column-gap: 1.6rem; }} .derivation .step {{ break-inside: avoid; }}
.derivation .step h3 {{ font-size: .95em; margin: .5rem 0 .1rem; }}
p.equation {{ margin: .2rem 0 .2rem 1.4rem; }}
figure {{ margin: .5rem 0 .9rem; break-inside: avoid; }}
figure svg {{ width: 100%; height: auto; display: block; }}
.beside {{ display: grid; gap: 0 1.4rem; align-items: start; }}
.keep, .beside, .long tbody, caption, thead, tr {{ break-inside: avoid; }} caption {{ break-after: avoid; }}
tbody tr:nth-child(-n+2):not(:last-child), tbody tr:nth-last-child(2) {{ break-after: avoid; }}
@page {{ size: A4; margin: 15mm 14mm 16mm; FOOT }}
@media print {{ body {{ margin: 0; padding: 0; max-width: none; font-size: 9.5pt; line-height: 1.35; }}
  h1 {{ font-size: 17pt; }} h2 {{ font-size: 12.5pt; margin: .8rem 0 .3rem; }}
  table {{ font-size: 8.5pt; line-height: 1.25; }} th, td {{ padding-top: .02rem; padding-bottom: .02rem; }}
  .long::before {{ content: ''; display: block; height: 46mm; margin-bottom: -46mm; break-inside: avoid; }}
  figure {{ margin: .2rem 0 .4rem; }} }}
"""
_FOOT = (
    "@bottom-left { content: %s; font: 8pt sans-serif; color: #57606a; } "
    "@bottom-right { content: counter(page) ' / ' counter(pages); font: 8pt sans-serif; color: #57606a; }"
)
"""What stands at the foot of every page as it is printed."""
_LOWERED = re.compile(r"_\{([^}]*)\}")
_ATTRIBUTES = re.compile(r""" (?:id="[^"]*"|role='[^']*'|aria-label='[^']*')""")
"""Attributes that would be on the page twice: they are taken off an embedded picture."""
_APART = " style='break-before: page'"
_KEPT, _LONG = "<div class='keep'>", "<div class='long'>"
_LISTED = 3
"""The fewest figures that get a list of their own."""
_ROWS_KEPT = 7
"""The most rows of a table that is kept on one page."""


def embedded(picture: str, title: str, style: str = "") -> str:
    """Return an SVG as part of a page: its parts without ids, the whole with a title to be read aloud."""
    drawn = _ATTRIBUTES.sub("", picture[picture.index("<svg ") :])
    spoken = f"<svg role='img' aria-label='{escape(title)}' " + (f"style='{style}' " if style else "")
    # all words have such rims: it is said once
    return in_steps(drawn.replace(RIMMED, "")).replace("<svg ", spoken + RIMMED.lstrip() + " ", 1)


Numbers = Mapping[str, Iterator[int]]
"""The numbers of figures and tables that come next."""


@frozen
class FigurePart:
    """A picture as SVG, with its caption, which its number comes before; its greatest height in mm.

    `words` stand under the caption: what is seen in it. A `broad` one is as wide as the page.
    """

    picture: str
    caption: str
    highest: int = 140
    words: str = ""
    broad: bool = False

    def markup(self, numbers: Numbers) -> str:
        """Return it with its number."""
        n = next(numbers["figure"])
        title = said("Figure {number}. {caption}", number=n, caption=self.caption)
        spoken = said("{title}. {words}", title=title, words=self.words) if self.words else title
        drawn = embedded(self.picture, spoken, f"max-height: {self.highest}mm")
        below = paragraph(self.words, "seen") if self.words else ""
        told = f"<figcaption>{unbroken(title)}</figcaption>{below}"
        return f"<figure id='figure-{n}'>{drawn}{told}</figure>"


@frozen
class TablePart:
    """A table: its rows with their head, as markup, how many they are, its class, and notes below it."""

    caption: str
    rows: str
    count: int
    kind: str = ""
    notes: tuple[str, ...] = ()

    def markup(self, numbers: Numbers) -> str:
        """Return it with its number."""
        title = said("Table {number}. {caption}", number=next(numbers["table"]), caption=self.caption)
        table = f"<table class='{self.kind}'><caption>{symbol(title)}</caption>{self.rows}</table>"
        notes = "".join(paragraph(note, "note") for note in self.notes)
        return f"{_KEPT if self.count <= _ROWS_KEPT else _LONG}{table}{notes}</div>"


@frozen
class Beside:
    """Parts side by side, several in a row, each one part or several below each other.

    Their `shares` of the width are the same for all where none are given.
    """

    parts: tuple[Part | tuple[Part, ...], ...]
    across: int = 2
    shares: tuple[int, ...] = ()

    @property
    def columns(self) -> list[tuple[Part, ...]]:
        """The parts below each other, column by column."""
        return [one if isinstance(one, tuple) else (one,) for one in self.parts]

    def markup(self, numbers: Numbers) -> str:
        """Return them, each figure and table with its number."""
        inside = ("\n".join(_written(one, numbers) for one in column) for column in self.columns)
        widths = " ".join(f"{share}fr" for share in self.shares) or f"repeat({self.across}, 1fr)"
        grid = f"<div class='beside' style='grid-template-columns: {widths}'>"
        return "\n".join([grid, *(f"<div>{one}</div>" for one in inside), "</div>"])


Part = str | FigurePart | TablePart | Beside
"""A part of a chapter; a string is markup, which is written as it is."""


def page(
    title: str,
    head: Iterable[str],
    chapters: Iterable[tuple[str, Iterable[Part]]],
    *,
    apart: Collection[str] = (),
) -> str:
    """Return the whole document: what stands under its title, its contents, and its chapters by their titles.

    `head` is markup. Chapters whose titles are in `apart` begin a page of their own.
    """
    style = _STYLE.replace("FOOT", _FOOT % _css_text(title)) + math_style()
    meta = "<meta charset='utf-8'><meta name='viewport' content='width=device-width'>"
    start = f"{meta}<title>{escape(title)}</title><style>{style}</style>"
    numbers: Numbers = {"figure": count(1), "table": count(1)}
    chapters = [(name, list(parts)) for name, parts in chapters]
    numbered = [
        (n, name, [_written(part, numbers) for part in parts])
        for n, (name, parts) in enumerate(chapters, start=1)
    ]
    entries = "".join(f"<li><a href='#chapter-{n}'>{n} {symbol(name)}</a></li>" for n, name, _ in numbered)
    label = said("Contents")
    contents = f"<nav aria-label='{label}'><ul>{entries}</ul></nav>"
    listed = _figures_of(chapters)
    body = "\n".join([heading(1, title), *head, contents])
    sections = [
        f"<section id='chapter-{n}'{_APART * (name in apart)}>\n"
        f"{_sectioned(heading(2, f'{n} {name}'), written)}\n</section>"
        for n, name, written in numbered
        if written
    ]
    if listed and all(isinstance(part, str) for part in chapters[-1][1]):
        # a short end and the list of figures stand on one page
        sections[-1:] = [_KEPT, *sections[-1:], listed, "</div>"]
    else:
        sections.append(listed)
    inside = "\n".join(sections)
    return (
        f"<!doctype html>\n<html lang='{html_language()}'><head>{start}</head><body>\n"
        f"<header>\n{body}\n</header>\n<main>\n{inside}\n</main>\n</body></html>\n"
    )


def _figures_of(chapters: Iterable[tuple[str, Iterable[Part]]]) -> str:
    """Return the list of figures, in the order in which they are numbered; nothing of a few."""
    captions = [part.caption for _, parts in chapters for part in _figures_in(parts)]
    if len(captions) < _LISTED:
        return ""
    numbered = enumerate(captions, 1)
    entries = "".join(f"<li><a href='#figure-{n}'>{n} {unbroken(one)}</a></li>" for n, one in numbered)
    title = said("Figures")
    return f"<nav class='figures keep' aria-label='{title}'>{heading(2, title)}<ul>{entries}</ul></nav>"


def _figures_in(parts: Iterable[Part]) -> Iterator[FigurePart]:
    for part in parts:
        if isinstance(part, FigurePart):
            yield part
        elif isinstance(part, Beside):
            yield from _figures_in(chain(*part.columns))


def _sectioned(title: str, parts: list[str]) -> str:
    """Return a chapter whose heading stands on one page with its first part, or with its first rows."""
    first, *others = parts
    if first.startswith(_LONG):
        return "\n".join([title, *parts])
    return "\n".join([f"<div class='keep'>\n{title}\n{first}\n</div>", *others])


def _css_text(text: str) -> str:
    """Return text in quotes as a style sheet has it."""
    return "'" + re.sub(r"[^\w .,-]", lambda match: f"\\{ord(match[0]):x} ", text) + "'"


def _written(part: Part, numbers: Numbers) -> str:
    return part if isinstance(part, str) else part.markup(numbers)


def heading(level: int, text: str) -> str:
    """Return a heading."""
    return f"<h{level}>{symbol(text)}</h{level}>"


def paragraph(text: str, kind: str = "") -> str:
    """Return a paragraph, of a class of the style where one is named."""
    return f"<p class='{kind}'>{unbroken(text)}</p>" if kind else f"<p>{unbroken(text)}</p>"


def unbroken(text: str) -> str:
    """Return text that breaks no line about an equals sign."""
    return symbol(text).replace(" = ", "&nbsp;=&nbsp;")


def facts(caption: str, lines: Sequence[tuple[str, str]], columns: Literal[1, 2, 3]) -> TablePart:
    """Return labels and values as a table, in one, two or three pairs of columns."""
    high = -(-len(lines) // columns)
    cells = [f"<th scope='row'>{symbol(label)}</th><td>{symbol(value)}</td>" for label, value in lines]
    rows = "".join(f"<tr>{''.join(cells[n::high])}</tr>" for n in range(high))
    return TablePart(caption, f"<tbody>{rows}</tbody>", high, "facts")


def table(caption: str, heads: Sequence[str], rows: Sequence[Sequence[str]]) -> TablePart:
    """Return rows of text under their heads."""
    head = "".join(f"<th scope='col'>{symbol(one)}</th>" for one in heads)
    lines = "".join(f"<tr>{''.join(f'<td>{symbol(cell)}</td>' for cell in row)}</tr>" for row in rows)
    return TablePart(caption, f"<thead><tr>{head}</tr></thead><tbody>{lines}</tbody>", len(rows))


def sheet_parts(sheet: Sheet, length_unit: str, place: str, speeds: Sequence[str]) -> Iterator[TablePart]:
    """Yield the tables of every quantity at one instant, where the input is at a place."""
    heads = "".join(f"<th class='n' scope='col'>{escape(speed)}</th>" for speed in speeds)
    quantity, symbol_, unit = (
        f"<th scope='col'>{one}</th>" for one in (said("quantity"), said("symbol"), said("unit"))
    )
    head = f"<thead><tr>{quantity}{symbol_}{heads}{unit}</tr></thead>"
    for title, rows in sheet.items():
        if rows:
            lines = "".join(
                # without what the heading says
                f"<tr><th scope='row'>{escape(one.measure)}</th><td>{symbol(one.symbol)}</td>"
                f"{_numbers(values)}<td>{escape(one.display_unit(length_unit))}</td></tr>"
                for one, values in rows
            )
            yield TablePart(
                said("{title}, {place}", title=title, place=place), f"{head}<tbody>{lines}</tbody>", len(rows)
            )


def _numbers(values: Iterable[str]) -> str:
    return "".join(f"<td class='n'>{escape(value)}</td>" for value in values)


def values_part(table: ValueTable) -> TablePart:
    """Return a table of the hand-out."""
    columns, width = table.columns, len(table.columns) + 1
    groups = "".join(
        f"<tbody>{_group_head(title, width)}"
        + "".join(f"<tr><th scope='row'>{symbol(label)}</th>{_numbers(row)}</tr>" for label, row in rows)
        + "</tbody>"
        for title, rows in table.groups
    )
    lines = sum(len(rows) + 1 for _, rows in table.groups)
    title, rows = (
        said("{title}: {part}", title=table.title, part=table.about),
        _head(table.head, columns) + groups,
    )
    return TablePart(title, rows, lines, "values", table.notes)


def _spanning(columns: int) -> str:
    return f"scope='colgroup' colspan='{columns}'" if columns > 1 else "class='n' scope='col'"


def _group_head(title: str, width: int) -> str:
    return f"<tr><th colspan='{width}' scope='rowgroup'>{symbol(title)}</th></tr>" if title else ""


def _head(first: str, columns: tuple[Column, ...]) -> str:
    """Return the head of a table: symbols with their units, and the speeds below them."""
    paced = any(one.pace for one in columns)
    across: dict[str, list[Column]] = {}
    for one in columns:
        across.setdefault(one.measure, []).append(one)
    cells = "".join(
        f"<th {_spanning(len(some))}>"
        f"{symbol(some[0].symbol)}{f' ({escape(some[0].unit)})' if some[0].unit else ''}</th>"
        for some in across.values()
    )
    below = "".join(
        f"<th class='n' scope='col'>{symbol(one.pace.words)}</th>" if one.pace else "<td></td>"
        for one in columns
    )
    title = f"<th scope='col'>{escape(first)}</th>" if first else "<td></td>"
    second = f"<tr><td></td>{below}</tr>" if paced else ""
    return f"<thead><tr>{title}{cells}</tr>{second}</thead>"


def symbol(text: str) -> str:
    """Return text with its subscripts, written _{B}, set as such, and true minus signs before its numbers."""
    return _LOWERED.sub(r"<sub>\1</sub>", escape(signed(text)))
