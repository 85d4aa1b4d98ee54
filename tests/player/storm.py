"""Everything that can come to an open window at random: events of every kind, and a world that changes."""

from __future__ import annotations

import errno
import math
import os
import shutil
import tomllib
from collections.abc import Callable, Iterator, Mapping
from contextlib import chdir, redirect_stdout
from dataclasses import replace
from functools import cache
from io import StringIO
from pathlib import Path
from random import Random

import pygame
import pytest
from playing import NoSearch, fake_start

from linkanim.cli import main
from linkanim.export import json_text
from linkanim.play.arcade import Arcade
from linkanim.player import background, files
from linkanim.player.action import Action
from linkanim.player.actions import carried
from linkanim.player.files import DraftFile, SceneFile
from linkanim.player.lesson import LessonStep
from linkanim.player.listing import Listing
from linkanim.player.modes import key_names
from linkanim.player.state import State, begin
from linkanim.scenes import load, names
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import text
from linkanim.synthesis.answers import PathAnswer
from linkanim.synthesis.follower import FollowPoses, Reply, Request
from linkanim.synthesis.guidance import PoseAnswer
from linkanim.ui import window as window_module
from linkanim.ui.devices import code
from linkanim.ui.window import Window
from linkanim.workshop.request import make

SIZES = ((320, 180), (640, 200), (180, 320), (64, 36), (2, 700), (700, 2), (1, 1), (800, 500))
_KEYS = [code(name) for name in key_names()]
_OFTEN = [
    *(code(name) for name in ("return", "escape", "up", "down", "left", "right", "o", "w", "e", ",", ".")),
    *(code(name) for name in ("f2", "f3", "f4", "f6", "f7", "f10")),
]
_RARE = {code(name) for name in ("f11", "q", "g", "m", "s", "f12")}
_MODS = (0, 0, 0, 0, pygame.KMOD_LSHIFT, pygame.KMOD_LCTRL, pygame.KMOD_LALT, pygame.KMOD_LCTRL | 1)
_STRANGE = (math.nan, math.inf, -math.inf, -1.0, 2.0, 1e300)
_FOUND = (
    ("quick-return", "--stroke", "80", "--ratio", "1.4"),
    ("quick-return", "--swing", "60 deg", "--ratio", "1.2"),
    ("guide", "poses.csv"),
    ("function", "table.csv"),
)
"""Commands that find linkages whose construction is drawn."""
_POSES = "0,0,0\n40,10,34\n70,-5,80\n"
_TABLE = "".join(f"{x},{x * x}\n" for x in range(1, 6))
_GUIDED = (0.0, 0.0, 0.0, 0.0, 40.0, 10.0, 0.6)
_BEGUN: Mapping[str, tuple[Action, ...]] = {
    "poses": (Action("poses"), Action("set_poses", _GUIDED)),
    "construction": (Action("construct", 2),),
    "layers": (Action("layers"),),
    "a joint's commands": (Action("menu", "things"),),
    "pencil": (Action("own_trace"),),
    "sheet": (Action("build_on"),),
    "lengths": (Action("edit"),),
    "lengths on a sheet": (Action("build_on"), Action("numbers")),
    "chart": (Action("chart", 1), Action("names")),
    "a step of a lesson": (Action("stage", LessonStep(load("whitworth"), running=False).text(1, 3)),),
    "a caption": (Action("caption_step"),),
    "anything": (Action("find"),),
}
"""What is on in a window that opens, by name."""
_LINKS = (30.0, 90.0, 45.0, 30.0, 100.0, 0.0, 80.0)


class Search(NoSearch):
    """Stands where the process that looks for linkages would; replies come late, and to old strokes too."""

    def __init__(self, random: Random) -> None:
        super().__init__()
        self._random = random

    def replies(self) -> Iterator[Reply]:
        random = self._random
        for request in self.asked if random.random() < 0.2 else ():
            row = (0.1, 1.0, *(length + random.uniform(-2, 2) for length in _LINKS))
            size, angle = random.uniform(0.3, 3.0), random.uniform(0.0, 1.2)
            numbers = PathAnswer(random.random(), 1.0, 0.3, 1.0, row, size, angle).numbers
            if isinstance(request, FollowPoses):
                numbers = PoseAnswer(0.0, 1.0, 0.3, 1.0, random.randrange(8), 0.7, 90.0, row).numbers
            whole = random.random() < 0.5
            way = numbers * random.randint(0, 4) if whole else ()
            error = "no linkage follows that" if random.random() < 0.1 else ""
            yield Reply(
                request.stroke, whole, numbers * random.randint(1, 3) if whole else numbers, 0, error, way
            )
        if random.random() < 0.3:
            self.asked: list[Request] = []


