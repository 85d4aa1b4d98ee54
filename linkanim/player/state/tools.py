"""The tools of a sheet, as data: the bar of icons, the key table and the help read them."""

from __future__ import annotations

from typing import NamedTuple


class Tool(NamedTuple):
    """A tool of the bar, or what is done at once: its icon, name and key, the action that it stands for."""

    icon: str
    name: str
    key: str
    action: str
    value: str | None = None


TOOLS = (
    Tool("bar", "pins and bars", "B", "tool", "bar"),
    Tool("undo", "undo", "Ctrl+Z", "unbuild"),
    Tool("redo", "redo", "Ctrl+Y", "rebuild"),
)
"""The tools of the bar, in their order."""
