"""How scenes and motions show themselves in a notebook: registered with IPython by name, imported when shown.

It stands below all rooms, since a scene's figure and a motion's chart need what they offer together.
"""

from __future__ import annotations

from typing import Any


def register(shell: Any) -> None:
    """Register with IPython's shell, if there is one, how to show scenes and motions; imports nothing."""
    if shell is None:
        return
    page = shell.display_formatter.formatters["text/html"]
    page.for_type_by_name("linkanim.scenes.scene", "Scene", _scene)
    page.for_type_by_name("linkanim.mechanics.motion", "Motion", _motion)


def _scene(scene: Any) -> str:
    from linkanim.notebook.pages import scene_html

    return scene_html(scene)


def _motion(motion: Any) -> str:
    from linkanim.notebook.pages import motion_html

    return motion_html(motion)
