"""Files of other programs in the window: named, dropped or on the shelf; hostile ones are a sentence."""

from __future__ import annotations

import json
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path

import numpy as np
import pygame
import pytest
from playing import CTRL, Player, the

from linkanim.player.reassembling import OpenClosures
from linkanim.player.shelving import OpenShelf
from linkanim.player.state import begin
from linkanim.scenes import load
from linkanim.scenes.toml import parse
from linkanim.ui import screen, window

POINTS = {"O": (0.0, 0.0), "A": (10.0, 30.0), "B": (75.0, 62.0), "Q": (90.0, 5.0)}
LINKS = {"ground": ["O", "Q"], "crank": ["O", "A"], "coupler": ["A", "B"], "rocker": ["B", "Q"]}


def pyslvs() -> bytes:
    on = {name: ", ".join(link for link, own in LINKS.items() if name in own) for name in POINTS}
    joints = ", ".join(f"J[R, P[{x}, {y}], L[{on[name]}]]" for name, (x, y) in POINTS.items())
    return f"M[{joints}]".encode()


def linkage2() -> bytes:
    number = {name: n for n, name in enumerate(POINTS)}
    lines = ["<linkage2>"]
    for name, (x, y) in POINTS.items():
        marks = ' anchor="true"' * (name in LINKS["ground"]) + ' input="true" rpm="-20"' * (name == "O")
        lines.append(f'<connector id="{number[name]}" x="{x}" y="{y}"{marks}/>')
    for n, link in enumerate(("crank", "coupler", "rocker")):
        ends = "".join(f'<connector id="{number[point]}"/>' for point in LINKS[link])
        lines.append(f'<Link id="{n}">{ends}</Link>')
    return "".join((*lines, "</linkage2>")).encode()


def link_arrays() -> bytes:
    file, names = BytesIO(), list(POINTS)
    joined = np.zeros((4, 4))
    for one, other in (LINKS["crank"], LINKS["coupler"], LINKS["rocker"]):
        joined[names.index(one), names.index(other)] = joined[names.index(other), names.index(one)] = 1
    fixed = np.array([[name in LINKS["ground"]] for name in names], float)
    np.savez(file, A=joined, x0=np.array(list(POINTS.values())), node_types=fixed, motor=np.array([0, 1]))
    return file.getvalue()


def table() -> bytes:
    rows = [f"{name},{x},{y}" for name, (x, y) in POINTS.items()]
    rows += ["link,joints", *(",".join((name, *own)) for name, own in LINKS.items()), "drive,O"]
    return "\n".join(("name,x,y", *rows)).encode()


def motiongen() -> bytes:
    joints = [{"id": name, "x": x, "y": y, "isWelded": False} for name, (x, y) in POINTS.items()]
    links = [{"id": name, "jointIds": own, "isGround": name == "ground"} for name, own in LINKS.items()]
    motor = {"type": "rotary", "at": "O", "from": "Q", "to": "A", "velocity": 10}
    mechanism = {"joints": joints, "slots": [], "links": links, "cylinders": [], "actuators": [motor]}
    whole = {"name": "motiongen", "version": "1.1.5", "mechanism": mechanism}
    return json.dumps(whole | {"settings": {"linearUnit": "mm", "angularUnit": "rad"}}).encode()


FILES = {
    "my.pyslvs": pyslvs(),
    "my.linkage2": linkage2(),
    "my.npz": link_arrays(),
    "my.csv": table(),
    "my.motiongen": motiongen(),
}
HOSTILE = {
    "nothing": ("my.csv", b"", "no joints"),
    "no numbers": ("my.csv", b"A,0,inf\n", "no number"),
    "brackets without end": ("my.txt", b"M[" * 5000, "brackets do not match"),
    "what runs": ("my.txt", b"M[J[R, P[0, __import__('os')], L[ground]]]", "no expression"),
    "entities": ("my.linkage2", b'<!DOCTYPE x [<!ENTITY a "b">]><linkage2/>', "things of its own"),
    "torn XML": ("my.linkage2", b"<linkage2><connector", "no file of Linkage"),
    "no arrays": ("my.npz", b"PK\x03\x04", "no arrays"),
    "deep JSON": ("my.motiongen", b"{" * 5000, "nested deeper"),
    "a drawing": ("my.dxf", b"0\nSECTION\n", "seems to be a drawing"),
    "another kind": ("my.doc", b"hello", "what can be read are"),
    "not text": ("my.csv", b"\xff\xfe\x00", "not UTF-8"),
    "nowhere": ("gone.linkage2", b"", "no such file"),
    # a linkage, but one that cannot move
    "a triangle": ("my.csv", b"A,0,0\nB,1,0\nC,1,1\nlink\nground,A,B\na,A,C\nb,B,C\n", "mobility 0"),
}


