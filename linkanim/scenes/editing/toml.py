"""A scene file's text to the document in it; imports nothing that knows a linkage."""

from __future__ import annotations

import tomllib
from typing import Any

from linkanim.document import Section, refuse_controls
from linkanim.errors import SceneError
from linkanim.intake import Intake

SCENE_FILE = Intake("a scene file", most_bytes=1_000_000, most_values=50_000, refusal=SceneError)


class _Document(Section):
    """A scene file's whole text, before it is known what it describes."""

    refusal = SceneError


def parse(text: str, where: str) -> dict[str, Any]:
    """Return the document in a scene file's text; SceneError with the line where it is not TOML."""
    SCENE_FILE.refuse_heavy(text, where)
    try:
        document = tomllib.loads(text)
    except ValueError as error:
        raise SceneError(f"{where}: is not TOML: {error}") from None
    refuse_controls(_Document(where, document))
    return document
