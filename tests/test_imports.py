"""The rooms' order, and which third parties live in which room, read from the sources themselves."""

from __future__ import annotations

import ast
import os
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from functools import cache
from graphlib import TopologicalSorter
from importlib import import_module
from pathlib import Path

import pytest

import linkanim

PACKAGE = Path(linkanim.__file__).parent
SOURCES = sorted(PACKAGE.rglob("*.py"))

# From the top down; a room imports only from rooms above it. `linkanim` is the package's own
# __init__ and __main__, which stand below everything: what they offer comes from all rooms.
RANK = {
    room: rank
    for rank, rooms in enumerate(
        [
            ("errors", "frozen"),
            (
                "bounds",
                "child",
                "export",
                "intake",
                "letters",
                "steps",
                "units",
                "words",
                "atomic_files",
            ),
            ("manifest", "manual"),
            ("mechanics",),
            ("scenes",),
            ("synthesis", "build"),
            ("picture",),
            ("explain",),
            ("paper",),
            ("share",),
            ("player",),
            ("ui",),
            ("play",),
            ("workshop",),
            ("recorder",),
            ("bench",),
            ("cli",),
            ("linkanim", "notebook", "examples"),
        ]
    )
    for room in rooms
}

THIRD_PARTIES = {
    "errors": set(),
    "frozen": set(),
    "bounds": set(),
    "child": set(),
    "export": {"numpy", "orjson"},
    "intake": set(),
    "letters": set(),
    "steps": set(),
    "units": set(),
    "words": set(),
    "atomic_files": {"platformdirs"},
    "manifest": set(),
    "manual": set(),
    "mechanics": {"numpy", "llvmlite"},  # llvmlite: machine code, where it is installed
    "scenes": {"numpy", "tomli_w"},
    "synthesis": {"numpy"},
    "build": {"numpy"},
    "picture": {"numpy", "pygame", "PIL"},
    "explain": {"numpy"},
    "paper": {"numpy", "pygame", "fpdf", "fontTools"},  # fpdf2 brings fontTools
    "share": {"numpy"},
    "player": {"numpy", "pygame"},
    "ui": {"numpy", "pygame"},
    "play": {"numpy"},
    "workshop": {"numpy", "ezdxf", "manifold3d"},
    "recorder": {"numpy", "imageio", "imageio_ffmpeg"},
    "bench": {"numpy", "mpmath", "matplotlib"},
    "cli": {"numpy", "tqdm"},
    "linkanim": set(),
    "notebook": {"numpy"},
    "examples": {"numpy", "pandas", "scipy", "matplotlib"},
}

# The version is text in __init__, which imports nothing by itself.
BARE = {"linkanim.__version__"}


def room_of(path: Path) -> str:
    first = path.relative_to(PACKAGE).parts[0].removesuffix(".py")
    return "linkanim" if first in ("__init__", "__main__") else first


def module_of(path: Path) -> list[str]:
    """Return the package that a file's relative imports start from."""
    return ["linkanim", *path.relative_to(PACKAGE).parent.parts]


@cache
def imported(path: Path) -> tuple[str, ...]:
    """Return the full name of everything a file imports, at its top or inside a function."""
    return tuple(_imported(path))


