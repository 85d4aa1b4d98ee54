"""Match: joints are dragged until the coupler point runs along a dotted curve; three scores pull apart."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import pairwise

from linkanim.digits import significant
from linkanim.errors import BadInput, LinkanimError
from linkanim.picture.look import Look
from linkanim.picture.panels.overlay import Choice, GamePanel, Overlay, PathShown, ScoreBar
from linkanim.picture.text.text import subscripted
from linkanim.picture.view import Box
from linkanim.play.choosing import begun
from linkanim.play.match.level import Level, level_names, level_of
from linkanim.play.match.worth import Worth, trace, worth
from linkanim.play.words import GameWords
from linkanim.player.state.action import Action
from linkanim.player.state.handlers.games import play, with_scene
from linkanim.player.state.state import State, with_effect
from linkanim.scenes.reading.read import scene_from
from linkanim.scenes.scene import Scene
from linkanim.synthesis.fit import document_of
from linkanim.synthesis.kinds import FOUR_BAR, Linkage4
from linkanim.units import shown

_LOOSEST = 30.0
"""Off by as much of the curve's size, in percent, a linkage follows it not at all."""
_LARGEST = 4.0
"""So many times as long as for full score links earn nothing."""
_SHORTEST = 0.04
"""In curve sizes: no bar gets shorter."""
_FARTHEST = 12.0
"""In curve sizes: no joint gets further from the curve's middle."""
_STILL, _READ = 1e-6, 3
_KEPT = 60
"""So many drags can be taken back."""
_POINTS = 100
"""For each of the three."""
_NAMES = ("how exactly", "how small", "transmission angle")


