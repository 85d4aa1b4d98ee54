"""A made linkage as a folder: the parts for a way of making, instructions for assembly, and all numbers."""

from __future__ import annotations

import os
import re
from pathlib import Path

from linkanim.errors import BadInput
from linkanim.export import json_text
from linkanim.manifest import FileSet, replacing
from linkanim.workshop import documents
from linkanim.workshop.made import MadeLinkage
from linkanim.workshop.sheet import Sheet

SHEET, NUMBERS = "assembly.html", "make.json"
_OURS = r"assembly\.html|make\.json|parts\.pdf|parts-[\d.]+mm\.(svg|dxf)|(part|pin|ring|cap)[\w.-]*\.stl"
_NEEDS = {"cardboard": ("fpdf", "a PDF"), "laser": ("ezdxf", "a DXF"), "print": ("manifold3d", "an STL")}


def write(made: MadeLinkage, output: str | os.PathLike[str]) -> list[Path]:
    """Write a made linkage into a folder, and return the paths, the instructions' first.

    Other files there stay; of an older set only what we wrote is replaced. BadInput for a linkage that cannot
    be made, for a missing library, and where one of our names is taken.
    """
    if made.refused is not None:
        raise BadInput(made.refused)
    folder = Path(output)
    documents.require(*_NEEDS[made.way])
    with replacing(FileSet(folder, "make", _OURS), (SHEET, NUMBERS)) as new:
        match made.way:
            case "cardboard":
                (new / "parts.pdf").write_bytes(documents.paper(made))
            case "laser":
                name = f"parts-{made.sizes.thickness:g}mm"
                (new / f"{name}.svg").write_text(documents.svg(made), encoding="utf-8")
                (new / f"{name}.dxf").write_text(documents.dxf(made), encoding="utf-8")
            case "print":
                for name, content in documents.bodies(made):
                    (new / f"{_plain(name)}.stl").write_bytes(content)
        (new / SHEET).write_text(Sheet(made).document(), encoding="utf-8")
        (new / NUMBERS).write_text(json_text(made.as_object(), indent=1) + "\n", encoding="utf-8")
        names = sorted(path.name for path in new.iterdir())
    return [folder / name for name in names]


def _plain(name: str) -> str:
    """Return a name that any file system accepts."""
    return re.sub(r"[^\w.-]+", "-", name, flags=re.ASCII)
