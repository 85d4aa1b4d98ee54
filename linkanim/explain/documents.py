"""Print a worked solution as a document: HTML with MathML, LaTeX, or Markdown with LaTeX's formulas.

Its parts, in reading order:

- The rows of one item of a worked solution in a notation: sides of equations, one below the other.
- A worked solution as a document: HTML with MathML, LaTeX, or Markdown with LaTeX's formulas.
"""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from base64 import b64encode
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cache, reduce
from html import escape
from itertools import chain, groupby, pairwise
from pathlib import Path
from unicodedata import east_asian_width

from linkanim.explain.formula import LATEX, MATHML, Formula, Notation, Symbol, latex_has, plain_latex, typeset
from linkanim.explain.solution import FORCES, INPUT_TITLE, RESULT_DIGITS, Solution
from linkanim.explain.steps import (
    HALF,
    MARKED,
    Equation,
    Given,
    Item,
    Outcome,
    Step,
    System,
    Unknown,
    ValueLine,
    decimals,
    rounded,
)
from linkanim.explain.tikz import free_tikz, tikz
from linkanim.words import html_language, said, said_many

# The rows of one item of a worked solution in a notation: sides of equations, one below the other.

_SHORT, _MIDDLING = 2, 6
"""The most symbols of a formula in one row with its numbers and its value, or in one with its value."""


EquationRow = tuple[str, str]
"""One row of an aligned equation: what stands left of the equals sign, and what stands right of it."""


def rows(item: Item, how: Notation, *, blank: bool = False) -> Iterator[EquationRow]:
    """Yield the rows of an item, if it has any; where `blank`, the numbers asked for are left open."""
    match item:
        case ValueLine():
            yield from _line(item, how, blank)
        case Equation():
            yield typeset(item.left, how), typeset(item.right, how)
        case System():
            yield from _system(item, how, blank)


def _line(line: ValueLine, how: Notation, blank: bool) -> Iterator[EquationRow]:
    """Yield the rows of a line: short formulas share a row with their numbers and value."""
    sides = [typeset(line.formula, how)] if line.formula.symbolic else []
    if not blank and line.formula.operation != "leaf":
        sides.append(typeset(line.formula, how, numbers=True))
    sides.append((how.blank if blank else how.number(line.value.shown, False)) + how.unit(line.unit))
    leaves = len(list(line.formula.leaves))
    together = 3 if leaves <= _SHORT else 2 if leaves <= _MIDDLING else 1
    left = typeset(line.value, how)
    # the last row is the fullest one, so that the numbers and their value stand together
    for begin, end in pairwise(
        [0, *range(len(sides) % together or together, len(sides), together), len(sides)]
    ):
        yield left, reduce(lambda a, b: how.infix("=", a, b), sides[begin:end])
        left = ""


def _system(system: System, how: Notation, blank: bool) -> Iterator[EquationRow]:
    unknowns = how.matrix([[how.symbol(unknown)] for unknown in system.unknowns])
    ways = [(system.formulas, False)] if system.formulas else []
    if not blank:
        worked_out = any(entry.operation != "leaf" for row in system.formulas for entry in row)
        ways += [(system.formulas, True)] * worked_out + [(system.values, True)]
    for entries, numbers in ways:
        set_ = [[typeset(entry, how, numbers=numbers) for entry in row] for row in entries]
        yield how.matrix([row[:-1] for row in set_]) + unknowns, how.matrix([row[-1:] for row in set_])


# A worked solution as a document: HTML with MathML, LaTeX, or Markdown with LaTeX's formulas.


def body_style(font: str, wide: int) -> str:
    """Return the CSS of a page's text: `font` is its size and line height, `wide` its width in rem."""
    return f"""
body {{ font: {font} "Helvetica Neue", Arial, "Liberation Sans", sans-serif;
       color: #1b1f23; margin: 2rem auto; max-width: {wide}rem; padding: 0 1rem; }}
"""


