"""The Pythons that we start, and this one: none imports a module from the current folder.

A scene lies beside a student's own files, and `python -m`, `-c` and an empty entry of PYTHONPATH make Python
look in the current folder first. Before `shut_out_current_folder` has run, nothing but `os` and `sys` may be
imported.
"""

import os
import sys

ONE_CORE = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
"""Environment for numpy, set before it is loaded: no matrix here is large, and a thread takes 8 to 30 MB."""

_HOME = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))  # noqa: PTH100, PTH120


def shut_out_current_folder() -> None:
    """Take the current folder off the search for modules and programs; it comes last if linkanim is in it."""
    sys.path[:] = _places()
    # Windows looks for a program in the current folder first
    os.environ.setdefault("NoDefaultCurrentDirectoryInExePath", "1")


def stay_on_one_core() -> None:
    """Let numpy's matrix products start no threads, unless the user has set how many."""
    for name, number in ONE_CORE.items():
        os.environ.setdefault(name, number)


def path_of_programs() -> str:
    """Return PATH, where programs are looked for, without the current folder and without relative folders."""
    places = os.environ.get("PATH", os.defpath).split(os.pathsep)
    return os.pathsep.join(place for place in places if os.path.isabs(place) and not _is_here(place))  # noqa: PTH117


def module(name: str, *words: str) -> list[str]:
    """Return the command that runs a module of ours with these arguments, in the environment of `env`."""
    return [sys.executable, "-P", "-m", name, *words]


def env() -> dict[str, str]:
    """Return an environment in which another Python finds the modules that this one finds."""
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
