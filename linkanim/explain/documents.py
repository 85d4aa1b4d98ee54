"""A worked solution as a document: HTML with MathML, LaTeX, or Markdown with LaTeX's formulas."""

from __future__ import annotations

import re
from collections.abc import Iterator
from html import escape

from linkanim.explain.drawing import svg, tikz
from linkanim.explain.lines import Item, Unknown, Words
from linkanim.explain.notation import LATEX, MATHML, plain_latex, typeset
from linkanim.explain.rows import rows
from linkanim.explain.solution import Solution

_STYLE = """
body { font: 16px/1.5 "Source Sans Pro", "Source Sans 3", "Helvetica Neue", Arial, sans-serif;
       color: #1b1f23; margin: 2rem auto; max-width: 56rem; padding: 0 1rem; }
h1 { font-size: 1.8rem; margin: 0; } p { margin: .3rem 0; }
h2 { font-size: 1.35rem; margin: 2rem 0 .5rem; border-bottom: 2px solid #d0d7de; }
h3 { font-size: 1.05rem; margin: 1.2rem 0 .2rem; } h2, h3 { break-after: avoid; }
.key { break-before: page; } @page { size: A4; margin: 16mm 14mm; }
@media print { body { margin: 0; max-width: none; font-size: 10.5pt; } }
"""
MATH_STYLE = """
math[display=block] { text-align: left; margin: .35rem 0 .35rem 1.5rem; overflow: auto hidden;
                      break-inside: avoid; }
math .rows > mtr > mtd { padding: .12em 0; text-align: left; }
math .rows > mtr > mtd:first-child { text-align: right; }
math .v { font-weight: bold; font-style: normal; } math .u { padding: 0; margin: 0; }
math .blank { border-bottom: 1px solid #57606a; }
figure.vectors { margin: .6rem 0; break-inside: avoid; } figure.vectors svg { max-width: 100%; height: auto; }
"""
_NAME = re.compile(r"\{([^{}]*)\}")
_INDEXED = re.compile(r"(?<=[^\W\d_])_?(\d+)$")


def html(found: Solution, *, blank: bool = False) -> str:
    """Return the solution as a page that needs nothing else; where `blank` its numbers are left open."""
    title = escape(found.title)
    head = f"<meta charset='utf-8'><title>{title}</title><style>{_STYLE}{MATH_STYLE}</style>"
    body = "\n".join(
        (f"<h1>{title}</h1>", f"<p>{_html_words(found.where)}</p>", *html_chapters(found, blank=blank))
    )
    return f"<!doctype html>\n<html lang='en'><head>{head}</head><body>\n{body}\n</body></html>\n"


def html_chapters(found: Solution, *, level: int = 2, blank: bool = False) -> Iterator[str]:
    """Yield the solution's chapters as HTML, headings from `level` on; the page needs `MATH_STYLE`."""
    for chapter in found.chapters:
        yield f"<h{level}>{escape(chapter.title)}</h{level}>"
        if chapter.title == "Vector loops":
            yield f"<figure class='vectors'>{svg(found)}</figure>"
        for step in chapter.steps:
            if step.title:
                yield f"<h{level + 1}>{_html_words(step.title)}</h{level + 1}>"
            yield from (_html_item(item, blank) for item in step.items)


def _html_item(item: Item, blank: bool) -> str:
    if isinstance(item, Words):
        return f"<p>{_html_words(item.text)}</p>"
    if isinstance(item, Unknown):
        return "<p>Unknown: " + ", ".join(f"<math>{typeset(e, MATHML)}</math>" for e in item.symbols) + "</p>"
    cells = "".join(
        f"<mtr><mtd>{row.left}</mtd><mtd><mo>=</mo>{row.right}</mtd></mtr>"
        for row in rows(item, MATHML, blank=blank)
    )
    return f"<math display='block'><mtable class='rows' displaystyle='true'>{cells}</mtable></math>"


def _html_words(text: str) -> str:
    def name(found: re.Match[str]) -> str:
        return _INDEXED.sub(r"<sub>\1</sub>", found[1])

    return _NAME.sub(name, escape(text))


def latex(found: Solution, *, blank: bool = False) -> str:
    """Return the solution as a document that pdflatex sets without any other file."""
    head = "\n".join((r"\documentclass[10pt,a4paper]{article}", *_PACKAGES, r"\begin{document}"))
    title = rf"\section*{{{plain_latex(found.title)}}}"
    body = "\n".join((title, _latex_words(found.where), *_latex_chapters(found, blank)))
    return f"{head}\n{body}\n\\end{{document}}\n"


_PACKAGES = (
    r"\usepackage[utf8]{inputenc}",
    r"\usepackage[T1]{fontenc}",
    r"\usepackage{lmodern,textcomp,amsmath,tikz}",
    r"\usepackage[margin=18mm]{geometry}",
    r"\setlength{\parindent}{0pt}",
    r"\allowdisplaybreaks",
)


def _latex_chapters(found: Solution, blank: bool) -> Iterator[str]:
    for chapter in found.chapters:
        yield rf"\section*{{{plain_latex(chapter.title)}}}"
        if chapter.title == "Vector loops":
            yield tikz(found)
        for step in chapter.steps:
            if step.title:
                yield rf"\subsection*{{{_latex_words(step.title)}}}"
            yield from (_latex_item(item, blank) for item in step.items)


def _latex_item(item: Item, blank: bool) -> str:
    if isinstance(item, Words):
        return _latex_words(item.text) + "\n"
    if isinstance(item, Unknown):
        return _unknown(item) + "\n"
    lines = " \\\\\n".join(f"{row.left} &= {row.right}" for row in rows(item, LATEX, blank=blank))
    return f"\\begin{{align*}}\n{lines}\n\\end{{align*}}"


def _latex_words(text: str) -> str:
    parts = _NAME.split(text)
    return "".join(LATEX.name(part) if n % 2 else plain_latex(part) for n, part in enumerate(parts))


def markdown(found: Solution, *, blank: bool = False) -> str:
    """Return the solution as Markdown, each line one formula between $ signs."""
    return "\n\n".join((f"# {found.title}", _plain(found.where), *_markdown_chapters(found, blank))) + "\n"


def _markdown_chapters(found: Solution, blank: bool) -> Iterator[str]:
    for chapter in found.chapters:
        yield f"## {chapter.title}"
        for step in chapter.steps:
            if step.title:
                yield f"### {_plain(step.title)}"
            yield from (_markdown_item(item, blank) for item in step.items)


def _markdown_item(item: Item, blank: bool) -> str:
    if isinstance(item, Words):
        return _plain(item.text)
    if isinstance(item, Unknown):
        return _unknown(item)
    found: list[str] = []
    for row in rows(item, LATEX, blank=blank):
        if row.left:
            found.append(f"{row.left} = {row.right}")
        else:
            found[-1] += f" = {row.right}"
    return "\n\n".join(f"${line}$" for line in found)


def _unknown(item: Unknown) -> str:
    return "Unknown: " + ", ".join(f"${typeset(e, LATEX)}$" for e in item.symbols)


def _plain(text: str) -> str:
    return _NAME.sub(r"\1", text)
