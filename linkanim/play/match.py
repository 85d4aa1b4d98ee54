"""Match: joints are dragged until the coupler point runs along a dotted curve; three scores compete.

`Worth` rates a four-bar against a curve. `Level` has the curve, the joints at the beginning, and the worth
for full score; levels are files, or made from seeds.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cached_property, lru_cache
from itertools import pairwise
from pathlib import Path
from random import Random
from typing import NamedTuple, Self, TypeVar

import numpy as np

from linkanim.bounds import LONGEST_TEXT
from linkanim.errors import BadInput, LinkanimError
from linkanim.frozen import frozen
from linkanim.intake import Intake, Section, control_in, refuse_controls
from linkanim.picture.drawn import Addition, CurveBehind
from linkanim.picture.game_panel import Choice, GamePanel, ScoreBar
from linkanim.picture.look import Look
from linkanim.picture.text import subscripted
from linkanim.picture.view import Box
from linkanim.play.games import GameWords, begun
from linkanim.player.action import Action
from linkanim.player.actions import play, with_scene
from linkanim.player.state import (
    Game,
    State,
    with_effect,
)
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import parse
from linkanim.synthesis.answers import document_of
from linkanim.synthesis.curves import DrawnCurve, drawn
from linkanim.synthesis.linkages import FOUR_BAR, Complex, Linkage4, Real
from linkanim.units import angle, shown, significant
from linkanim.words import kept_as_said, row_said, said, said_many, to_say

# The worth of a four-bar for a curve: how exactly it follows, how small it is, how well it transmits.

_MOMENTS = 240


class Worth(NamedTuple):
    """A four-bar's deviation, size and least transmission angle.

    The deviation `off` is in percent of the curve's size; the size is the sum of the links, with the coupler
    point's arm from A, in sizes of the curve; the angle is in radians, 0 where the crank does not turn fully.
    """

    off: float
    links: float
    angle: float

    @classmethod
    def of(cls, joints: Linkage4, curve: DrawnCurve) -> Self:
        """Return the worth of a four-bar for a curve.

        `off` is the root mean square of the points' distances from the coupler curve; for a closed curve also
        that of the coupler curve's points from the curve, whichever is larger; infinite where there is no
        coupler curve.
        """
        row = np.array(joints.row)
        *lengths, _ = FOUR_BAR.link_lengths(row[None])[0]
        return cls(_off(joints, curve), float(np.sum(lengths) / curve.size), _least_angle(row))

    def shares(self, full: Worth) -> tuple[float, float, float]:
        """Return how much of each full score a linkage earns, 0 to 1: by ratios for the first two."""
        away = min(max(self.off / full.off, 1.0), _LOOSEST / full.off)
        off = 1 - math.log(away) / math.log(_LOOSEST / full.off)
        links = 1 - math.log(max(self.links / full.links, 1.0)) / math.log(_LARGEST)
        return max(off, 0.0), max(links, 0.0), min(self.angle / full.angle, 1.0)

    @property
    def words(self) -> tuple[str, str, str]:
        """Deviation, size and angle in words."""
        off = said("far off")
        if self.off < _LOOSEST:
            off = said("{share} % off", share=significant(self.off, 2))
        return off, said("{number} sizes", number=f"{self.links:.2f}"), f"{math.degrees(self.angle):.0f}°"


def _off(joints: Linkage4, curve: DrawnCurve) -> float:
    drawn = trace(joints)
    if len(drawn) < 2:
        return math.inf
    away = _distances(curve.points, drawn)
    if curve.closed:
        away = max(away, _distances(drawn, curve.polyline))
    return 100 * away / curve.size


def trace(joints: Linkage4) -> Complex:
    """Return the coupler curve, with its first point again at the end.

    A crank that swings comes back on the other closure.
    """
    rows, step = np.array([joints.row]), 2 * math.pi / _MOMENTS
    angles: Real = joints.angle + step * np.arange(_MOMENTS + 1, dtype=np.float64)
    curves = list[Complex]()
    with np.errstate(all="ignore"):
        curves += [FOUR_BAR.points(rows, np.array([side]), angles[None])[0] for side in (1.0, -1.0)]
    there, back = curves if joints.closure > 0 else curves[::-1]
    if np.isfinite(there).all():
        return there
    gaps = np.flatnonzero(~np.isfinite(there))
    # the range of the crank, from limit to limit, and back
    open_ = np.arange(gaps[-1] + 1 - _MOMENTS, gaps[0])
    path: Complex = np.concatenate([there[open_ % _MOMENTS], back[open_[::-1] % _MOMENTS]])
    path = path[np.isfinite(path)]
    return np.append(path, path[:1])


def _distances(points: Complex, line: Complex) -> float:
    """Return the root mean square of the points' distances from a line through others."""
    begin, side = line[:-1], np.diff(line)
    from_begin = points[:, None] - begin
    square = np.maximum(side.real**2 + side.imag**2, 1e-300)
    share = np.clip((from_begin * side.conj()).real / square, 0.0, 1.0)
    nearest: Real = np.abs(from_begin - share * side).min(axis=1)
    return float(np.sqrt(np.mean(nearest**2)))


