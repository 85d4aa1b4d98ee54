"""The user's data folder, where what outlasts a window is kept."""

from __future__ import annotations

from pathlib import Path


def kept_as(name: str) -> Path:
    """Return the path under which something is kept in the user's data folder; neither need be there."""
    from platformdirs import user_data_path

    return user_data_path("linkanim", appauthor=False) / name