_STYLE = f"""{body_style("16px/1.5", 56)}\
h1 {{ font-size: 1.8rem; margin: 0; }} p {{ margin: .3rem 0; }} sub {{ line-height: 0; }}
h2 {{ font-size: 1.35rem; margin: 2rem 0 .5rem; border-bottom: 2px solid #d0d7de; }}
h3 {{ font-size: 1.05rem; margin: 1.2rem 0 .2rem; }} h2, h3 {{ break-after: avoid; }}
@page {{ size: A4; margin: 11mm 13mm; }}
@media print {{ body {{ margin: 0; padding: 0; max-width: none; font-size: 8.5pt; line-height: 1.2; }}
  h1 {{ font-size: 15pt; }} h2 {{ font-size: 11.5pt; margin: .4rem 0 .1rem; border-width: 1px; }}
  h3 {{ font-size: 9pt; margin: .2rem 0 0; }}
  math[display=block] {{ font-size: 8pt; overflow: visible; margin: .1rem 0 .1rem .6rem !important; }}
  math .rows > mtr > mtd {{ padding: .1em 0 !important; }}
  p:has(+ math) {{ break-after: avoid; }} p, li {{ font-size: 8.5pt; margin: 0; }}
  .steps {{ display: grid; grid-template-columns: 1fr 1fr; gap: 0 1rem; align-items: start; }}
  .steps > .wide {{ grid-column: 1 / -1; }} .steps > .short {{ break-inside: avoid; }}
  ul.given {{ columns: 3 !important; }} ul.results {{ columns: 5 !important; }}
  figure.vectors svg {{ max-height: 66mm; width: auto; }} }}
"""
_SHEET = """
.key { break-before: page; }
.signed { display: flex; gap: 1.5rem; margin: .8rem 0; } .signed span { flex: 1;
  border-bottom: 1px solid #57606a; }
.signed span:first-child { flex: 2; }
.task { display: grid; grid-template-columns: 3fr 1.3fr; gap: 0 1.2rem; align-items: start; }
.task ul.given { columns: 1 !important; padding: 0; margin: 0; } .task figure.vectors { margin: 0; }
.question { display: flex; flex-direction: column; break-inside: avoid; margin: .8rem 0 0; }
.question .room { flex: 1; min-height: 5rem; }
.marks { float: right; color: #57606a; padding-left: 1rem; }
.hint { color: #57606a; }
.answers { display: flex; flex-wrap: wrap; gap: .3rem 1.6rem; } .answers span { white-space: nowrap; }
@media print { .page { display: flex; flex-direction: column; min-height: 272mm; break-after: page; }
  .page p, .page li { font-size: 10pt; line-height: 1.3; } .question .room { min-height: 12mm; }
  .task figure.vectors svg { width: 100%; max-height: 95mm; } .page .answers math { font-size: 11pt; } }
"""
"""The style of an exercise's sheets."""
_MATH = """
math { font-family: "Linkanim Math", "Latin Modern Math", "STIX Two Math", math; }
math[display=block] { width: fit-content; max-width: 100%; margin: .35rem 0 .35rem 1rem;
                      overflow: auto hidden; }
math .rows > mtr > mtd { padding: .22em 0; text-align: left; } math .rows > mtr { break-inside: avoid; }
math .rows > mtr > mtd:first-child { text-align: right; }
math .v { font-weight: bold; font-style: normal; } math .u { padding: 0; margin: 0; }
math .lit { background: #ffd8a8; border-radius: 2px; }
svg .lit path { fill: #d9480f; fill-opacity: 1; } svg [data-i], math [data-y] { cursor: pointer; }
math .blank { border-bottom: 1px solid #57606a; }
ul.given { columns: 2; list-style: none; padding: 0 0 0 1rem; margin: .35rem 0; }
ul.given li { break-inside: avoid; }
figure.vectors { margin: .6rem 0; break-inside: avoid; overflow-x: auto; }
figure.vectors svg { max-width: 100%; height: auto; }
"""


@cache
def math_style() -> str:
    """Return the CSS of formulas, with their font in it, whose brackets stretch."""
    face = (Path(__file__).parent / "faces/LinkanimMath.woff2").read_bytes()
    source = f"url(data:font/woff2;base64,{b64encode(face).decode()}) format('woff2')"
    return f"\n@font-face {{ font-family: 'Linkanim Math'; src: {source}; }}{_MATH}"


_INDEXED = re.compile(r"(?<=[^\W\d_])_?(\d+)((?:&#x27;)*)$")


def _no_figure(_: Solution) -> str:
    return ""


def _marks(count: int) -> str:
    return said_many("{count} mark", "{count} marks", count)