def _least_angle(row: Real) -> float:
    """Return the least transmission angle of a crank that turns fully, by the cosine rule; else 0."""
    x, y, crank, a, _, _, x4, y4, b = row
    ground = math.hypot(x4 - x, y4 - y)
    angles = []
    for far in (abs(ground - crank), ground + crank):
        cosine = (a * a + b * b - far * far) / max(2 * a * b, 1e-300)
        if not abs(cosine) < 1.0:
            return 0.0
        angles.append(math.acos(abs(cosine)))
    return min(angles)


# The levels of Match: a dotted curve, where the joints begin, what full score takes; files, or seeds.

Made = TypeVar("Made")
FOLDER = Path(__file__).parent / "levels"
_FILE = Intake("a level", most_bytes=100_000, most_values=5_000)
_KEYS = frozenset({"title", "about", "closed", "points", "fixed", "start", "full", "answer"})
_JOINTS = Linkage4._fields
_LONGEST_SEED = 18
_BEGINNING = Linkage4(-60 - 60j, -40 - 40j, 40 + 20j, 60 - 60j, 0 + 0j)
"""The first places of the joints of a level made from a seed, for a curve of size 100."""


@frozen(eq=False)
class Level:
    """A curve to follow, the joints at the beginning, those that are fixed, and the worth for full score.

    `answer` is shown to a player who gives up; as a rule it is the path solver's.
    """

    name: str
    title: str
    about: str
    curve: DrawnCurve
    start: Linkage4
    fixed: frozenset[str]
    full: Worth
    answer: Linkage4 | None

    @cached_property
    def worth_of_answer(self) -> Worth:
        """The worth of the answer; the worst where there is no answer."""
        return Worth.of(self.answer, self.curve) if self.answer else Worth(math.inf, math.inf, 0.0)

    @cached_property
    def _given(self) -> float:
        """How well the linkage follows the curve at the beginning of the level."""
        return min(Worth.of(self.start, self.curve).shares(self.full)[0], 0.99)

    def earned(self, reached: Worth) -> tuple[float, float, float]:
        """Return the share of each full score that a linkage earns, 0 to 1.

        A linkage that follows no better than the one at the beginning earns nothing; size and angle count
        only in proportion to how well it follows.
        """
        off, links, angle = reached.shares(self.full)
        gained = max(off - self._given, 0.0) / (1.0 - self._given)
        return gained, gained * links, gained * angle


@lru_cache(maxsize=1)
def level_names() -> tuple[str, ...]:
    """Return the levels of the package, the first ones first."""
    files = sorted(entry.name for entry in FOLDER.iterdir() if entry.name.endswith(".toml"))
    return tuple(name.removesuffix(".toml").split("-", 1)[1] for name in files)


@kept_as_said(4)
def level_of(name: str) -> Level:
    """Return a level by its name, by the path of its file, or made from `seed-N`.

    BadInput with file, key and way out where there is none, or where it makes no sense.
    """
    if len(name) > LONGEST_TEXT or control_in(name):
        raise BadInput(f"match: {shown(name)} cannot be a level's name; rename the file")
    if name.endswith(".toml"):
        return _read(_FILE.read(Path(name), name), name, Path(name).stem)
    seed = name.removeprefix("seed-")
    if name.startswith("seed-") and seed.isdecimal() and len(seed) <= _LONGEST_SEED:
        return made(int(seed))
    for number, known in enumerate(level_names(), start=1):
        if known == name:
            file = f"{number:02}-{name}.toml"
            return _read((FOLDER / file).read_text(encoding="utf-8"), file, name)
    raise BadInput(
        f"match: there is no level {shown(name)}; there are {', '.join(level_names())}, seed-1, seed-2, … "
        "and files of your own, such as levels/mine.toml"
    )


