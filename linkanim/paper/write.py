"""A chart as a file: its name's ending says which."""

from __future__ import annotations

import csv
from pathlib import Path

from linkanim.paper.chart import Page
from linkanim.paper.curves import finite_text, table
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
                _csv(page, part)
            case ".png":
                part.write_bytes(png_bytes(page.surface()))
            case _:
                scene = page.curves.scene
                text = svg(page.size, page.background, page.items(), title=f"{scene.title}: {page.about}")
                part.write_text(text, encoding="utf-8")


def _csv(page: Page, part: Path) -> None:
    names, columns = table(page.curves)
    with part.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(names)
        writer.writerows([finite_text(value) for value in row] for row in zip(*columns, strict=True))