def _imported(path: Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (name.name for name in node.names)
        elif isinstance(node, ast.ImportFrom):
            package = module_of(path)
            base = package[: len(package) - node.level + 1] if node.level else []
            module = ".".join([*base, *([node.module] if node.module else [])])
            yield from (f"{module}.{name.name}" for name in node.names)


def is_third_party(name: str) -> bool:
    return name.split(".")[0] not in {"linkanim", "__future__", *sys.stdlib_module_names}


@pytest.mark.slow
def test_a_file_imports_only_from_its_own_room_and_those_above() -> None:
    lower = []
    for path in SOURCES:
        own = RANK[room_of(path)]
        inner = [name for name in imported(path) if name.split(".")[0] == "linkanim" and name not in BARE]
        rooms = {name: [*name.split("."), "linkanim"][1] for name in inner}
        lower += [(path, name) for name, room in rooms.items() if RANK.get(room, RANK["linkanim"]) > own]
    assert lower == []


def test_only_the_solvers_own_room_imports_it() -> None:
    outside = [path for path in SOURCES if room_of(path) != "mechanics"]
    solver = re.compile(r"linkanim\.mechanics\.solver\b")
    assert [(path, name) for path in outside for name in imported(path) if solver.match(name)] == []


def test_no_modules_import_each_other_in_a_circle() -> None:
    modules = {".".join([*module_of(path), path.stem]).removesuffix(".__init__"): path for path in SOURCES}
    graph = {}
    for module, path in modules.items():
        homes = {name if name in modules else name.rpartition(".")[0] for name in set(imported(path)) - BARE}
        graph[module] = homes & set(modules) - {module}
    TopologicalSorter(graph).prepare()  # CycleError names the modules


LISTED = sorted(
    path.parent for path in PACKAGE.glob("*/__init__.py") if path.parent.name not in ("manual", "notebook")
)
LISTED.append(PACKAGE / "mechanics/solver")


@pytest.mark.parametrize("room", LISTED, ids=lambda room: room.name)
def test_a_room_lists_its_modules_in_the_order_in_which_they_import(room: Path) -> None:
    """The docstring of a room is its map: each module stands after those that it imports from."""
    text = ast.get_docstring(ast.parse((room / "__init__.py").read_text(encoding="utf-8"))) or ""
    order = re.findall(r"^    (\w+) {2,}\S", text, re.MULTILINE)
    modules = {path.stem: [path] for path in room.glob("*.py") if path.stem[0] != "_"}
    modules |= {path.parent.name: list(path.parent.glob("*.py")) for path in room.glob("*/__init__.py")}
    assert sorted(order) == sorted(modules)
    package = ".".join(["linkanim", *room.relative_to(PACKAGE).parts, ""])
    above = []
    for place, module in enumerate(order):
        names = {name for path in modules[module] for name in imported(path) if name.startswith(package)}
        inner = {name.removeprefix(package).split(".")[0] for name in names}
        above += [(module, one) for one in inner & set(order) if order.index(one) > place]
    assert above == []


def test_the_maps_for_a_newcomer_have_all_rooms_in_their_order() -> None:
    """The package's docstring, and the page on how the house is built, whose modules are there."""
    page = (PACKAGE / "manual/design.md").read_text(encoding="utf-8")
    table = re.findall(r"^\| (`.*?) \|", page, re.MULTILINE)
    rooms = {path.parent.name for path in PACKAGE.glob("*/__init__.py")}
    maps = {
        "docstring": re.findall(r"^    (\w+) {2,}\S", linkanim.__doc__ or "", re.MULTILINE),
        "page": [room for row in table for room in re.findall(r"`(\w+)`", row) if room in rooms - {"manual"}],
    }
    for where, order in maps.items():
        assert (where, sorted(order)) == (where, sorted(rooms - {"manual"}))
        assert (where, sorted(order, key=RANK.__getitem__)) == (where, order)
    told = re.findall(rf"`({'|'.join(rooms)})/(\w+)`", page)
    assert [path for path in told if not PACKAGE.joinpath(*path).with_suffix(".py").exists()] == []
    assert len(told) > 10


def test_a_third_party_stays_in_its_rooms() -> None:
    astray = []
    for path in SOURCES:
        used = {name.split(".")[0] for name in imported(path) if is_third_party(name)}
        astray += [(path, name) for name in used - THIRD_PARTIES[room_of(path)]]
    assert astray == []


def test_every_module_finds_what_it_imports() -> None:
    for path in SOURCES:
        if path.stem != "__main__" and (path.parent / "__init__.py").exists():  # examples are no modules
            parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
            import_module(".".join(parts[:-1] if parts[-1] == "__init__" else parts))


def test_every_room_is_read() -> None:
    rooms = {room_of(path) for path in SOURCES}
    assert rooms <= set(RANK)
    assert {"mechanics", "scenes", "picture", "paper", "player", "recorder", "cli"} <= rooms


def test_a_class_has_one_name_and_a_name_one_class() -> None:
    homes: dict[str, list[str]] = {}
    for path in SOURCES:
        for name in re.findall(r"^class (\w+)", path.read_text(encoding="utf-8"), re.MULTILINE):
            homes.setdefault(name, []).append(str(path.relative_to(PACKAGE)))
    assert len(homes) > 100
    assert {name: paths for name, paths in homes.items() if len(paths) > 1} == {}


@pytest.mark.slow
def test_a_module_gives_a_name_to_one_thing_only() -> None:
    twice = []
    for path in SOURCES:
        if room_of(path) != "examples":
            body = ast.parse(path.read_text(encoding="utf-8")).body
            assigned = [
                node.targets if isinstance(node, ast.Assign) else [node.target]
                for node in body
                if isinstance(node, ast.Assign | ast.AnnAssign)
            ]
            names = [
                part.id
                for targets in assigned
                for target in targets
                for part in ast.walk(target)
                if isinstance(part, ast.Name)
            ]
            twice += [(path, name) for name, count in Counter(names).items() if count > 1]
    assert twice == []


HEAVY = ("numpy", "pygame", "PIL", "imageio", "imageio_ffmpeg", "tqdm")
ROOMS = ("linkanim.mechanics", "linkanim.scenes", "linkanim.bench", "linkanim.synthesis", "linkanim.explain")
NO_WINDOW = ("pygame", "PIL", "imageio", "imageio_ffmpeg")


# What may not be loaded after each way of starting: what none of several may load, after each in one process.
@pytest.mark.parametrize(
    ("starts", "absent"),
    [
        pytest.param(
            ("import linkanim", "main(['--help'])", "main(['record', '--help'])"),
            (*HEAVY, *ROOMS),
            id="--help",
        ),
        pytest.param(("main(['--version'])",), ("numpy", "pygame", "PIL", "tqdm", *ROOMS), id="--version"),
        pytest.param(
            (
                *("from linkanim import load", "from linkanim import path", "main(['scenes'])"),
                *("main(['info', 'press'])", "main(['solve', 'press', '--angle', '87 deg'])"),
            ),
            (*NO_WINDOW, "linkanim.bench", "linkanim.explain"),
            id="solve",
        ),
        pytest.param(
            ("from linkanim import record", "import linkanim.recorder.recording"),
            ("linkanim.player", "linkanim.play", "linkanim.paper", "linkanim.explain", "linkanim.cli"),
            id="record",
        ),
        pytest.param(
            ("import linkanim.cli.commands.record",),
            ("linkanim.player", "linkanim.play", "linkanim.paper", "linkanim.explain", "linkanim.bench"),
            id="record without a tape",
        ),
        pytest.param(
            ("import linkanim.cli.commands.draw",),
            (
                *("orjson", "tqdm", "PIL", "imageio"),
                *("linkanim.explain", "linkanim.synthesis", "linkanim.player", "linkanim.bench"),
            ),
            id="draw",
        ),
        pytest.param(
            ("import linkanim.paper.write",),
            ("linkanim.player", "linkanim.recorder", "linkanim.explain", "linkanim.synthesis"),
            id="paper",
        ),
    ],
)
def test_a_start_loads_no_more_than_it_needs(starts: tuple[str, ...], absent: tuple[str, ...]) -> None:
    check = f"print('loaded:', *[name for name in {absent!r} if name in sys.modules])"
    cli = "from linkanim.cli import main"
    lines = [line for start in starts for line in (*[cli] * start.startswith("main"), start, check)]
    done = subprocess.run(
        [sys.executable, "-c", "\n".join(["import sys", *lines])],
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    assert done.stderr == ""
    loaded = [line for line in done.stdout.splitlines() if line.startswith("loaded:")]
    assert dict(zip(starts, loaded, strict=True)) == dict.fromkeys(starts, "loaded:")


# numpy and pygame load what they like; a library that only an error, a key or a file needs is ours.
UNSEEN = (
    *("json", "difflib", "html", "tempfile", "subprocess", "tomli_w", "PIL", "imageio", "tqdm", "mpmath"),
    "numpy.ma",
)
FIRST_FRAME = """
import pygame.display as display
flip = display.flip
def first():
    flip()
    print("loaded:", *sorted(set(sys.modules) - before))
    raise SystemExit
display.flip = first
main(["play", "press"])
"""


@pytest.mark.slow
def test_the_first_frame_loads_nothing_that_it_does_not_need() -> None:
    prologue = "import sys, numpy, pygame\nbefore = set(sys.modules)\nfrom linkanim.cli import main\n"
    done = subprocess.run(
        [sys.executable, "-c", prologue + FIRST_FRAME],
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
        env={**os.environ, "SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy"},
    )
    loaded = next(line for line in done.stdout.splitlines() if line.startswith("loaded:"))
    assert set(loaded.split()) & set(UNSEEN) == set()
    assert "linkanim.picture.surface" in loaded
    assert "picture.polygons" not in loaded
    assert not any(
        name in loaded for name in ("linkanim.recorder", "linkanim.paper", "tape_file", "player.background")
    )


def test_no_room_s_tests_are_left_out(pytestconfig: pytest.Config) -> None:
    """Pytest's own list of folders not to be looked into has `build` on it, and left a room of tests out."""
    folders = {path.parent.name for path in Path(__file__).parent.rglob("test_*.py")}
    assert folders >= {"build", "player"}
    assert folders.isdisjoint(pytestconfig.getini("norecursedirs"))