def _read(text: str, where: str, name: str) -> Level:
    _FILE.refuse_heavy(text, where)
    document = Section(where, parse(text, where))
    refuse_controls(document)
    for key in document.values:
        if key not in _KEYS:
            raise document.error(key, f"is no key of a level; there are {', '.join(sorted(_KEYS))}")
    full = document.table("full")
    closed, points = document.flag("closed"), _points(document)
    curve = _value_of(document, "points", lambda: drawn(points, closed=closed))
    fixed = document.texts("fixed")
    for joint in fixed:
        if joint not in _JOINTS:
            raise document.error("fixed", f"{shown(joint)} is no joint; there are {', '.join(_JOINTS)}")
    return Level(
        name,
        document.text("title"),
        document.text("about", ""),
        curve,
        _joints(document.table("start")),
        frozenset(fixed),
        Worth(_positive(full, "off"), _positive(full, "links"), _stated_least_angle(full)),
        _joints(document.table("answer")) if "answer" in document else None,
    )


def _value_of(section: Section, key: str, make: Callable[[], Made]) -> Made:
    """Return what `make` returns for a key's value; an error names the key."""
    try:
        return make()
    except BadInput as error:
        raise section.at(f"{section.key(key)}: {error}", key) from None


def _stated_least_angle(full: Section) -> float:
    least = _value_of(full, "angle", lambda: angle(full.text("angle")))
    if not 0.0 < least <= math.pi / 2:
        raise full.error("angle", 'must be a transmission angle, such as "40 deg"')
    return least


def _positive(section: Section, key: str) -> float:
    value = section.number(key)
    if value <= 0:
        raise section.error(key, "must be above zero")
    return value


def _points(document: Section) -> Complex:
    listed = document.listed("points")
    return np.array([_point(listed, key) for key in listed.values], np.complex128)


def _point(section: Section, key: str) -> complex:
    pair = section.listed(key, 2)
    x, y = (pair.number(item) for item in pair.values)
    return complex(x, y)


def _joints(section: Section) -> Linkage4:
    return Linkage4(*(_point(section, name) for name in _JOINTS))


def made(seed: int) -> Level:
    """Return a level made from a seed: the curve of a crank-rocker or drag-link, itself the answer."""
    random = np.random.default_rng(seed)
    while True:
        rows = FOUR_BAR.random_rows(random, 64)
        good = np.flatnonzero((FOUR_BAR.margins(rows, math.radians(30)) > 0).all(axis=1))
        if len(good):
            break
    joints = Linkage4.of(rows[good[0]], Random(seed).uniform(0, 2 * math.pi))
    curve = trace(joints)[:-1:4]
    size = math.hypot(np.ptp(curve.real), np.ptp(curve.imag))
    middle = complex(curve.mean())
    answer = Linkage4(*(100 * (place - middle) / size for place in joints))
    target = drawn(100 * (curve - middle) / size, closed=True)
    best = Worth.of(answer, target)
    full = Worth(1.5, 1.1 * best.links, best.angle - math.radians(3))
    return Level(
        f"seed-{seed}",
        said("Curve {number}", number=seed),
        "",
        target,
        _BEGINNING,
        frozenset(),
        full,
        answer,
    )


# Match: joints are dragged until the coupler point runs along a dotted curve; three scores compete.

_LOOSEST = 30.0
"""The deviation, in percent of the curve's size, from which on a linkage does not follow the curve at all."""
_LARGEST = 4.0
"""Links that are this many times as long as for full score earn nothing."""
_SHORTEST = 0.04
"""The shortest bar, in sizes of the curve."""
_FARTHEST = 12.0
"""The farthest that a joint may be from the curve's middle, in sizes of the curve."""
_STILL, _READ = 1e-6, 3
_KEPT = 60
"""The most drags that can be undone."""
_POINTS = 100
"""The points for each of the three full scores."""
_GOAL = to_say(
    "Drag joints until the coupler point runs along the dots; size and angle count as far as it does."
)
_NAMES = (to_say("how exactly"), to_say("how small"), to_say("transmission angle"))


