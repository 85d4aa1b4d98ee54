"""The user's data folder, where what outlasts a window is kept."""

from __future__ import annotations

from pathlib import Path


def kept_as(name: str) -> Path:
    """Return the path under which something is kept in the user's data folder; neither need be there.

    Of a user without a home it is kept as long as the system keeps temporary files.
    """
    from tempfile import gettempdir

    from platformdirs import user_data_path

    folder = user_data_path("linkanim", appauthor=False)
    return (folder if folder.is_absolute() else Path(gettempdir()) / "linkanim") / name