_DERIVED = ("Positions", "The same by the half-angle form", "Kinematic coefficients")
"""The chapters of a solution that are a derivation, in symbols alone."""


def _in_symbols(item: Item) -> Item:
    """Return an item without its numbers: a line as an equation."""
    return Equation(item.value, item.formula) if isinstance(item, ValueLine) else item


def _sort(item: Item) -> type[Item]:
    """Return an item's sort: neighbours of one sort are set in one block; a line counts as an equation."""
    return Equation if isinstance(item, ValueLine) else type(item)


def _by_owner(solution: Solution) -> Iterator[Outcome]:
    """Yield the results, link by link and joint by joint."""
    owners: dict[str, list[Outcome]] = {}
    for result in solution.results:
        if result.value.symbol is not None:
            owners.setdefault(result.token.partition(".")[0], []).append(result)
    return chain.from_iterable(owners.values())


class DocumentForm(ABC):
    """One kind of document: how its parts are written, and what of a solution stands in it.

    Names of joints are marked in headings and in text. `figure` draws the loops, `construction` how the
    linkage was made, `free` its bodies free: a page leaves them to a module that prints pictures.
    """

    new_page = ""
    """What begins a page."""

    def __init__(
        self,
        how: Notation,
        figure: Callable[[Solution], str] = _no_figure,
        construction: Callable[[Solution], str] = _no_figure,
        free: Callable[[Solution], str] = _no_figure,
    ) -> None:
        self.how, self.figure, self.construction, self.free = how, figure, construction, free

    @abstractmethod
    def page(self, title: str, body: str) -> str:
        """Return a whole document."""

    @abstractmethod
    def heading(self, level: int, text: str) -> str:
        """Return a heading."""

    @abstractmethod
    def text(self, words: str) -> str:
        """Return words as markup."""

    @abstractmethod
    def aligned(self, rows: list[EquationRow]) -> str:
        """Return the rows of equations, one below the other."""

    @abstractmethod
    def listed(self, items: list[tuple[str, str]]) -> str:
        """Return a list of formulas with the words for each."""

    def paragraph(self, markup: str) -> str:
        """Return a paragraph."""
        return markup

    def inline(self, formula: str) -> str:
        """Return a formula within words."""
        return f"${formula}$"

    def joined(self, steps: list[str]) -> str:
        """Return the steps of a chapter as one."""
        return "\n\n".join(steps)

    # Of an exercise.

    def beside(self, figure: str, given: str) -> str:
        """Return the figure, and what is given beside it."""
        return "\n\n".join(filter(None, (figure, given)))

    def question(self, number: int, text: str, marks: int, hint: str, answers: str, formulas: str) -> str:
        """Return a question, with the numbers to be found; `formulas` stand in place of room to write."""
        head = f"**{number}.** {text} ({_marks(marks)})"
        return "\n\n".join(part for part in (head, hint, formulas, answers) if part)

    def answers(self, formulas: list[str]) -> str:
        """Return the numbers to be found, with room to write."""
        return self.listed([(one, "") for one in formulas])

    def named(self, most: int) -> str:
        """Return the line for name and marks, by the most of them."""
        return " ".join(f"{one}: ____" for one in _signed(most))

    def sheet(self, pages: list[str]) -> str:
        """Return the pages of a sheet as one."""
        return "\n\n".join(pages)

    # What of a solution stands in a document.

    def document(self, solution: Solution) -> str:
        """Return a worked solution as a document."""
        parts = [
            self.heading(1, solution.title),
            self.where(solution),
            *self.chapters(solution),
            *self._results(solution),
        ]
        return self.page(solution.title, "\n\n".join(part for part in parts if part))

    def _results(self, solution: Solution) -> Iterator[str]:
        """Yield the list of all results, with its heading."""
        yield self.heading(2, said("All results"))
        solved = solution.solved
        yield self.listed([self.entry(short(one.value, solved), one.unit) for one in _by_owner(solution)])

    def where(self, solution: Solution) -> str:
        """Return the paragraph that says where the input is."""
        called, place = solution.where
        symbol = self.text(called) if isinstance(called, str) else self.inline(self.how.symbol(called))
        return self.paragraph(said("At {place}.", place=f"{symbol} = {self.text(place)}"))

    def chapters(self, solution: Solution) -> Iterator[str]:
        """Yield the parts of a solution."""
        for chapter in solution.chapters:
            yield self.heading(2, chapter.title)
            drawn = self.figure(solution) if chapter is solution.loop_chapter else ""
            if chapter is solution.synthesis_chapter:
                yield self.construction(solution)
            if chapter.title == said(FORCES) and solution.bodies:
                yield self.free(solution)
            yield self.steps(chapter.steps, drawn=drawn)

    def derivation(self, solution: Solution) -> Iterator[str]:
        """Yield the parts of the derivation in symbols: positions, half angles, differentiated loops."""
        titles = [*map(said, _DERIVED)]
        for chapter in solution.chapters:
            if chapter.title in titles:
                yield self.heading(3, chapter.title)
                steps = (
                    replace(step, items=tuple(map(_in_symbols, step.items)))
                    for step in chapter.steps
                    if step.title != said(INPUT_TITLE)
                )
                yield self.steps(steps, blank=True)

    def steps(self, steps: Iterable[Step], *, blank: bool = False, drawn: str = "") -> str:
        """Return steps, behind a figure if there is one; if `blank`, their numbers are left open."""
        return self.joined([part for part in (drawn, *(self.step(one, blank) for one in steps)) if part])

    def step(self, step: Step, blank: bool = False) -> str:
        """Return one step."""
        parts = [self.heading(3, step.title)] if step.title else []
        for _, items in groupby(step.items, _sort):
            parts += self.set_items([*items], blank)
        return "\n\n".join(parts)

    def set_items(self, items: list[Item], blank: bool = False) -> Iterator[str]:
        """Yield the parts of neighbours of one sort: equations in one block, sentences one by one."""
        if given := [item for item in items if isinstance(item, Given)]:
            yield self.listed([self.entry(item.value, item.unit, item.words) for item in given])
        if set_rows := [row for item in items for row in rows(item, self.how, blank=blank)]:
            yield self.aligned(set_rows)
        for item in items:
            if isinstance(item, str):
                yield self.paragraph(self.text(item))
            elif isinstance(item, Unknown):
                symbols = (self.inline(typeset(e, self.how)) for e in item.symbols)
                yield self.paragraph(
                    said("{what}: {these}", what=self.text(item.words), these=", ".join(symbols))
                )

    def entry(self, value: Formula, unit: str, words: str = "") -> tuple[str, str]:
        """Return an entry of a list: a symbol = a number with its unit, and words."""
        number = self.how.number(value.shown, False) + self.how.unit(unit)
        return self.inline(self.how.infix("=", typeset(value, self.how), number)), words


