"""The manual's reference is what the program's tables say; a new key, option or quantity needs a sentence.

After a change to one of the tables, `LINKANIM_GOLDENS=write pytest tests/test_manual_reference.py` writes the
pages anew.
"""

from __future__ import annotations

import inspect
import json
import os
import re
from argparse import Action, _SubParsersAction
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest

import linkanim
from linkanim.cli import main
from linkanim.cli.command_table import COMMANDS, build
from linkanim.mechanics.linkage import Linkage
from linkanim.mechanics.quantities import Quantity, register
from linkanim.player.modes import as_markdown
from linkanim.scenes import chapters, files, load, names, titles
from linkanim.scenes.schema import reference
from linkanim.synthesis import generation, guidance
from linkanim.synthesis import path as request
from linkanim.units import significant

MANUAL = Path(linkanim.__file__).parent / "manual"
CHANGED = "out of date; LINKANIM_GOLDENS=write pytest tests/test_manual_reference.py writes it anew"


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def _table(titles: tuple[str, ...], rows: Iterator[tuple[str, ...]]) -> str:
    lines = (f"| {' | '.join(map(_cell, row))} |" for row in rows)
    return "\n".join([f"| {' | '.join(titles)} |", "|" + "---|" * len(titles), *lines])


def _arguments(command: str) -> list[Action]:
    choices = next(one.choices for one in build()._actions if isinstance(one, _SubParsersAction))
    return [one for one in choices[command]._actions if one.dest != "help"]


def _called(argument: Action) -> str:
    """Return how an argument is written: "`-o`, `--output` OUT"."""
    value = str(argument.metavar or "|".join(argument.choices or ()) or argument.dest.upper())
    if argument.nargs in ("?", "*") and argument.option_strings:
        value = f"[{value}]"
    if not argument.option_strings:
        return f"`{value}`"
    words = ", ".join(f"`{option}`" for option in argument.option_strings)
    return words if argument.nargs == 0 or "--no-" in words else f"{words} `{value}`"


def _meant(argument: Action) -> str:
    text = (argument.help or "").replace("%%", "%").replace("%(default)s", str(argument.default))
    chosen = argument.choices and argument.metavar
    return f"{text} ({', '.join(argument.choices or ())})" if chosen else text


def commands() -> str:
    """Return a section for each command: what it does, what it takes, how it is used."""
    return "\n\n".join(_command(name, *words) for name, words in COMMANDS.items())


def _command(name: str, about: str, *examples: str) -> str:
    rows = ((_called(one), _meant(one)) for one in _arguments(name))
    table = _table(("argument", "what it is"), rows) if _arguments(name) else "It takes no arguments."
    shown = "\n".join(examples)
    return f"## linkanim {name}\n\n{about[:1].upper()}{about[1:]}.\n\n{table}\n\n```sh\n{shown}\n```"


def _part(linkage: Linkage, quantity: Quantity) -> str:
    """Return a quantity's token with the kind of its part instead of the part's name."""
    head, _, rest = quantity.token.partition(".")
    if not rest or head == "input":
        return quantity.token
    if ".force" in rest:
        return f"BODY.JOINT.{rest.partition('.')[2]}"
    if head == "ground":
        return quantity.token
    struts = {one.name for one in linkage.springs + linkage.dampers}
    if head in struts and rest in ("length", "rate", "force", "direction", "direction_rate"):
        return f"STRUT.{rest}"
    sliders = {body.name: body.slider is not None for body in linkage.bodies}
    return f"{'SLIDER' if sliders[head] else 'BODY'}.{rest}" if head in sliders else f"JOINT.{rest}"


DRIVEN_SLIDER = """
[drive]
slider = { joint = "C", from = 65, to = 165 }
[ground]
O = [0, 0]
[joints.C]
line = { through = "O" }
[joints.B]
from   = ["C", "O"]
length = [115, 50]
[bodies]
block = { slider = "C", mass = "1 kg" }
"""


def _kinds(more: Path) -> Mapping[str, tuple[str, Quantity, str]]:
    """Return a quantity of each kind: by its token with the kind of its part, a scene, it, its unit."""
    path = more / "driven.toml"
    path.write_text(DRIVEN_SLIDER, encoding="utf-8")
    found: dict[str, tuple[str, Quantity, str]] = {}
    for name in (*names(), str(path)):
        linkage = load(name).linkage
        for quantity in register(linkage).values():
            kind = _part(linkage, quantity)
            if not kind.endswith((".x", ".y")):
                found.setdefault(kind, (name if name in names() else "–", quantity, load(name).length_unit))
    return found