class Pad:
    """A gamepad that may be pulled out at any moment: it then answers with an error, as SDL's do."""

    def __init__(self, index: int) -> None:
        if index > 1:
            raise pygame.error("Invalid joystick device number")
        self._index, self.asked = index, 0

    def _answered(self, value: object) -> object:
        self.asked += 1
        if self.asked % 7 == 0:
            raise pygame.error("joystick not initialized")
        return value

    def get_name(self) -> object:
        return self._answered("Pad")

    def get_instance_id(self) -> object:
        return self._answered(self._index)

    def get_numhats(self) -> object:
        return self._answered(1 - self._index)


class Storm:
    """Windows on a folder of their own, one after the other, and what comes to them."""

    def __init__(self, seed: int, folder: Path, patch: pytest.MonkeyPatch, *, calm: bool = False) -> None:
        """Begin one; where it is `calm`, only keys and the wheel come, and nothing changes but the size."""
        self._random, self._folder, self._calm = Random(seed), folder, calm
        self.events = self.ticks = 0
        self._here = folder / "here"
        self._there()
        self._is_full = False
        self.met: set[tuple[str, str]] = set()  # modes, and what was carried out in them
        self._found = _found_scenes(folder)
        patch.setattr(background, "_start", self._started)
        patch.setattr(window_module, "carried", self._carried)
        patch.setattr(background, "Following", lambda *_: Search(self._random))
        patch.setattr(pygame.joystick, "Joystick", Pad)
        synced = os.fsync

        def full(number: int) -> None:
            if self._is_full:
                raise OSError(errno.ENOSPC, "No space left on device")
            synced(number)

        patch.setattr(os, "fsync", full)
        patch.setattr(files, "report", _found)

    def blow(self, events: int) -> None:
        """Post so many events, a few a frame; a window that closes is followed by another one."""
        end = self.events + events
        while self.events < end:
            window = self._opened()
            while self.events < end:
                for _ in range(self._random.choice((0, 1, 1, 2, 6))):
                    self._post(window)
                    self.events += 1
                if self._random.random() < 0.03:
                    self._change()
                self.ticks += 1
                if not window.tick(self._random.choice((1, 1, 1, 2, 30, 90))):
                    break
            self._there()
            window.close()

    def _opened(self) -> Window:
        """Return a window on a scene, a scene file, the title, a game or a sheet."""
        random = self._random
        self._there()
        keeper = Arcade(self._folder / "data" / "scores.json", random)
        own = self._here / "mine.toml"
        if own.is_dir():
            own.rmdir()
        found = random.choice(self._found) if random.random() < 0.4 else load(random.choice(names()))
        own.write_text(text(found), encoding="utf-8")
        mine = random.random() < 0.5
        scene = load(own) if mine else found
        state = replace(begin(scene), games=keeper.game_of, from_title=random.random() < 0.3)
        if random.random() < 0.3:
            words = random.choice(("title", "lobby", "menu", "match", "predict", "follow"))
            state = carried(state, Action("play", keeper.completed(words)))
        elif random.random() < 0.5:
            for action in random.choice(tuple(_BEGUN.values())):
                state = carried(state, action)
        drafts = DraftFile(self._folder / "data" / "draft.json")
        return Window(state, None, SceneFile(Path("mine.toml")) if mine else None, keeper, drafts)

    def _post(self, window: Window) -> None:
        kinds: list[Callable[[Window], pygame.event.Event]] = [
            *[self._key] * 6,
            *[self._mouse] * 6,
            *[self._finger] * 2,
            *[self._press] * 2,
            *[self._pad] * 2,
            self._drop,
            self._of_the_window,
        ]
        if self._calm:
            kinds = [self._key, self._key, self._wheel]
        pygame.event.post(self._random.choice(kinds)(window))

    def _key(self, _: Window) -> pygame.event.Event:
        random = self._random
        key = random.choice(_OFTEN if random.random() < 0.4 else _KEYS)
        if key in _RARE and random.random() < 0.8:
            key = code("space")
        if random.random() < 0.05:
            return pygame.event.Event(pygame.KEYUP, key=key, mod=0)
        typed = random.choice(("é", "ω", "\x00", "1", "9", "-", ".", "𝔸")) if random.random() < 0.1 else ""
        own = chr(key) if 32 <= key < 127 else ""
        return pygame.event.Event(pygame.KEYDOWN, key=key, mod=random.choice(_MODS), unicode=typed or own)

    def _place(self, window: Window) -> tuple[int, int]:
        """Return a pixel: anywhere, outside, on what can be pressed, or on a joint."""
        random, (width, height) = self._random, pygame.display.get_window_size()
        chance = random.random()
        if chance < 0.4:
            return random.randint(-5, width + 5), random.randint(-5, height + 5)
        if chance < 0.7 and window._good and (spots := _spots(window)):
            return random.choice(spots)
        places = list(window.state.shown.pose(window.state.phase, 0).position.values())
        try:
            x, y = window.screen.pixel(*random.choice(places))
        except AttributeError:  # nothing is painted yet
            return 0, 0
        inside = abs(x) < 1e5 and abs(y) < 1e5
        return (round(x), round(y)) if inside else (0, 0)

    def _mouse(self, window: Window) -> pygame.event.Event:
        random, at = self._random, self._place(window)
        match random.randrange(7):
            case 0 | 1:
                return pygame.event.Event(
                    pygame.MOUSEBUTTONDOWN, pos=at, button=random.choice((1, 1, 1, 2, 3))
                )
            case 2:
                return pygame.event.Event(pygame.MOUSEBUTTONUP, pos=at, button=random.choice((1, 1, 1, 3)))
            case 3:
                return self._wheel(window)
        return pygame.event.Event(pygame.MOUSEMOTION, pos=at, rel=(0, 0), buttons=(1, 0, 0))

    def _press(self, window: Window) -> pygame.event.Event:
        """Press where something is, and let go there or, with a few moves between, elsewhere."""
        random, at = self._random, self._place(window)
        button = random.choice((1, 1, 1, 3))
        pygame.event.post(pygame.event.Event(pygame.MOUSEBUTTONDOWN, pos=at, button=button))
        for _ in range(random.choice((0, 0, 0, 1, 3))):
            at = self._place(window)
            pygame.event.post(pygame.event.Event(pygame.MOUSEMOTION, pos=at, rel=(0, 0), buttons=(1, 0, 0)))
        return pygame.event.Event(pygame.MOUSEBUTTONUP, pos=at, button=button)

    def _wheel(self, _: Window) -> pygame.event.Event:
        return pygame.event.Event(pygame.MOUSEWHEEL, x=0, y=self._random.choice((-40, -1, 0, 1, 40)))

    def _finger(self, window: Window) -> pygame.event.Event:
        random, (width, height) = self._random, pygame.display.get_window_size()
        at = self._place(window)
        shares = at[0] / width, at[1] / height
        x, y = (random.choice(_STRANGE) if random.random() < 0.1 else share for share in shares)
        kind = random.choice((pygame.FINGERDOWN, pygame.FINGERMOTION, pygame.FINGERMOTION, pygame.FINGERUP))
        return pygame.event.Event(kind, finger_id=random.randrange(3), touch_id=1, x=x, y=y, dx=0.0, dy=0.0)

    def _pad(self, _: Window) -> pygame.event.Event:
        random, which = self._random, self._random.randrange(3)
        match random.randrange(7):
            case 0:
                return pygame.event.Event(pygame.JOYDEVICEADDED, device_index=which)
            case 1:
                return pygame.event.Event(pygame.JOYDEVICEREMOVED, instance_id=which)
            case 2:
                value = random.choice(_STRANGE) if random.random() < 0.1 else random.uniform(-1, 1)
                return pygame.event.Event(
                    pygame.JOYAXISMOTION, instance_id=which, axis=random.randrange(4), value=value
                )
            case 3:
                value2 = random.choice((-1, 0, 1)), random.choice((-1, 0, 1))
                return pygame.event.Event(pygame.JOYHATMOTION, instance_id=which, value=value2)
        kind = random.choice((pygame.JOYBUTTONDOWN, pygame.JOYBUTTONUP))
        return pygame.event.Event(kind, instance_id=which, button=random.randrange(20))

    def _drop(self, _: Window) -> pygame.event.Event:
        name = self._random.choice((*DROPPED, "n" * 300 + ".png", "a\0b.toml", "\udcff.png", "", ".", ".."))
        file = str(self._here / name) if self._random.random() < 0.7 else name
        return pygame.event.Event(pygame.DROPFILE, file=file)

    def _of_the_window(self, _: Window) -> pygame.event.Event:
        kinds = ("EXPOSED", "SIZECHANGED", "MINIMIZED", "HIDDEN", "RESTORED", "FOCUSLOST", "CLOSE", "LEAVE")
        kind = getattr(pygame, f"WINDOW{self._random.choice(kinds)}")
        if self._random.random() < 0.1:
            return pygame.event.Event(pygame.QUIT)
        return pygame.event.Event(kind)

    def _change(self) -> None:
        """Change the world: the window's size, a file, a folder, the disk."""
        random, data = self._random, self._folder / "data"
        match 0 if self._calm else random.randrange(10):
            case 0 | 1 | 2:
                pygame.display.set_mode(random.choice(SIZES), pygame.RESIZABLE)
            case 3 | 4:
                name = random.choice((*DROPPED, "mine.toml"))
                if self._here.exists():
                    put(self._here / name, random)
            case 5:
                self._is_full = not self._is_full
            case 6:
                shutil.rmtree(self._here / "recordings", ignore_errors=True)
            case 7:
                shutil.rmtree(self._here) if self._here.exists() else self._there()
            case 8:
                data.mkdir(exist_ok=True)
                name = random.choice(("draft.json", "scores.json"))
                (data / name).write_bytes(random.choice((b"", b"{", b'{"linkanim_scores": 7}', b"\xff" * 9)))
            case 9:
                shutil.rmtree(data, ignore_errors=True)

    def _carried(self, state: State, action: Action) -> State:
        """Carry an action out, and note that it came."""
        self.met.add((state.mode, action.name))
        return carried(state, action)

    def _started(self, command: list[str], message: int, out: int | None = None) -> object:
        """Start nothing: what renders has ended well; what looks for layers has found some, or has failed."""
        if out is None or self._random.random() < 0.3:
            return fake_start([])(command, message, out)
        if "--json" in command:
            os.write(out, _layers_of(Path(command[command.index("make") + 1]).read_text(encoding="utf-8")))
        return fake_start([])(command, message)

    def _there(self) -> None:
        """Have the current folder there again."""
        self._is_full = False
        self._here.mkdir(exist_ok=True)
        os.chdir(self._here)