def short(value: Formula, solved: Mapping[Symbol, float]) -> Formula:
    """Return a value in the digits of a result.

    A result has the digits of the solver's value. Where its line does not round to these it has one more, in
    which both are one number, or else fewer.
    """
    true = solved.get(value.symbol, value.value) if value.symbol and value.value else value.value
    there = len(value.shown.partition(".")[2])
    usual = min(decimals(true, RESULT_DIGITS), there)
    tried = (usual, min(usual + 1, there), *range(usual - 1, -1, -1))
    right = (n for n in tried if abs(float(rounded(true, n)) - value.value) <= HALF * 10**-n)
    return replace(value, shown=rounded(true, next(right, 0)))


_LIGHTS = r"""
// A symbol lights the part of the figure that has its index, and a part its symbols: by mouse, touch or keys.
(() => {
  const none = /^(?:[bkψβℓπλ]|a\d)/, found = new Set();
  const kinds = { r: /^[rR]/, w: /^[θωαhmPI]/, s: /^[sfgtST]/ };
  const kind = text => Object.keys(kinds).find(one => kinds[one].test(text)) ?? 'j';
  for (const e of document.querySelectorAll('math msub, math msubsup')) {
    if (e.parentElement.closest('msub, msubsup')) continue;
    const letter = e.children[0].textContent, index = kind(letter) + e.children[1].textContent;
    const part = document.querySelector(`svg [data-i~="${CSS.escape(index)}"]`);
    if (!part || none.test(letter + e.children[1].textContent)) continue;
    e.dataset.y = index;
    if (!found.has(e.textContent)) { found.add(e.textContent); e.tabIndex = 0; }
  }
  for (const e of document.querySelectorAll('svg [data-i]')) {
    e.tabIndex = 0; e.setAttribute('role', 'img');
    e.setAttribute('aria-label', e.querySelector('text')?.textContent ?? e.dataset.i.slice(1).split(' ')[0]);
  }
  const show = event => {
    for (const e of document.querySelectorAll('.lit')) e.classList.remove('lit');
    const at = event.target.closest?.('[data-y], [data-i]');
    for (const index of (at?.dataset.y || at?.dataset.i || '').split(' ').filter(Boolean)) {
      const i = CSS.escape(index), both = `[data-y="${i}"], svg [data-i~="${i}"]`;
      for (const e of document.querySelectorAll(both)) e.classList.add('lit');
    }
  };
  for (const kind of ['pointerover', 'pointerdown', 'focusin']) document.addEventListener(kind, show);
})();
"""