@pytest.fixture
def player(here: Path) -> Iterator[Player]:
    del here
    with screen.opened((640, 360)):
        player = Player(begin(load("crank-rocker")))
        yield player
        player.window.close()


def drop(player: Player, file: Path) -> None:
    pygame.event.post(pygame.event.Event(pygame.DROPFILE, file=str(file)))
    player.tick(2)


@pytest.mark.parametrize("name", FILES)
def test_a_dropped_file_is_the_scene_and_stays_as_it_is(player: Player, here: Path, name: str) -> None:
    file = here / name
    file.write_bytes(FILES[name])
    drop(player, file)
    scene = player.state.scene
    assert scene.title == "my"
    assert len(scene.linkage.joints) == 4
    start = scene.solve(angle=scene.linkage.drive.start, derivatives=0).position.values()
    away = sorted(abs(complex(*map(float, place))) for place in start)
    assert away == pytest.approx(sorted(abs(complex(*place)) for place in POINTS.values()), abs=1e-9)
    player.press(pygame.K_s, CTRL)
    player.press(pygame.K_RETURN)
    player.tick(20)
    assert file.read_bytes() == FILES[name]
    saved = load(here / "my.toml")
    assert "form" in saved.document
    assert "points" in parse((here / "my.toml").read_text(encoding="utf-8"), "my.toml")


@pytest.mark.parametrize("case", HOSTILE.values(), ids=HOSTILE)
def test_what_is_no_linkage_is_one_sentence(player: Player, here: Path, case: tuple[str, bytes, str]) -> None:
    name, data, reason = case
    file, before = here / name, player.state.scene
    if data or name != "gone.linkage2":
        file.write_bytes(data)
    drop(player, file)
    assert player.state.scene is before
    assert player.state.toast
    assert reason in player.state.toast.text
    assert name in player.state.toast.text
    assert "Traceback" not in player.state.toast.text


def test_what_is_left_out_is_said(player: Player, here: Path) -> None:
    file = here / "my.linkage2"
    file.write_bytes(FILES["my.linkage2"].replace(b'<Link id="0">', b'<Link id="0" gear="true">'))
    drop(player, file)
    assert player.state.scene.title == "my"
    assert player.state.toast
    assert player.state.toast.text == "left out of it: the teeth of link 0"


def test_it_stands_on_the_shelf_and_is_loaded_again(player: Player, here: Path) -> None:
    file = here / "my.linkage2"
    file.write_bytes(FILES["my.linkage2"])
    player.press(pygame.K_o, CTRL)
    own = [one.name for one in the(player.state, OpenShelf).own]
    assert own == ["my.linkage2"]
    player.press(pygame.K_RETURN)
    player.tick(2)
    assert player.state.scene.title == "my"
    before = player.state.scene.linkage
    file.write_bytes(FILES["my.linkage2"].replace(b'x="90.0"', b'x="95.0"'))
    player.press(pygame.K_F5)
    player.tick(2)
    assert player.state.scene.linkage != before


def test_the_command_opens_it(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (here / "my.linkage2").write_bytes(FILES["my.linkage2"])
    seen = []

    def once(*_: object) -> Iterator[int]:
        yield 1

    class Watched(window.Window):
        def tick(self, frames: int = 1) -> bool:
            seen.append(self.state.scene.title)
            return super().tick(frames)

    monkeypatch.setattr(window, "frames", once)
    monkeypatch.setattr(window, "Window", Watched)
    assert window.run("my.linkage2", size=(320, 180)) == 0
    assert seen == ["my"]


def test_its_closures_are_shown(player: Player, here: Path) -> None:
    file = here / "my.csv"
    file.write_bytes(FILES["my.csv"])
    drop(player, file)
    player.press(pygame.K_b, CTRL)
    player.tick(3)
    assert len(the(player.state, OpenClosures).closures) == 2
