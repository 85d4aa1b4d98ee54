"""A photograph behind the drawing, and how a scene file tells of it."""

from __future__ import annotations

from collections.abc import Mapping
from math import degrees
from typing import Any

from linkanim import units
from linkanim.build.draft import Photo


def photo_table(photo: Photo) -> dict[str, Any]:
    """Return a photograph as a scene file's table."""
    turn = {"turn": f"{degrees(photo.turn):.10g} deg"} if photo.turn else {}
    return {"file": photo.file, "place": list(photo.place), "width": photo.width, **turn}


def photo_of(table: Mapping[str, Any], unit: str) -> Photo:
    """Return the photograph of a scene file's table."""
    x, y, width = (units.length(each, unit=unit) for each in (*table["place"], table["width"]))
    return Photo(table["file"], (x, y), width, float(units.angle(table.get("turn", "0 deg"))))