_ROW, _TAG = re.compile(r"<mtr>(.*?)</mtr>", re.S), re.compile(r"<[^>]*>|&[^;]*;")
_HALF_LINE = 62
"""The most letters of a formula on half a page's width."""


_LIT = """<style>
[data-of] { cursor: default; } math mrow.lit { background: #ffe3f1; color: #a8005a; }
svg g.lit path, svg text.lit { fill: #e6007e; }
</style><script>
(() => {
  // a symbol of a force, its arrows and its name light up together
  const same = new Map();
  for (const one of document.querySelectorAll("mrow[data-of], g[data-of], text[data-of^='vector:']")) {
    same.set(one.dataset.of, [...(same.get(one.dataset.of) ?? []), one]);
    const light = (on) => same.get(one.dataset.of).forEach((other) => other.classList.toggle("lit", on));
    one.addEventListener("pointerenter", () => light(true));
    one.addEventListener("pointerleave", () => light(false));
  }
})();
</script>
"""


def _html_words(text: str) -> str:
    return MARKED.sub(lambda part: _INDEXED.sub(r"<sub>\1</sub>\2", part[1]), escape(text))


def _lit_symbol(symbol: Symbol) -> str:
    """Return a symbol in MathML; of a force or moment it says which arrow it goes with."""
    written = MATHML.symbol(symbol)
    if symbol.letter not in _PULLS or not symbol.sub:
        return written
    index = symbol.sub.rstrip("xy").rstrip(",")
    return f"<mrow data-of='vector:{symbol.letter}_{escape(index)}'>{written}</mrow>"


def _signed(most: int) -> tuple[str, str, str]:
    """Return what the line at the top of a sheet asks for."""
    return said("Name"), said("Date"), said("Marks, of {most}", most=most)


_PULLS = frozenset("FNQZCM")


