"""What the desktop asks of every program: whether the user wants less motion."""

from __future__ import annotations

import ctypes
import os
import shutil
import sys
from collections.abc import Mapping

from linkanim.child import path_of_programs

_ANIMATES = 0x1042
"""Windows' number of the question whether it animates: SPI_GETCLIENTAREAANIMATION."""
_PATIENCE = 0.5
"""Seconds in which a desktop has to answer."""


def reduces_motion(environ: Mapping[str, str] = os.environ) -> bool:
    """Return whether the desktop asks for reduced motion; False where it cannot say.

    GNOME and its relatives, macOS and Windows are asked, each in its own way.
    """
    if sys.platform == "win32":
        animates = ctypes.c_int(1)
        ctypes.windll.user32.SystemParametersInfoW(_ANIMATES, 0, ctypes.byref(animates), 0)
        return not animates.value
    if sys.platform == "darwin":
        return _answer("defaults", "read", "com.apple.universalaccess", "reduceMotion") == "1"
    desktops = {"gnome", "unity", "x-cinnamon", "budgie", "pantheon", "ubuntu"}
    if not desktops & {*environ.get("XDG_CURRENT_DESKTOP", "").lower().split(":")}:
        return False
    return _answer("gsettings", "get", "org.gnome.desktop.interface", "enable-animations") == "false"


def _answer(program: str, *words: str) -> str:
    """Return what a program of the system prints; "" where it cannot."""
    import subprocess  # other desktops are not asked: the first frame does not wait for it

    path = shutil.which(program, path=path_of_programs())
    if path is None:
        return ""
    try:
        run = subprocess.run(
            [path, *words], capture_output=True, text=True, timeout=_PATIENCE, check=False, cwd="/"
        )
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return run.stdout.strip()