@dataclass(frozen=True)
class MatchGame:
    """A level with the joints as they stand: since the last drag, or as the path solver has them (`gave_up`).

    `held` is the joint under the hand, `earlier` the linkages before each drag, `found` the worth of this, a
    moment old while one is held.
    """

    level: str
    joints: Linkage4
    found: Worth
    best: int = 0
    gave_up: bool = False
    held: str | None = None
    earlier: tuple[Linkage4, ...] = ()
    covers = True

    @property
    def words(self) -> str:
        """What begins it again with the joints where they are."""
        parts = (part for place in self.joints for part in (place.real, place.imag))
        words = GameWords("match", {}).having(level=self.level, best=self.best)
        return str(words.having(joints=",".join(map(repr, parts)), gave_up=1 if self.gave_up else ""))

    @property
    def of_level(self) -> Level:
        """What is to be followed."""
        return level_of(self.level)

    @property
    def points(self) -> tuple[int, ...]:
        """The three scores, 0 to 100."""
        return _earned(shares(self.found, self.of_level.full))

    def entered(self, state: State) -> State:
        """Return the state with the four-bar standing beside the curve."""
        look = Look(hud=False, theme=state.look.theme)
        scene, phase = _scene_of(self)
        return replace(with_scene(replace(state, look=look), scene, phase, paused=True), home=_home(self))

    def aged(self, state: State) -> State:
        """Let the scores follow the hand, at a third of the frames: who drags reads no faster."""
        if self.held is None or state.frame % _READ:
            return state
        return replace(state, game=self.judged)

    @property
    def judged(self) -> MatchGame:
        """The game with the worth of the joints as they are now."""
        return replace(self, found=worth(self.joints, self.of_level.curve))

    def carried(self, state: State, action: Action) -> State:
        """Drag a joint; run, step, take back; give up, or go on to another level."""
        match action:
            case Action("back"):
                return play(state, "lobby row=1")
            case Action("grab", str() as joint) if not self.gave_up and joint in self.free:
                return self._grabbed(state, joint)
            case Action("carry", (float() | int() as x, float() | int() as y, float() | int() as step)):
                return self._dragged(state, complex(x, y), float(step))
            case Action("drop") if self.held:
                return self._dropped(state)
            case Action("undo") if self.earlier and not self.held:
                *earlier, before = self.earlier
                return _put(state, replace(self, earlier=tuple(earlier)), before)
            case Action("next") if not self.held:
                return replace(state, clock=state.clock.pause(state.frame, not state.clock.paused))
            case Action("turn", int() as degrees) if not self.held:
                return replace(state, clock=state.clock.step(state.frame, degrees))
            case Action("scrub", float() | int() as phase) if not self.held:
                return replace(state, clock=state.clock.go(state.frame, float(phase), paused=True))
            case Action("raise", int() as steps) if not self.held:
                return self._beside(state, -1 if steps > 0 else 1)
            case Action("option", int() as choice) if not self.held:
                return self._chosen(state, choice)
        return state

    @property
    def kept_as(self) -> str:
        """What its best score is kept under."""
        return f"match-{self.level}"

    @property
    def free(self) -> tuple[str, ...]:
        """The joints that may be dragged."""
        return tuple(name for name in Linkage4._fields if name not in self.of_level.fixed)

    def _grabbed(self, state: State, joint: str) -> State:
        """Take hold of a joint as it stands at the moment."""
        places = state.scene.pose(state.phase, 0).position
        stand = Linkage4(*(complex(*places[name]) for name in Linkage4._fields))
        if max(abs(a - b) for a, b in zip(stand, self.joints, strict=True)) < _STILL:
            stand = self.joints  # to the last bit: a drag there and back is none
        stand = stand._replace(**{name: getattr(self.joints, name) for name in self.of_level.fixed})
        earlier = (*self.earlier, self.joints)[-_KEPT:]
        state = replace(state, clock=state.clock.pause(state.frame, True))
        return replace(state, game=replace(self, joints=stand, held=joint, earlier=earlier))

    def _dragged(self, state: State, to: complex, step: float) -> State:
        """Put the joint that is held near a place, in whole steps; the others stay where they are."""
        if self.held is None:
            return state
        place = complex(_stepped(to.real, step), _stepped(to.imag, step))
        joints = self.joints._replace(**{self.held: place})
        if joints == self.joints or not _is_sound(joints, self.of_level):
            return state
        return _put(state, self, joints)

    def _dropped(self, state: State) -> State:
        """Let go; a better score is handed on, a full one is heard."""
        game = self.judged
        total = sum(game.points)
        state = replace(state, game=replace(game, held=None, best=max(self.best, total)))
        if total <= self.best:
            return state
        state = with_effect(state, "score", f"best={self.kept_as}:{total}")
        return with_effect(state, "sound", "right") if total == 3 * _POINTS else state

    def _chosen(self, state: State, choice: int) -> State:
        """Give up or go back to one's own; begin again; go on to the next level."""
        level = self.of_level
        if choice == 0 and self.gave_up:
            own = self.earlier[-1] if self.earlier else level.start
            return _put(state, replace(self, gave_up=False, earlier=self.earlier[:-1]), own)
        earlier = (*self.earlier, self.joints)[-_KEPT:]
        if choice == 0 and level.answer:
            state = _put(state, replace(self, gave_up=True, earlier=earlier), level.answer)
            return replace(state, clock=state.clock.pause(state.frame, False))
        if choice == 1:
            return _put(state, replace(self, gave_up=False, earlier=earlier), level.start)
        return self._beside(state, 1) if choice == 2 else state

    def _beside(self, state: State, further: int) -> State:
        known = level_names()
        place = known.index(self.level) + further if self.level in known else 0
        return begun(state, "match", level=known[place % len(known)])

    def shown(self, state: State, over: Overlay) -> Overlay:
        """Return the overlay with the curve, the three bars, and what they come to."""
        level = self.of_level
        answer = shares(level.worth_of_answer, level.full)
        own = shares(self.found, level.full)
        points = _earned(own)
        known = zip(_NAMES, _worded(self.found), points, own, answer, strict=True)
        bars = tuple(
            ScoreBar(name, f"{text}   {some}", share, (mark, 1.0) if 0 < mark < 1 else (1.0,))
            for name, text, some, share, mark in known
        )
        choices = (
            Choice("1", "Back to mine" if self.gave_up else "Give up: the path solver's answer"),
            Choice("2", "Begin again"),
            Choice("3", "The next level"),
        )
        panel = GamePanel(
            level.title,
            scores=(self._place, f"{sum(points)} of {3 * _POINTS}", f"best {self.best}"),
            lines=tuple(filter(None, (level.about, self._fixed))),
            bars=bars,
            verdict=self._verdict(own, answer),
            well=not self.gave_up,
            choices=choices if level.answer else choices[1:],
            hint="drag joints (Shift: tenths)   Space runs   ← → turn   Ctrl+Z   ↑ ↓ level   Esc out",
        )
        handles = () if self.gave_up else self.free
        path = PathShown(level.curve, blank=False, marked=False)
        return replace(over, game=panel, path=path, handles=handles)

    @property
    def _fixed(self) -> str:
        """Say which joints stay."""
        names = [subscripted(name) for name in sorted(self.of_level.fixed)]
        return f"{' and '.join(names)} {'stays' if len(names) == 1 else 'stay'} in place." if names else ""

    @property
    def _place(self) -> str:
        known = level_names()
        return f"level {known.index(self.level) + 1} / {len(known)}" if self.level in known else self.level

    def _verdict(self, own: tuple[float, ...], answer: tuple[float, ...]) -> str:
        """Say what is reached, and where it beats the path solver."""
        if self.gave_up:
            better = [words for words, share in zip(_BETTER, answer, strict=True) if share < 1.0]
            return "The path solver's answer" + (f"; {_listed(better)} can be had" if better else "")
        reached = "Full score" if min(own) >= 1.0 else "It follows" if own[0] >= 1.0 else ""
        beaten = [words for words, mine, its in zip(_BETTER, own, answer, strict=True) if mine > its + 0.005]
        if reached and beaten and self.of_level.answer:
            return f"{reached}, with {_listed(beaten)} than the path solver's"
        return reached