class _Html(DocumentForm):
    new_page = "<div class='key'></div>"

    def __init__(
        self,
        *figures: Callable[[Solution], str],
        lit: bool = False,
    ) -> None:
        super().__init__(replace(MATHML, symbol=_lit_symbol) if lit else MATHML, *figures)
        self._last = f"\n{_LIT}" if lit else ""

    def page(self, title: str, body: str) -> str:
        style = _STYLE + _SHEET if "class='page'" in body else _STYLE
        head = f"<meta charset='utf-8'><title>{escape(title)}</title><style>{style}{math_style()}</style>"
        lights = "\n".join(map(str.strip, _LIGHTS.splitlines()[2:]))
        script = f"<script>{lights}</script>\n" if " data-i=" in body else ""
        inside = f"<body>\n<main>\n{body}{self._last}\n</main>\n{script}</body>"
        return f"<!doctype html>\n<html lang='{html_language()}'><head>{head}</head>{inside}</html>\n"

    def heading(self, level: int, text: str) -> str:
        return f"<h{level}>{_html_words(text)}</h{level}>"

    def text(self, words: str) -> str:
        return _html_words(words)

    def paragraph(self, markup: str) -> str:
        return f"<p>{markup}</p>"

    def inline(self, formula: str) -> str:
        return f"<math>{formula}</math>"

    def aligned(self, rows: list[EquationRow]) -> str:
        cells = "".join(f"<mtr><mtd>{left}</mtd><mtd><mo>=</mo>{right}</mtd></mtr>" for left, right in rows)
        return f"<math display=block><mtable class=rows displaystyle=true>{cells}</mtable></math>"

    def listed(self, items: list[tuple[str, str]]) -> str:
        cells = "".join(f"<li>{formula} {_html_words(words)}</li>" for formula, words in items)
        kind = "given" if any(words for _, words in items) else "given results"
        return f"<ul class='{kind}'>{cells}</ul>"

    def joined(self, steps: list[str]) -> str:
        """Return a chapter's steps; on paper, steps with short formulas are two side by side."""
        cells = []
        for step in steps:
            # a step with nothing but words is wide
            longest = max((len(_TAG.sub("", row)) for row in _ROW.findall(step)), default=_HALF_LINE + 1)
            drawn = step.startswith("<figure")
            kind = "drawn" if drawn else "wide" if longest > _HALF_LINE else "short"
            rows = f" style='grid-row: span {max(len(steps) - 1, 1)}'" if drawn else ""
            cells.append(f"<div class='step {kind}'{rows}>\n{step}\n</div>")
        return "<div class='steps'>\n" + "\n".join(cells) + "\n</div>"

    def beside(self, figure: str, given: str) -> str:
        return f"<div class='task'>\n{figure}\n<div>{given}</div>\n</div>"

    def question(self, number: int, text: str, marks: int, hint: str, answers: str, formulas: str) -> str:
        """Return a question: on paper those of a page share the room that is left, by their marks."""
        worth = f"<span class='marks'>{_marks(marks)}</span>"
        head = f"<p>{worth}<b>{number}</b> {text}</p>"
        clue = f"<p class='hint'>{hint}</p>" if hint else ""
        room = formulas or "<div class='room'></div>"
        grows = "" if formulas else f" style='flex-grow: {marks}'"
        return f"<div class='question'{grows}>\n{head}{clue}\n{room}\n{answers}\n</div>"

    def answers(self, formulas: list[str]) -> str:
        return f"<p class='answers'>{''.join(f'<span>{one}</span>' for one in formulas)}</p>"

    def named(self, most: int) -> str:
        return f"<p class='signed'>{''.join(f'<span>{one}</span>' for one in _signed(most))}</p>"

    def sheet(self, pages: list[str]) -> str:
        return "\n".join(f"<div class='page'>\n{one}\n</div>" for one in pages)


_PREAMBLE = r"""\documentclass[10pt,a4paper,fleqn]{article}
%s\usepackage{textcomp,amsmath,tikz}
\usepackage[margin=18mm]{geometry}
\setlength{\parindent}{0pt}\setlength{\mathindent}{5mm}
\allowdisplaybreaks
\begin{document}
\setlength{\abovedisplayskip}{3pt}\setlength{\belowdisplayskip}{3pt}
"""
_STANDARD = r"""\usepackage[utf8]{inputenc}
\usepackage[T1]{fontenc}
\usepackage{lmodern}
"""
_FURTHER = r"""% run xelatex or lualatex: the standard fonts lack some of the letters
\usepackage{fontspec}
\setmainfont{DejaVu Serif}
"""
_CHINESE = r"""% run xelatex or lualatex: the standard fonts lack some of the letters
\usepackage[UTF8,scheme=plain]{ctex}
"""
_TRADITIONAL = (
    r"""% run xelatex or lualatex: the standard fonts lack some of the letters
\usepackage[UTF8,scheme=plain,fontset=none]{ctex}
% the first of these fonts that is there
\newcommand\face[2]{\IfFontExistsTF{#1}{\setCJKmainfont{#1}\setCJKsansfont{#1}}{#2}}
"""
    + "".join(
        rf"\face{{{name}}}{{"
        for name in (
            "Noto Serif CJK TC",
            "Source Han Serif TC",
            "Noto Sans CJK TC",
            "Songti TC",
            "PMingLiU",
            "AR PL UMing TW",
            "AR PL KaitiM Big5",
            "Droid Sans Fallback",
        )
    )
    + r"\setCJKmainfont{FandolSong-Regular.otf}"
    + "}" * 8
    + "\n"
)
"""For the letters of Traditional Chinese, which the usual fonts of `ctex` lack."""
_BEFORE = "\n\n\\begin{align*}"


def _latex_words(text: str) -> str:
    parts = MARKED.split(text)
    return "".join(LATEX.name(part) if n % 2 else plain_latex(part) for n, part in enumerate(parts))


_COMMAND = re.compile(r"\\[a-zA-Z]+|[{}^_ ]")
_LONG = 84
"""The most letters of a formula in the usual size: a longer one is set smaller, to stay on its page."""