def quantities(more: Path) -> str:
    """Return a row for each kind of quantity; those of vectors' components go with their vectors."""

    def row(kind: str, scene: str, quantity: Quantity, unit: str) -> tuple[str, ...]:
        symbol = re.sub(r"(_\{.*\}|[₀-₉]+)$", "", quantity.symbol)
        words = quantity.words.rpartition(": ")[2].replace("Transmission", "transmission")
        if ".com_" in kind:
            words += " of the centre of mass"
        shown = quantity.display_unit(unit).replace(unit, "length") if "{}" in quantity.unit else ""
        return (
            f"`{kind}`",
            symbol,
            words[:1].lower() + words[1:],
            shown or quantity.display_unit(unit),
            (f"`{quantity.token}` of `{scene}`" if scene != "–" else "–"),
        )

    rows = (row(kind, *found) for kind, found in _kinds(more).items())
    return _table(("quantity", "symbol", "what it is", "unit", "for example"), rows)


def scenes() -> str:
    """Return the catalogue, a table for each chapter."""
    parts = []
    for chapter, members in chapters().items():
        rows = ((f"`{name}`", titles()[name], load(name).info.class_name) for name in members)
        parts.append(f"## {chapter.capitalize()}\n\n{_table(('name', 'title', 'class'), rows)}")
    return "\n\n".join(parts)


OPTIONS: Mapping[str, Callable[..., Any]] = {
    "path": request.task_of,
    "guide": guidance.task_of,
    "function": generation.task_of,
}
"""What takes the further options of a public function."""
MEMBERS = ("solve", "cycle", "pose", "period", "info", "quantities")
"""Of a scene."""


def _signature(name: str, thing: Callable[..., Any], more: Callable[..., Any] | None = None) -> str:
    """Return a call as it is written, with its defaults and without types."""
    given = dict(inspect.signature(thing).parameters)
    if more is not None:
        given.pop("options", None)
        given |= {key: one for key, one in inspect.signature(more).parameters.items() if key not in given}
    words: list[str] = []
    starred = False
    for key, one in given.items():
        if key in ("self", "progress"):
            continue
        if one.kind is one.KEYWORD_ONLY and not starred:
            words.append("*")
            starred = True
        usual = "Look()" if type(one.default).__name__ == "Look" else repr(one.default)
        words.append(key if one.default is one.empty else f"{key}={usual}")
    return f"{name}({', '.join(words)})"


def _said(thing: object) -> str:
    return (inspect.getdoc(thing) or "").strip()


def api() -> str:
    """Return every public name, with its docstring."""
    parts = []
    for name in sorted(linkanim.__all__, key=lambda name: (name[0] == "_", name[0].isupper(), name)):
        # the tests' own `load` stands in for it elsewhere
        thing = files.load if name == "load" else getattr(linkanim, name)
        if name == "__version__":
            parts.append("## linkanim.\\_\\_version\\_\\_\n\nThe version, as text.")
        elif inspect.isclass(thing):
            parts.append(f"## linkanim.{name}\n\n{_said(thing)}")
        else:
            call = _signature(f"linkanim.{name}", thing, OPTIONS.get(name))
            more = f"\n\n{_said(OPTIONS[name]).partition(chr(10) * 2)[2]}" if name in OPTIONS else ""
            parts.append(f"## linkanim.{name}\n\n```text\n{call}\n```\n\n{_said(thing)}{more}")
        if name == "Scene":
            parts += [_member(linkanim.Scene, member) for member in MEMBERS]
    return "\n\n".join(parts)


def _member(thing: type, name: str) -> str:
    member = inspect.getattr_static(thing, name)
    if inspect.isfunction(member):
        return f"### scene.{name}\n\n```text\n{_signature(f'scene.{name}', member)}\n```\n\n{_said(member)}"
    return f"### scene.{name}\n\n{_said(member)}"


_SIZE = 1280, 720
_PLAYED: Mapping[str, tuple[str, str, str, str]] = {
    "GIF": ("any slide program, browser or mail", "yes", "whole pixels only", "whole hundredths of a second"),
    "MP4": ("slide programs, browsers", "set it in the slide program", "none", "any"),
    "WebM": ("browsers (Safari without transparency)", "as the page says: `<video loop>`", "yes", "any"),
    "WebP": ("browsers", "yes", "yes, without loss", "whole milliseconds"),
    "APNG": ("browsers", "yes", "yes, without loss", "any"),
    "MOV": ("Keynote, video editors", "set it in the program", "yes (ProRes 4444)", "any"),
    "PNG": ("LaTeX `animate`, video editors", "as the player is told", "yes, without loss", "–"),
}
"""Of each format: where it plays, whether it loops by itself, its transparency, the times of its frames."""


def formats(folder: Path) -> str:
    """Return what each format of a recording is good for, with the size of one that is made here."""
    wide, high = _SIZE
    press, rows = linkanim.load("press"), []
    for form, (plays, loops, alpha, times) in _PLAYED.items():
        linkanim.record(press, folder / f"press.{form.lower()}", size=_SIZE)
        size = sum(file.stat().st_size for file in folder.glob(f"press*.{form.lower()}")) / 1e6
        name = "numbered PNG" if form == "PNG" else form
        rows.append((name, plays, loops, alpha, times, f"{significant(size, 2)} MB"))
    titles = ("", "plays in", "loops by itself", "transparency", "times of frames")
    return _table((*titles, f"the press, {wide}×{high}"), iter(rows))


