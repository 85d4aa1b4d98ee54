"""Pythons that we start, and our own: none takes a module from the current folder.

A scene lies beside a student's own files, and `python -m`, `-c` and an empty entry of PYTHONPATH have the
current folder looked at first. Before `shut_out` has run nothing but `os` and `sys` may be imported.
"""

import os
import sys

ONE_CORE = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
"""For numpy, before it is loaded: none of our products is large, and a thread takes 8 to 30 MB."""

_HOME = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))  # noqa: PTH100, PTH120


def shut_out_current_folder() -> None:
    """Look for modules and programs no longer in the current folder, but last where linkanim lies there."""
    sys.path[:] = _places()
    # Windows looks for a program in the current folder first
    os.environ.setdefault("NoDefaultCurrentDirectoryInExePath", "1")


def stay_on_one_core() -> None:
    """Have numpy's products start no threads, where the user has not said how many."""
    for name, number in ONE_CORE.items():
        os.environ.setdefault(name, number)


def path_of_programs() -> str:
    """Return where programs are looked for: PATH without the current folder and others that move with it."""
    places = os.environ.get("PATH", os.defpath).split(os.pathsep)
    return os.pathsep.join(place for place in places if os.path.isabs(place) and not _is_here(place))  # noqa: PTH117


def module(name: str, *words: str) -> list[str]:
    """Return the command that runs a module of ours with these words; it goes with `env`."""
    return [sys.executable, "-P", "-m", name, *words]


def env() -> dict[str, str]:
    """Return an environment in which Python finds what we find."""
    return {**os.environ, "PYTHONPATH": os.pathsep.join(_places())}


def _places() -> list[str]:
    """Return where we look for modules without the current folder."""
    elsewhere = [place for place in sys.path if place and not _is_here(place)]
    return [*elsewhere, _HOME] if _is_here(_HOME) else elsewhere


def _is_here(place: str) -> bool:
    try:
        return os.path.samefile(place, os.curdir)  # noqa: PTH121
    except OSError:
        return False
