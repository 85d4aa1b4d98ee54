"""A chart as a file: its name's ending says which."""

from __future__ import annotations

from pathlib import Path

from linkanim.atomic_files import replacing
from linkanim.export import csv_head, csv_rows
from linkanim.paper.chart import Page
from linkanim.paper.curves import table
from linkanim.paper.latex import write_for_latex
from linkanim.paper.pdf import pdf, require_pdf
from linkanim.paper.svg import svg
from linkanim.picture.raster.offscreen import png_bytes

SUFFIXES = (".svg", ".png", ".pdf", ".csv")


def write(page: Page, target: Path, *, latex: bool = False) -> None:
    """Write a chart as SVG, PNG, PDF or CSV; the file appears whole or not at all.

    The words of a PDF are left to `latex` in a file beside it. `WorkFailed` where disk or folder refuse;
    `BadInput` for a PDF without what writes it.
    """
    title = f"{page.curves.scene.title}: {page.about}"
    if target.suffix.lower() == ".pdf":
        require_pdf()
    if latex:
        write_for_latex(target, page.size, page.background, page.groups(), title=title)
        return
    with replacing(target) as part:
        match target.suffix.lower():
            case ".csv":
                names, columns = table(page.curves)
                part.write_text(csv_head(names) + csv_rows(columns), encoding="utf-8", newline="")
            case ".png":
                part.write_bytes(png_bytes(page.surface()))
            case ".pdf":
                part.write_bytes(pdf(page.size, page.background, page.groups(), title=title))
            case _:
                text = svg(page.size, page.background, page.groups(), title=title)
                part.write_text(text, encoding="utf-8")