def _is_traditional(char: str) -> bool:
    """Return whether a letter is a Chinese one that the set of Simplified Chinese lacks."""
    try:
        char.encode("gb2312")
    except UnicodeEncodeError:
        return "\u4e00" <= char <= "\u9fff"
    return False


class _Tex(DocumentForm):
    new_page = r"\newpage"

    def page(self, title: str, body: str) -> str:
        further = [char for char in body if not latex_has(char)]
        wide = any(east_asian_width(char) in ("W", "F") for char in further)
        chinese = _TRADITIONAL if any(map(_is_traditional, further)) else _CHINESE
        fonts = chinese if wide else _FURTHER if further else _STANDARD
        # a paragraph that ends before an equation would leave an empty line
        return f"{_PREAMBLE % fonts}{body.replace(_BEFORE, _BEFORE[1:])}\n\\end{{document}}\n"

    def heading(self, level: int, text: str) -> str:
        return f"\\{'sub' * (level - 1)}section*{{{_latex_words(text)}}}"

    def text(self, words: str) -> str:
        return _latex_words(words)

    def aligned(self, rows: list[EquationRow]) -> str:
        lines = " \\\\\n".join(f"{left} &= {right}" for left, right in rows)
        block = f"\\begin{{align*}}\n{lines}\n\\end{{align*}}"
        longest = max(len(_COMMAND.sub("", right)) for _, right in rows)
        return f"{{\\footnotesize\n{block}}}" if "bmatrix" not in lines and longest > _LONG else block

    def listed(self, items: list[tuple[str, str]]) -> str:
        cells = (formula + (f" ({_latex_words(words)})" if words else "") for formula, words in items)
        return (
            r"\begin{flushleft}"
            + ",\\quad\n".join(f"\\mbox{{{item}}}" for item in cells)
            + r"\end{flushleft}"
        )

    def question(self, number: int, text: str, marks: int, hint: str, answers: str, formulas: str) -> str:
        head = f"\\textbf{{{number}}}\\quad {text} \\hfill ({_marks(marks)})"
        room = formulas or f"\\vspace*{{\\stretch{{{marks}}}}}"
        return "\n\n".join(part for part in (head, hint, room, answers) if part)

    def named(self, most: int) -> str:
        return "\\ ".join(rf"{one} \hrulefill" for one in _signed(most))

    def sheet(self, pages: list[str]) -> str:
        return "\n\n\\newpage\n\n".join(pages)


_MARKS = re.compile(r"[\\`*_{}\[\]<>#$&~|]")
"""The characters that Markdown, or a page made from it, may take for a mark anywhere."""


def _without_tags(formula: str) -> str:
    """Return a formula without < and >, which a page would take for the ends of a tag."""
    return formula.replace("<", r"\lt ").replace(">", r"\gt ")


class _Markdown(DocumentForm):
    def page(self, title: str, body: str) -> str:
        return f"{body}\n"

    def heading(self, level: int, text: str) -> str:
        return f"{'#' * level} {self.text(text)}"

    def text(self, words: str) -> str:
        return _MARKS.sub(r"\\\g<0>", MARKED.sub(r"\1", words))

    def aligned(self, rows: list[EquationRow]) -> str:
        """Return each equation between $ signs, its rows one behind the other."""
        lines = "".join(f"\n{left} = {right}" if left else f" = {right}" for left, right in rows)
        return "\n\n".join(f"${line}$" for line in lines[1:].split("\n"))

    def listed(self, items: list[tuple[str, str]]) -> str:
        return "\n".join(f"- {formula} {self.text(words)}".rstrip() for formula, words in items)


HTML: DocumentForm = _Html()
TEX = _Tex(LATEX, figure=tikz, free=free_tikz)
MARKDOWN = _Markdown(
    replace(
        LATEX,
        symbol=lambda symbol: _without_tags(LATEX.symbol(symbol)),
        name=lambda name: _without_tags(LATEX.name(name)),
    )
)


def page_form(*figures: Callable[[Solution], str], lit: bool) -> DocumentForm:
    """Return a page with its `figure`, `construction` and `free`.

    Where it is `lit`, a symbol of a force lights up its arrows, and an arrow its symbols.
    """
    return _Html(*figures, lit=lit)
