"""A figure or a chart as a file: its name's ending says which."""

from __future__ import annotations

from linkanim.export import csv_head, csv_rows
from linkanim.manifest import Output
from linkanim.paper.chart import Page
from linkanim.paper.construction import ConstructionPage, ErrorChart
from linkanim.paper.curves import table
from linkanim.paper.figure import Figured
from linkanim.paper.illustration import Illustration
from linkanim.paper.latex import write_for_latex
from linkanim.paper.pdf import pdf, require_pdf
from linkanim.paper.svg import svg
from linkanim.picture.raster import png_bytes

OF_A_FIGURE = (".svg", ".png", ".pdf")
OF_A_CHART = (*OF_A_FIGURE, ".csv")


Written = Figured | Page | ErrorChart | ConstructionPage | Illustration


def write(shown: Written, target: Output, *, latex: bool = False) -> None:
    """Write a figure or a chart as SVG, PNG or PDF, a chart also as CSV; a file appears whole or not at all.

    The words of a PDF are left to `latex` in a file beside it. `WorkFailed` where disk or folder refuse;
    `BadInput` for a PDF without what writes it.
    """
    suffix = target.path.suffix.lower()
    if suffix == ".pdf":
        require_pdf()
    if latex:
        write_for_latex(target, shown.size, shown.background, shown.groups(), title=shown.title)
        return
    with target.replacing() as part:
        part.write_bytes(data(shown, suffix))


def data(shown: Written, suffix: str) -> bytes:
    """Return a figure or a chart as a kind of file."""
    match suffix:
        case ".csv" if isinstance(shown, Page):
            names, columns = table(shown.curves)
            return (csv_head(names) + csv_rows(columns)).encode()
        case ".csv" if isinstance(shown, ErrorChart):
            return shown.csv().encode()
        case ".png":
            return png_bytes(shown.surface())
        case ".pdf":
            return pdf(shown.size, shown.background, shown.groups(), title=shown.title)
    return svg(shown.size, shown.background, shown.groups(), title=shown.title).encode()
