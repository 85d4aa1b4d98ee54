"""The tools of a sheet, as data: the bar of icons, the key table and the help read them.

It loads nothing, so that the help of a command can read it.
"""

from __future__ import annotations

from typing import NamedTuple


class Tool(NamedTuple):
    """A tool of the bar, or an immediate command: its icon, name and key, and its action."""

    icon: str
    name: str
    key: str
    action: str
    value: str | None = None


TOOLS = (
    Tool("bar", "pins and bars", "1", "tool", "bar"),
    Tool("move", "move", "2", "tool", "move"),
    Tool("line", "line", "3", "tool", "guide"),
    Tool("slider", "slider", "4", "tool", "slider"),
    Tool("slot", "slot", "5", "tool", "slot"),
    Tool("gear", "gear pair", "6", "tool", "gear"),
    Tool("spring", "spring", "7", "tool", "spring"),
    Tool("damper", "damper", "8", "tool", "damper"),
    Tool("cylinder", "cylinder", "9", "tool", "cylinder"),
    Tool("photo", "photograph: a point of it to its place, then another", "F", "tool", "photo"),
    Tool("trace", "trace of the chosen joint", "Shift+T", "trace_on"),
    Tool("drive", "drive of the chosen crank or slider", "Shift+D", "drive_by"),
    Tool("delete", "remove", "Del", "remove"),
    Tool("undo", "undo", "Ctrl+Z", "undo_sheet"),
    Tool("redo", "redo", "Ctrl+Y", "redo_sheet"),
)
"""The tools of the bar, in their order."""
