"""A PDF whose words LaTeX sets: the picture without them, and a file beside it that puts them over it.

The file's name ends in `.pdf_tex`, as Inkscape's does, and is read in the same way: \\def\\svgwidth{80mm}
before \\input{NAME.pdf_tex} says how wide the picture is. The words are in the fonts of the text around them
and of the size of its footnotes, for which a picture of 80 mm has room; symbols are set as mathematics.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from linkanim.errors import BadInput
from linkanim.manifest import Output
from linkanim.paper.pdf import pdf
from linkanim.paper.svg import flat
from linkanim.picture.items import Caption, Group, Item
from linkanim.picture.raster import Colour, Layer
from linkanim.picture.text import runs, typesetting
from linkanim.units import shown

_ANCHORS = {"left": "l", "centre": "c", "right": "r"}
_READ_OTHERWISE = set("#$%&\\{}~^\"'")
"""Characters that LaTeX takes for something else in a file's name."""
_HEAD = r"""%% The words of {name}, by linkanim. In LaTeX, with graphicx, color and lmodern:
%%   \def\svgwidth{{{wide:g}mm}}  \input{{{name}_tex}}
%% They are set in \footnotesize, the names of joints in \small, as wide as the picture may be; to change it:
%%   \def\linkanimsize{{\scriptsize}}\def\linkanimlarger{{\footnotesize}}
\begingroup
  \providecommand\color[2][]{{}}%
  \providecommand\linkanimsize{{\footnotesize}}%
  \providecommand\linkanimlarger{{\small}}%
  \providecommand\linkanimpdf[2]{{\ifdefined\pdfliteral\pdfliteral #1{{#2}}\else
    \ifdefined\pdfextension\pdfextension literal #1{{#2}}\fi\fi}}%
  %% a rim about the words, which is drawn and not read
  \providecommand\linkanimhalo[3]{{\ifdefined\XeTeXversion\else
    \rlap{{\linkanimpdf{{page}}{{/Span <</ActualText <FEFF>>> BDC}}%
    \linkanimpdf{{direct}}{{#1 RG 1 j #2 w 1 Tr}}#3\linkanimpdf{{direct}}{{0 Tr}}%
    \linkanimpdf{{page}}{{EMC}}}}\fi #3}}%
  \ifx\svgwidth\undefined\setlength{{\unitlength}}{{{wide:.2f}mm}}\else\setlength{{\unitlength}}{{\svgwidth}}\fi
  \global\let\svgwidth\undefined
  \begin{{picture}}(1,{height:.5f})%
    \put(0,0){{\includegraphics[width=\unitlength]{{{name}}}}}%
"""
_FOOT = "  \\end{picture}%\n\\endgroup\n"
_FOOTNOTE = 8.0
"""The size of \\footnotesize in points, in a document of 10 pt."""
_LETTERS = 2
"""The most letters of a subscript that is not a word."""
WIDER = 1.3
"""How many times wider LaTeX's letters are than those of our face at the same size."""
_LARGER = 1.1
"""The factor on the smallest size beyond which words are set in \\small."""
_POINTS = 0.75
"""A pixel is 3/4 of a PDF's point."""


def refuse_latex(target: Output) -> None:
    """Raise `BadInput` for what is no PDF, has a name that LaTeX cannot read, or a foreign file beside it."""
    name = target.path.name
    if target.path.suffix.lower() != ".pdf":
        raise BadInput(
            f"--text latex goes with a PDF, not with {shown(name)}; write FIG.pdf, or leave it out"
        )
    if _READ_OTHERWISE & set(name):
        raise BadInput(f"--text latex: LaTeX cannot name {shown(name)}; take letters, digits and -")
    labels_of(target).refuse_foreign()


def labels_of(target: Output) -> Output:
    """Return the file with the words of a PDF, whose name is derived from the PDF's."""
    return target.beside(f"{target.path.name}_tex")


def write_for_latex(
    target: Output,
    size: tuple[int, int],
    background: Colour | None,
    groups: Iterable[Group],
    *,
    title: str,
    wide: float | None = None,
) -> None:
    """Write a picture as PDF without its words, and those beside it; both appear whole, or neither does.

    It is `wide` mm wide; without that, a pixel is 3/4 pt.
    """
    items = list(flat(groups))
    with target.replacing() as part, labels_of(target).replacing() as labels:
        shapes: list[Item | Group] = [item for item in items if isinstance(item, Layer)]
        part.write_bytes(pdf(size, background, shapes, title=title, wide=wide))
        labels.write_text(words(size, items, target.path.name, wide), encoding="utf-8")