@frozen
class MatchGame(Game):
    """A level with the joints as they are: after the last drag, or those of the answer (`gave_up`).

    `held` is the joint under the hand, `earlier` the linkages before each drag, `worth` the worth of the
    linkage, which lags behind a little while a joint is held.
    """

    level: str
    joints: Linkage4
    worth: Worth
    best: int = 0
    gave_up: bool = False
    held: str | None = None
    earlier: tuple[Linkage4, ...] = ()

    @property
    def words(self) -> str:
        """The words that begin the level with the joints where they are now."""
        parts = (part for place in self.joints for part in (place.real, place.imag))
        words = GameWords("match", {}).having(level=self.level, best=self.best)
        return str(words.having(joints=",".join(map(repr, parts)), gave_up=1 if self.gave_up else ""))

    @property
    def of_level(self) -> Level:
        """The level that is played."""
        return level_of(self.level)

    @property
    def points(self) -> tuple[int, ...]:
        """The three scores, 0 to 100."""
        return _earned(self.of_level.earned(self.worth))

    def entered(self, state: State) -> State:
        """Return the state with the four-bar at rest beside the curve."""
        look = Look(hud=False, theme=state.look.theme)
        scene, phase = _scene_of(self)
        return replace(with_scene(replace(state, look=look), scene, phase, paused=True), home=_home(self))

    def aged(self, state: State) -> State:
        """Let the scores follow the hand in every third frame: during a drag nobody reads faster."""
        if self.held is None or state.frame % _READ:
            return state
        return state.with_mode(self.judged)

    @property
    def judged(self) -> MatchGame:
        """The game with the worth of the joints as they are now."""
        return replace(self, worth=Worth.of(self.joints, self.of_level.curve))

    def carried(self, state: State, action: Action) -> State:
        """Drag a joint; run, step, undo; give up, or go on to another level."""
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
        """The name under which its best score is stored."""
        return f"match-{self.level}"

    @property
    def free(self) -> tuple[str, ...]:
        """The joints that may be dragged."""
        return tuple(name for name in Linkage4._fields if name not in self.of_level.fixed)

    def _grabbed(self, state: State, joint: str) -> State:
        """Grasp a joint in the present pose."""
        places = state.scene.pose(state.phase, 0).position
        stand = Linkage4(*(complex(*places[name]) for name in Linkage4._fields))
        if max(abs(a - b) for a, b in zip(stand, self.joints, strict=True)) < _STILL:
            stand = self.joints  # the same bits, so that a drag there and back changes nothing
        stand = stand._replace(**{name: getattr(self.joints, name) for name in self.of_level.fixed})
        earlier = (*self.earlier, self.joints)[-_KEPT:]
        state = replace(state, clock=state.clock.pause(state.frame, True))
        return state.with_mode(replace(self, joints=stand, held=joint, earlier=earlier))

    def _dragged(self, state: State, to: complex, step: float) -> State:
        """Put the held joint near a place, in whole steps; the others stay where they are."""
        if self.held is None:
            return state
        place = complex(_stepped(to.real, step), _stepped(to.imag, step))
        joints = self.joints._replace(**{self.held: place})
        if joints == self.joints or not _is_sound(joints, self.of_level):
            return state
        return _put(state, self, joints)

    def _dropped(self, state: State) -> State:
        """Release the joint; a better score is stored."""
        game = self.judged
        total = sum(game.points)
        state = state.with_mode(replace(game, held=None, best=max(self.best, total)))
        if total <= self.best:
            return state
        return with_effect(state, "score", f"best={self.kept_as}:{total}")

    def _chosen(self, state: State, choice: int) -> State:
        """Give up, or go back to the player's own linkage; begin again; go on to the next level."""
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

    @property
    def draggable(self) -> tuple[str, ...]:
        """The joints that can be dragged."""
        return () if self.gave_up else self.free

    def drawn(self, state: State) -> tuple[Addition, ...]:
        """Return the curve."""
        del state
        return (CurveBehind(self.of_level.curve),)

    def panel(self, state: State) -> GamePanel:
        """Return the three bars, and their scores."""
        del state
        level = self.of_level
        answer = level.earned(level.worth_of_answer)
        own = level.earned(self.worth)
        points = _earned(own)
        known = zip(_NAMES, self.worth.words, points, own, answer, strict=True)
        bars = tuple(
            ScoreBar(said(name), f"{text}   {some}", share, (mark, 1.0) if 0 < mark < 1 else (1.0,))
            for name, text, some, share, mark in known
        )
        choices = (
            Choice("1", said("Back to mine") if self.gave_up else said("Give up: the path solver's answer")),
            Choice("2", said("Begin again")),
            Choice("3", said("The next level")),
        )
        return GamePanel(
            said(level.title),
            scores=(
                self._place,
                said("{number} of {count}", number=sum(points), count=3 * _POINTS),
                said("best {score}", score=self.best),
            ),
            lines=tuple(filter(None, (said(_GOAL), said(level.about), self._fixed))),
            bars=bars,
            verdict=self._verdict(own, answer),
            well=not self.gave_up,
            choices=choices if level.answer else choices[1:],
            hint=said("drag joints (Shift: tenths)   Space runs   ← → turn   Ctrl+Z   ↑ ↓ level   Esc out"),
        )

    @property
    def _fixed(self) -> str:
        """Say which joints are fixed."""
        names = [subscripted(name) for name in sorted(self.of_level.fixed)]
        if not names:
            return ""
        return said_many(
            "{names} stays in place.", "{names} stay in place.", len(names), names=row_said(names)
        )

    @property
    def _place(self) -> str:
        known = level_names()
        if self.level not in known:
            return self.level
        return said("level {number} / {count}", number=known.index(self.level) + 1, count=len(known))

    def _verdict(self, own: tuple[float, ...], answer: tuple[float, ...]) -> str:
        """Say what the linkage reaches, and where it beats the path solver."""
        if self.gave_up:
            better = [said(words) for words, share in zip(_BETTER, answer, strict=True) if share < 1.0]
            if not better:
                return said("The path solver's answer")
            return said("The path solver's answer; {better} can be had", better=row_said(better))
        reached = said("Full score") if min(own) >= 1.0 else said("It follows") if own[0] >= 1.0 else ""
        beaten = [
            said(words) for words, mine, its in zip(_BETTER, own, answer, strict=True) if mine > its + 0.005
        ]
        if reached and beaten and self.of_level.answer:
            return said(
                "{reached}, with {beaten} than the path solver's",
                reached=reached,
                beaten=row_said(beaten),
            )
        return reached


