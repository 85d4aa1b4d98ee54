"""The tools of a sheet, as data: the bar of icons, the key table and the help read them.

It loads nothing, so that the help of a command can read it.
"""

from __future__ import annotations

from linkanim.frozen import NamedTuple


class Tool(NamedTuple):
    """A tool of the bar, or what is done at once: its icon, name and key, the action that it stands for."""

    icon: str
    name: str
    key: str
    action: str
    value: str | None = None


TOOLS = (
    Tool("bar", "pins and bars", "B", "tool", "bar"),
    Tool("move", "move", "V", "tool", "move"),
    Tool("line", "line", "L", "tool", "guide"),
    Tool("slider", "slider", "P", "tool", "slider"),
    Tool("slot", "slot", "K", "tool", "slot"),
    Tool("gear", "gear pair", "W", "tool", "gear"),
    Tool("spring", "spring", "S", "tool", "spring"),
    Tool("damper", "damper", "A", "tool", "damper"),
    Tool("cylinder", "cylinder", "Y", "tool", "cylinder"),
    Tool("photo", "photograph: a point of it to its place, then another", "F", "tool", "photo"),
    Tool("trace", "trace of the chosen joint", "T", "trace_on"),
    Tool("drive", "drive of the chosen crank or slider", "D", "drive_by"),
    Tool("delete", "remove", "Del", "remove"),
    Tool("undo", "undo", "Ctrl+Z", "unbuild"),
    Tool("redo", "redo", "Ctrl+Y", "rebuild"),
)
"""The tools of the bar, in their order."""