def words(size: tuple[int, int], items: Iterable[Item], name: str, wide: float | None = None) -> str:
    """Return the LaTeX that sets the captions of a picture, `size` in pixels, over the PDF of that name."""
    across = wide or _POINTS * size[0] * 25.4 / 72
    lines = [item for item in items if isinstance(item, Caption) and item.text]
    smallest = min((line.size for line in lines), default=1)
    head = _HEAD.format(name=name, wide=across, height=size[1] / size[0])
    return head + "".join(_put(size, line, smallest) for line in lines) + _FOOT


def _put(size: tuple[int, int], line: Caption, smallest: int) -> str:
    """Return the command that puts a line of text with its baseline where the picture has it."""
    width, height = size
    x, y = line.at[0] / width, (height - line.at[1] - typesetting(line.size).baseline) / width
    set_ = latex_of(line.text)
    text = rf"\textbf{{\boldmath {set_}}}" if line.strong and not line.halo else set_
    if line.halo:
        # the rim keeps its width in letters' sizes, whatever size the document gives them
        rim = 2 * line.halo.width / typesetting(line.size).em * _FOOTNOTE
        text = rf"\linkanimhalo{{{_shares(line.halo.colour, ' ')}}}{{{rim:.2f}}}{{{text}}}"
    larger = r"\linkanimlarger" if line.size > _LARGER * smallest else r"\linkanimsize"
    box = rf"\makebox[0pt][{_ANCHORS[line.anchor]}]{{{larger} {text}}}"
    return f"    \\put({x:.5f},{y:.5f}){{\\color[rgb]{{{_shares(line.colour, ',')}}}{box}}}%\n"


def _shares(colour: Colour, between: str) -> str:
    return between.join(f"{part / 255:.3f}" for part in colour)


# Words as LaTeX sets them: symbols with their subscripts as mathematics, units and numbers upright.

_SYMBOL = re.compile(r"(?<![^\W\d_])([^\W\d_])([′″]*)([ⁿᵗᶜʳ]*)$")
"""A letter that stands alone at the end of a run, with its superscripts: it takes the subscript."""
_ALONE = re.compile(
    r"(?<!\d )(?<![\w(/·])(?!^A [a-z])(?:([A-Z])|^([^\W\d_])(?=$| =|, [^\W\d_]$))([′″]*)([ⁿᵗᶜʳ]*)(?![\w)])"
)
"""A letter set as mathematics: a capital that is a name, all of a text, an equation's left side; no unit."""
_DOLLAR = re.compile(r"(?<!\\)\$")
"""The sign that begins or ends mathematics; an escaped one, which is printed, does not match."""
_RAISED = {"ⁿ": "n", "ᵗ": "t", "ᶜ": "c", "ʳ": "r"}


def latex_of(text: str) -> str:
    """Return a line as LaTeX sets it: r₃ and v_{BA} as mathematics, words and units upright."""
    from linkanim.explain.formula import plain_latex  # not needed before words are set

    parts, pieces = list(runs(text)), list[str]()
    for n, run in enumerate(parts):
        before = parts[n - 1].text if n and not parts[n - 1].lowered else ""
        if not run.lowered:
            base = _SYMBOL.search(run.text) if n + 1 < len(parts) else None
            pieces.append(_words(run.text[: base.start()] if base else run.text, first=not n))
        elif base := _SYMBOL.search(before):
            pieces.append(_symbol(base[1], base[2], base[3], run.text))
        else:
            pieces.append(rf"\textsubscript{{{plain_latex(run.text)}}}")
    return "".join(pieces)


def _words(text: str, *, first: bool) -> str:
    """Return words, with names of one capital as mathematics; `first` where they begin the line."""
    from linkanim.explain.formula import plain_latex

    pieces, done = list[str](), 0
    for alone in _ALONE.finditer(text):
        if alone[1] or first:
            letter = alone[1] or alone[2]
            pieces += [plain_latex(text[done : alone.start()]), _symbol(letter, alone[3], alone[4], "")]
            done = alone.end()
    return "".join([*pieces, plain_latex(text[done:])])


def _symbol(letter: str, primes: str, raised: str, index: str) -> str:
    """Return a letter with its primes, superscript and subscript, as mathematics."""
    from linkanim.explain.formula import plain_latex

    high = primes.replace("″", "′′").replace("′", "'")
    if raised:
        high = f"^{{{high}{''.join(_RAISED[char] for char in raised)}}}"
    base, low = plain_latex(letter).strip("$") + high, _DOLLAR.sub("", plain_latex(index))
    if not index:
        return f"${base}$"
    # the subscript of a joint is its name, that of a link may be a word
    is_word = len(re.sub(r"[\d′]", "", index)) > _LETTERS or (len(index) > 1 and index.islower())
    return rf"${base}_{{\mathrm{{{low}}}}}$" if is_word else f"${base}_{{{low}}}$"