_BETTER = ("a closer way", "smaller links", "a better transmission angle")
"""What is had where a linkage beats another one in each."""


def _listed(words: list[str]) -> str:
    return " and ".join(words)


def shares(found: Worth, full: Worth) -> tuple[float, float, float]:
    """Return how much of each full score a linkage earns, 0 to 1: by ratios for the first two."""
    away = min(max(found.off / full.off, 1.0), _LOOSEST / full.off)
    off = 1 - math.log(away) / math.log(_LOOSEST / full.off)
    links = 1 - math.log(max(found.links / full.links, 1.0)) / math.log(_LARGEST)
    return max(off, 0.0), max(links, 0.0), min(found.angle / full.angle, 1.0)


def _earned(three: tuple[float, float, float]) -> tuple[int, ...]:
    """Return shares of full scores in points."""
    return tuple(int(_POINTS * share + 1e-9) for share in three)


def _worded(found: Worth) -> tuple[str, str, str]:
    """Return the three in words."""
    off = f"{significant(found.off, 2)} % off" if found.off < _LOOSEST else "far off"
    return off, f"{found.links:.2f} sizes", f"{math.degrees(found.angle):.0f}°"


def _is_sound(joints: Linkage4, level: Level) -> bool:
    """Whether bars have some length, and joints are not far away."""
    ring = (joints.O2, joints.A, joints.B, joints.O4, joints.O2)
    size, middle = level.curve.size, level.curve.centre
    bars = (abs(b - a) for a, b in pairwise(ring))
    return min(bars) >= _SHORTEST * size and max(abs(one - middle) for one in joints) <= _FARTHEST * size


def _stepped(value: float, step: float) -> float:
    return round(round(value / step) * step, 6) + 0.0


def _put(state: State, game: MatchGame, joints: Linkage4) -> State:
    """Return the state with the joints elsewhere; as it is where they make no linkage."""
    game = replace(game, joints=joints)
    game = game if game.held else game.judged
    try:
        scene, phase = _scene_of(game)
    except LinkanimError:
        return state
    clock = state.clock.at_rate(state.frame, scene.linkage.drive.speed).go(state.frame, phase, paused=True)
    return replace(state, game=game, scene=scene, clock=clock, home=_home(game))


def _scene_of(game: MatchGame) -> tuple[Scene, float]:
    """Return the four-bar as a scene that starts where the joints stand, and the phase at which they do.

    Of a swing it is on the closure that is named.
    """
    joints, stated = game.joints, {"title": game.of_level.title, "source": "a level of linkanim"}
    document = document_of(FOUR_BAR, joints.row, joints.closure, (joints.angle, 1.0), **stated)
    scene = scene_from(document, name="match", where=game.level)
    near = 0.0 if scene.info.full_turn else math.pi / 2
    return scene, scene.mechanism.assembly.path.phase_of(joints.angle, near=near)


def _home(game: MatchGame) -> Box:
    """Return what is in sight: the curve with room around it, and all of an answer that is shown."""
    level = game.of_level
    points, size = level.curve.points, level.curve.size
    low, high = (complex(of(points.real), of(points.imag)) for of in (min, max))
    middle = (low + high) / 2
    reach = [middle + 1.1 * size * way for way in (1, -1, 0.95j, -0.95j)]
    reach += [*level.start, *(game.joints if game.gave_up else ())]
    reach += [*trace(game.joints)] if game.gave_up else []
    across, up = [place.real for place in reach], [place.imag for place in reach]
    return Box(float(min(across)), float(min(up)), float(max(across)), float(max(up)))


def first_unsolved(best: Mapping[str, int]) -> str:
    """Return the first level without full score, of the best scores so far; the first where all have it."""
    levels = level_names()
    return next((name for name in levels if best.get(f"match-{name}", 0) < 3 * _POINTS), levels[0])


def read(words: GameWords) -> MatchGame:
    """Return the level that words begin; BadInput where they do not."""
    name = words.fields.get("level", level_names()[0])
    level = level_of(name)
    given = words.fields.get("joints")
    joints = _joints_of(given) if given else level.start
    best, gave_up = words.whole("best", 0, 0, 3 * _POINTS), words.whole("gave_up", 0, 0, 1)
    return MatchGame(name, joints, worth(joints, level.curve), best, bool(gave_up))


def _joints_of(text: str) -> Linkage4:
    numbers = text.split(",")
    try:
        places = zip(numbers[::2], numbers[1::2], strict=True)
        joints = Linkage4(*(complex(float(x), float(y)) for x, y in places))
    except (ValueError, TypeError):
        raise BadInput(
            f"match: joints={shown(text)} are not ten numbers, x and y of O2, A, B, O4, P"
        ) from None
    if not all(abs(place) < 1e9 for place in joints) or joints.A == joints.B:
        raise BadInput(f"match: joints={shown(text)} make no four-bar")
    return joints
