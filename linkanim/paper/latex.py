"""A PDF whose words LaTeX sets: the picture without them, and a file beside it that puts them over it.

The file's name ends in `.pdf_tex`, as Inkscape's does, and is read in the same way: \\def\\svgwidth{80mm}
before \\input{NAME.pdf_tex} says how wide the picture is. The words are in the fonts of the text around them,
and as large as the picture has them: none comes to lie on another.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

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
"""In a file's name LaTeX takes these for something else."""
_HEAD = r"""%% The words of {name}, by linkanim. In LaTeX, with graphicx, xcolor and lmodern:
%%   \def\svgwidth{{80mm}}  \input{{{name}_tex}}
\begingroup
  \providecommand\color[2][]{{}}%
  \ifx\svgwidth\undefined\setlength{{\unitlength}}{{{width:.2f}bp}}\else\setlength{{\unitlength}}{{\svgwidth}}\fi
  \global\let\svgwidth\undefined
  \begin{{picture}}(1,{height:.5f})%
    \put(0,0){{\includegraphics[width=\unitlength]{{{name}}}}}%
"""
_FOOT = "  \\end{picture}%\n\\endgroup\n"
_ALIKE = 0.82
"""LaTeX's letters are so much wider than those of the picture's face, and are set so much smaller."""
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
    """Return the file with the words of a PDF: nobody gave its name."""
    return target.beside(f"{target.path.name}_tex")


def write_for_latex(
    target: Output, size: tuple[int, int], background: Colour | None, groups: Iterable[Group], *, title: str
) -> None:
    """Write a picture as PDF without its words, and those beside it; both appear whole, or neither does."""
    items = list(flat(groups))
    with target.replacing() as part, labels_of(target).replacing() as labels:
        shapes: list[Item | Group] = [item for item in items if isinstance(item, Layer)]
        part.write_bytes(pdf(size, background, shapes, title=title))
        labels.write_text(words(size, items, target.path.name), encoding="utf-8")


def words(size: tuple[int, int], items: Iterable[Item], name: str) -> str:
    """Return what puts the captions of a picture of so many pixels over the PDF of that name."""
    head = _HEAD.format(name=name, width=_POINTS * size[0], height=size[1] / size[0])
    lines = (line for item in items if isinstance(item, Caption) for line in _put(size, item))
    return head + "".join(lines) + _FOOT


def _put(size: tuple[int, int], line: Caption) -> Iterator[str]:
    """Yield what puts a line of text: its baseline where the picture has it."""
    from linkanim.explain.formula import plain_latex  # not needed before words are set

    if not line.text or not line.strength:
        return
    width, height = size
    x, y = line.at[0] / width, (height - line.at[1] - typesetting(line.size).baseline) / width
    set_ = "".join(
        rf"\textsubscript{{{plain_latex(run.text)}}}" if run.lowered else plain_latex(run.text)
        for run in runs(line.text)
    )
    size_ = f"{_ALIKE * typesetting(line.size).em / width:.5f}\\unitlength"
    text = rf"\fontsize{{{size_}}}{{{size_}}}\selectfont " + (rf"\textbf{{{set_}}}" if line.strong else set_)
    colour = ",".join(f"{part / 255:.3f}" for part in line.colour)
    box = rf"\makebox[0pt][{_ANCHORS[line.anchor]}]{{{text}}}"
    yield f"    \\put({x:.5f},{y:.5f}){{\\color[rgb]{{{colour}}}{box}}}%\n"
