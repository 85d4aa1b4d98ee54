"""A report as one page of HTML: everything in it, no script, fit to be printed on A4."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from html import escape

from linkanim.paper.findings import Sheet

_STYLE = """
:root { color-scheme: light; }
body { font: 15px/1.45 "Source Sans Pro", "Source Sans 3", "Helvetica Neue", Arial, sans-serif;
       color: #1b1f23; margin: 2rem auto; max-width: 60rem; padding: 0 1rem; }
h1 { font-size: 1.9rem; margin: 0 0 .2rem; } h2 { font-size: 1.35rem; margin: 2.2rem 0 .6rem;
     border-bottom: 2px solid #d0d7de; } h3 { font-size: 1.05rem; margin: 1.4rem 0 .3rem; }
p.source { color: #57606a; margin-top: 0; }
table { border-collapse: collapse; margin: .3rem 0 1rem; font-variant-numeric: tabular-nums; }
th, td { padding: .12rem .9rem .12rem 0; text-align: left; vertical-align: top; font-weight: 400; }
thead th { border-bottom: 1px solid #8c959f; font-weight: 600; } td.n, th.n { text-align: right; }
sub { font-size: .75em; line-height: 0; }
figure { margin: .6rem 0 1.2rem; break-inside: avoid; } figure svg { width: 100%; height: auto; }
section { break-inside: auto; } tr { break-inside: avoid; } h2, h3 { break-after: avoid; }
.two { columns: 2; column-gap: 2rem; }
@page { size: A4; margin: 16mm 14mm; }
@media print { body { margin: 0; max-width: none; font-size: 10.5pt; } .two { columns: 2; } }
"""
_LOWERED = re.compile(r"_\{([^}]*)\}")


def page(title: str, body: Iterable[str]) -> str:
    """Return the whole document; `title` is text, the body's parts are markup."""
    head = f"<meta charset='utf-8'><title>{escape(title)}</title><style>{_STYLE}</style>"
    parts = "\n".join(body)
    return f"<!doctype html>\n<html lang='en'><head>{head}</head><body>\n{parts}\n</body></html>\n"


def heading(level: int, text: str) -> str:
    """Return a heading."""
    return f"<h{level}>{escape(text)}</h{level}>"


def paragraph(text: str, kind: str = "") -> str:
    """Return a paragraph, of a class of the style where one is named."""
    return f"<p class='{kind}'>{escape(text)}</p>" if kind else f"<p>{escape(text)}</p>"


def facts(lines: Sequence[tuple[str, str]]) -> str:
    """Return labels and values as a table of two columns."""
    rows = "".join(f"<tr><th>{escape(label)}</th><td>{escape(value)}</td></tr>" for label, value in lines)
    return f"<table>{rows}</table>"


def figure(picture: str) -> str:
    """Return an SVG in the page."""
    return f"<figure>{picture}</figure>"


def sheet_tables(sheet: Sheet, speeds: Sequence[str]) -> Iterator[str]:
    """Yield the tables of one instant, a heading over each."""
    columns = "".join(f"<th class='n'>{escape(speed)}</th>" for speed in speeds)
    for title, rows in sheet.sections:
        if rows:
            yield heading(3, title)
            lines = (
                f"<tr><th>{escape(row.quantity.words.partition(': ')[2] or row.quantity.words)}</th>"
                f"<td>{symbol(row.quantity.symbol)}</td>"
                + "".join(f"<td class='n'>{escape(value)}</td>" for value in row.values)
                + f"<td>{escape(row.unit)}</td></tr>"
                for row in rows
            )
            head = f"<thead><tr><th></th><th></th>{columns}<th></th></tr></thead>"
            yield f"<table>{head}{''.join(lines)}</table>"


def symbol(text: str) -> str:
    """Return text with its subscripts, written _{B}, set as such."""
    return _LOWERED.sub(r"<sub>\1</sub>", escape(text))