BLOCKS: Mapping[str, tuple[str, Callable[[Path], str]]] = {
    "commands": ("commands.md", lambda _: commands()),
    "scene-file": ("scene-files.md", lambda _: reference()),
    "keys": ("keys.md", lambda _: as_markdown()),
    "scenes": ("scenes.md", lambda _: scenes()),
    "quantities": ("quantities.md", quantities),
    "api": ("api.md", lambda _: api()),
    "formats": ("loops.md", formats),
}
"""What is generated: the page that it stands in, and what makes it."""


@pytest.mark.parametrize(
    "block", [pytest.param(one, marks=[pytest.mark.long] * (one == "formats")) for one in BLOCKS]
)
def test_a_page_of_the_reference_is_what_the_program_s_tables_say(block: str, tmp_path: Path) -> None:
    name, made = BLOCKS[block]
    path, now = MANUAL / name, f"<!-- {block} -->\n{made(tmp_path)}\n<!-- /{block} -->"
    text = path.read_text(encoding="utf-8")
    shown = re.compile(rf"<!-- {block} -->\n.*<!-- /{block} -->", re.DOTALL)
    if os.environ.get("LINKANIM_GOLDENS") == "write":
        path.write_text(text := shown.sub(lambda _: now, text), encoding="utf-8")
    (kept,) = shown.findall(text)
    assert kept == now, f"{name} is {CHANGED}"


@pytest.mark.parametrize("command", COMMANDS)
def test_every_argument_has_a_sentence(command: str) -> None:
    assert [one.dest for one in _arguments(command) if not (one.help or "").strip()] == []


def test_every_kind_of_quantity_is_defined(tmp_path: Path) -> None:
    page = (MANUAL / "quantities.md").read_text(encoding="utf-8").partition("## Definitions")[2]
    defined = set(re.findall(r"`([\w.]+)`", "\n".join(re.findall(r"^\| (.*?) \|", page, re.MULTILINE))))
    kinds = {re.sub(r"^[A-Z]+\.(?!JOINT)", "", kind) for kind in _kinds(tmp_path)}
    assert kinds == defined


# Each section of the page on JSON: command lines whose objects' keys it lists.
PRINTED: Mapping[str, list[list[str]]] = {
    "solve": [["press", "--angle", "1 rad"], ["driven-piston", "--phase", "1 rad"]],
    "info": [[name] for name in ("crank-rocker", "press", "engine", "rocker-driven", "pumpjack")],
    "path": [["curve.csv", "--count", "1"], ["arc.csv", "--open", "--driver", "--count", "3"]],
    "guide": [["poses.csv", "--kind", "slider-crank", "--driver"]],
    "function": [["x^2", "--from", "0", "--to", "1", "--input", "60 deg", "--output", "60 deg", "--driver"]],
    "quick-return": [
        ["--kind", "six-bar", "--stroke", "80", "--ratio", "1.4"],
        ["--swing", "60 deg", "--ratio", "1.25"],
    ],
    "dwell": [
        ["--rest", "90 deg", "--stroke", "50"],
        ["--rest", "90 deg", "--swing", "40 deg", "--count", "1"],
    ],
    "quiz": [["press", "-n", "1"]],
    "make": [["crank-rocker"]],
    "closures": [["kite"]],
    "check": [["driven.toml"]],
}
UNSEEN = {
    "info": {"peak_force", "mean_force", "counterweights", "shaking_force", "shaking_moment"},
}
"""Of a slider that drives masses, and of a four-bar with masses, which no scene of the catalogue is."""


@pytest.mark.slow
@pytest.mark.parametrize("command", PRINTED)
def test_the_page_on_json_lists_the_keys_that_are_printed(
    command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("curve.csv").write_text("0,0\n40,5\n70,30\n40,45\n5,30\n", encoding="utf-8")
    Path("arc.csv").write_text("0,0\n20,8\n40,12\n60,12\n80,8\n100,0\n", encoding="utf-8")
    Path("poses.csv").write_text("0,0,0\n40,10,34\n70,-5,80\n", encoding="utf-8")
    Path("driven.toml").write_text(DRIVEN_SLIDER, encoding="utf-8")
    printed: set[str] = set()
    for words in PRINTED[command]:
        assert main([command, *words, "--json"]) == 0
        found = json.loads(capsys.readouterr().out)
        printed = printed.union(*(found if isinstance(found, list) else [found]))
    page = (MANUAL / "json.md").read_text(encoding="utf-8")
    section = page.split(f"## {command} --json\n")[1].split("\n## ")[0]
    listed = re.findall(r"^\| (`.*?) \|", section, re.MULTILINE)
    shown = {key for cell in listed for key in re.findall(r"`(\w+)`", cell)}
    if command == "info":
        shown |= UNSEEN["info"]
        printed |= UNSEEN["info"]
    assert shown == printed