_BETTER = (to_say("a closer way"), to_say("smaller links"), to_say("a better transmission angle"))
"""The words for a linkage that beats another one in each of the three."""


def _earned(three: tuple[float, float, float]) -> tuple[int, ...]:
    """Return shares of full scores in points."""
    return tuple(int(_POINTS * share + 1e-9) for share in three)


def _is_sound(joints: Linkage4, level: Level) -> bool:
    """Whether no bar is too short, and no joint too far away."""
    ring = (joints.O2, joints.A, joints.B, joints.O4, joints.O2)
    size, middle = level.curve.size, level.curve.centre
    bars = (abs(b - a) for a, b in pairwise(ring))
    return min(bars) >= _SHORTEST * size and max(abs(one - middle) for one in joints) <= _FARTHEST * size


def _stepped(value: float, step: float) -> float:
    return round(round(value / step) * step, 6) + 0.0


def _put(state: State, game: MatchGame, joints: Linkage4) -> State:
    """Return the state with other joints; unchanged where they make no linkage."""
    game = replace(game, joints=joints)
    game = game if game.held else game.judged
    try:
        scene, phase = _scene_of(game)
    except LinkanimError:
        return state
    clock = state.clock.at_rate(state.frame, scene.linkage.drive.speed).go(state.frame, phase, paused=True)
    return replace(state.with_mode(game), scene=scene, clock=clock, home=_home(game))


def _scene_of(game: MatchGame) -> tuple[Scene, float]:
    """Return the four-bar as a scene that starts at the joints' places, and the phase of that pose.

    For an input that swings it is on the closure that is named.
    """
    joints, stated = game.joints, {"title": game.of_level.title, "source": "a level of linkanim"}
    document = document_of(FOUR_BAR, joints.row, joints.closure, (joints.angle, 1.0), **stated)
    scene = scene_from(document, name="match", where=game.level)
    near = 0.0 if scene.info.full_turn else math.pi / 2
    return scene, scene.mechanism.phase_of(joints.angle, near=near)


def _home(game: MatchGame) -> Box:
    """Return the visible part: the curve with room around it, and all of a shown answer."""
    level = game.of_level
    points, size = level.curve.points, level.curve.size
    low, high = (complex(of(points.real), of(points.imag)) for of in (min, max))
    middle = (low + high) / 2
    reach = [middle + 1.1 * size * side for side in (1, -1, 0.95j, -0.95j)]
    reach += [*level.start, *(game.joints if game.gave_up else ())]
    reach += [*trace(game.joints)] if game.gave_up else []
    across, up = [place.real for place in reach], [place.imag for place in reach]
    return Box(float(min(across)), float(min(up)), float(max(across)), float(max(up)))


def first_unsolved(best: Mapping[str, int]) -> str:
    """Return the first level whose best score so far is not full; the first level where all are full."""
    levels = level_names()
    return next((name for name in levels if best.get(f"match-{name}", 0) < 3 * _POINTS), levels[0])


def read(words: GameWords) -> MatchGame:
    """Return the level that words begin; BadInput where they do not."""
    name = words.fields.get("level", level_names()[0])
    level = level_of(name)
    given = words.fields.get("joints")
    joints = _joints_of(given) if given else level.start
    best, gave_up = words.whole("best", 0, 0, 3 * _POINTS), words.whole("gave_up", 0, 0, 1)
    return MatchGame(name, joints, Worth.of(joints, level.curve), best, bool(gave_up))


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