def _spots(window: Window) -> list[tuple[int, int]]:
    """Return a pixel of each thing in sight that can be pressed: buttons, rows, answers, a slider, a dial."""
    shown, layout = window.screen, window.screen.last.layout
    places = [one.place for kind in ("button", "answer") for one in shown.targets(kind)]
    cells = [*places, layout.dial]
    middles = [cell.middle for cell in cells if cell]
    width, height = shown.size
    rows = [complex(width / 8, height * n / 9) for n in range(1, 9)] if window.state.of(Listing) else []
    return [(round(at.real), round(at.imag)) for at in (*middles, *rows)]


@cache
def _found_scenes(folder: Path) -> tuple[Scene, ...]:
    """Return linkages that were found: by poses, by a function, by a time ratio."""
    with chdir(folder), redirect_stdout(StringIO()):
        Path("poses.csv").write_text(_POSES, encoding="utf-8")
        Path("table.csv").write_text(_TABLE, encoding="utf-8")
        for number, words in enumerate(_FOUND):
            assert main((*words, "--count", "1", "-o", f"found-{number}.toml")) == 0
        return tuple(load(folder / f"found-{number}.toml") for number in range(len(_FOUND)))


@cache
def _layers_of(document: str) -> bytes:
    """Return what `linkanim make` prints of a scene file's text."""
    scene = scene_from(tomllib.loads(document), name="made", where="made.toml")
    return json_text(make(scene, fit="A4").as_object()).encode()


def _found(text: str, name: str) -> Path:
    """Stand where a fault's report would be written."""
    raise AssertionError(f"{name}: {text}")


DROPPED = ("a.toml", "b.toml", "photo.png", "gone.toml", "gone.jpg", "wide.bmp", "broken.webp", "folder.toml")
"""Names of what is dropped on a window; what lies under them comes and goes."""


def put(path: Path, random: Random) -> None:
    """Put something at a path, or take away what is there."""
    if path.is_dir():
        path.rmdir()
        return
    path.unlink(missing_ok=True)
    match path.suffix, random.randrange(4):
        case _, 0:
            return
        case _, 1:
            path.write_bytes(random.randbytes(40))
        case ".toml", 2:
            path.mkdir()
        case ".toml", _:
            path.write_text(text(load(random.choice(names()))), encoding="utf-8")
        case _:
            picture = pygame.Surface((random.randint(1, 300), random.randint(1, 300)))
            picture.fill([random.randrange(256) for _ in range(3)])
            pygame.image.save(picture, path.with_suffix(".png"))
            path.with_suffix(".png").replace(path)
