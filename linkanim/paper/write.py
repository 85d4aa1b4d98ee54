"""A chart as a file: its name's ending says which."""

from __future__ import annotations

from pathlib import Path

from linkanim.cells import csv_head, csv_rows
from linkanim.paper.chart import Page
from linkanim.paper.curves import table
from linkanim.paper.svg import svg
from linkanim.picture.offscreen import png_bytes
from linkanim.whole import replacing

SUFFIXES = (".svg", ".png", ".csv")


def write(page: Page, target: Path) -> None:
    """Write a chart as SVG, PNG or CSV; the file appears whole or not at all.

    `WorkFailed` where disk or folder refuse.
    """
    with replacing(target) as part:
        match target.suffix.lower():
            case ".csv":
                names, columns = table(page.curves)
                part.write_text(csv_head(names) + csv_rows(columns), encoding="utf-8", newline="")
            case ".png":
                part.write_bytes(png_bytes(page.surface()))
            case _:
                scene = page.curves.scene
                text = svg(page.size, page.background, page.items(), title=f"{scene.title}: {page.about}")
                part.write_text(text, encoding="utf-8")
