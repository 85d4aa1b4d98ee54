"""The printer for surfaces: still parts are one bitmap, and shapes that recur are worked out once."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Sequence
from itertools import groupby
from operator import attrgetter

import pygame

from linkanim.mechanics.motion import Pose
from linkanim.mechanics.program import keep_memory
from linkanim.picture.drawn import NOTHING_ADDED, Additions
from linkanim.picture.items import SHEET, Caption, Group, Target, flat
from linkanim.picture.picture import Picture
from linkanim.picture.raster import (
    Cover,
    Shapes,
    covers,
    ground_clear,
    in_turn,
    is_clear,
    paints,
)
from linkanim.picture.text import Lettering, Type

_MOST_PICTURES, _MOST_BYTES = 8, 100_000_000
"""The most memory for cached shapes: that of so many pictures, and so many bytes."""
_SPARE_LABELS = 8
"""The number of cached labels that were not in the last frame."""


class SurfacePrinter:
    """Prints pictures on surfaces: one pose of one picture has the same bytes, whatever was printed before.

    It caches what recurs from picture to picture, which only saves time. Its `targets` are where what was
    printed last can be clicked.
    """

    def __init__(self) -> None:
        keep_memory()
        self._picture: Picture | None = None
        self._still: tuple[tuple[Group, ...], pygame.Surface] | None = None
        self._covers: dict[Hashable, tuple[tuple[Group, ...], Cover]] = {}
        self._labels = _Labels()
        self.targets: tuple[Target, ...] = ()
        self._paper: tuple[Group, pygame.Surface] | None = None

    def print(
        self,
        surface: pygame.Surface,
        picture: Picture,
        phase: float,
        speed: float,
        beside: Additions = NOTHING_ADDED,
    ) -> None:
        """Print a phase of a picture, with its other closure faintly behind it if shown."""
        pose, faint = picture.poses(phase, speed)
        self.paint(surface, picture, pose, beside, faint=faint)

    def paint(
        self,
        surface: pygame.Surface,
        picture: Picture,
        pose: Pose,
        beside: Additions = NOTHING_ADDED,
        *,
        faint: Sequence[Pose] = (),
    ) -> None:
        """Print a pose of a picture, and what is drawn beside its scene; changes the surface only.

        Picture and surface have the same top left corner where their sizes differ.
        """
        if picture is not self._picture:
            self._picture, self._still = picture, None
            self._covers.clear()
        first, *others = _runs(picture.groups(pose, beside, faint=faint))
        canvas = self._on_still(surface, picture, first)
        parted = [_parts(run) for run in others]
        fresh = [_shapes(groups) for parts in parted for key, groups in parts if key is None]
        covers = in_turn(canvas, fresh)
        for run, parts in zip(others, parted, strict=True):
            for key, groups in parts:
                for cover in next(covers) if key is None else (self._kept(canvas, key, groups),):
                    cover.put(canvas)
            self._words(canvas, picture.type, run, whole=picture.held)
        self._labels.let_go()
        self.targets = tuple(target for run in (first, *others) for group in run for target in group.targets)
        if is_clear(canvas):
            ground_clear(canvas, picture.theme.background)
        if canvas is not surface:
            surface.blit(canvas, (0, 0))

    def _on_still(
        self, surface: pygame.Surface, picture: Picture, still: tuple[Group, ...]
    ) -> pygame.Surface:
        """Return the surface, or a canvas where that is of another kind, with the still part on it."""
        if self._still is None or not _same(self._still[0], still):
            self._still = still, self._bitmap(picture, still)
        bitmap = self._still[1]
        alike = surface.get_size() == picture.size and surface.get_masks() == bitmap.get_masks()
        canvas = surface if alike and paints(surface) else bitmap.copy()
        if is_clear(canvas):
            canvas.fill((0, 0, 0, 0))
        canvas.blit(bitmap, (0, 0))
        return canvas

    def _bitmap(self, picture: Picture, still: tuple[Group, ...]) -> pygame.Surface:
        """Return the background with the still part on it."""
        filled = picture.look.background
        bitmap = pygame.Surface(picture.size, 0 if filled else pygame.SRCALPHA, 32)
        bitmap.fill((*picture.theme.background, 255 if filled else 0))
        if still and still[0].name == SHEET:
            bitmap.blit(self._papered(still[0], bitmap), (0, 0))
            still = still[1:]
        _cover(bitmap, still).put(bitmap)
        self._words(bitmap, picture.type, still)
        return bitmap

    def _papered(self, paper: Group, bare: pygame.Surface) -> pygame.Surface:
        """Return the sheet on which a linkage is built, drawn once while a hand changes the linkage."""
        if self._paper is None or self._paper[0] is not paper:
            drawn = bare.copy()
            if paper.under:
                paper.under.draw(drawn)
            _cover(drawn, [paper]).put(drawn)
            self._paper = paper, drawn
        return self._paper[1]

    def _kept(self, canvas: pygame.Surface, key: Hashable, groups: tuple[Group, ...]) -> Cover:
        """Return what groups do to the canvas, worked out once for each key."""
        if key not in self._covers:
            cover = _cover(canvas, groups)
            taken = sum(kept.nbytes for _, kept in self._covers.values()) + cover.nbytes
            if taken > min(_MOST_PICTURES * canvas.get_buffer().length, _MOST_BYTES):
                self._covers.clear()
            self._covers[key] = groups, cover
        return self._covers[key][1]

    def _words(
        self, canvas: pygame.Surface, type_: Type, run: tuple[Group, ...], *, whole: bool = False
    ) -> None:
        """Write the words of groups; those in a halo to a fraction of a pixel, or to a `whole` pixel."""
        for line in (line for group in run for line in group.captions):
            if line.halo:
                self._labels.draw(canvas, line, type_, whole=whole)
            else:
                text, at, size, colour, anchor, strong, *_ = line
                type_.draw(canvas, text, at, size=size, colour=colour, anchor=anchor, strong=strong)


class _Labels:
    """Lines in their halo as they were drawn: those of the last frame, and a few more."""

    def __init__(self) -> None:
        self._kept: dict[Hashable, Lettering] = {}
        self._drawn: set[Hashable] = set()

    def draw(self, surface: pygame.Surface, line: Caption, type_: Type, *, whole: bool) -> None:
        """Draw a line in its halo."""
        assert line.halo
        key = _label_key(line)
        self._drawn.add(key)
        if key not in self._kept:
            colours = line.colour, line.halo.colour
            self._kept[key] = Lettering(line.text, type_, line.size, colours, line.halo.width)
        letters = self._kept[key]
        aside = {"left": 0.5, "centre": 0.0, "right": -0.5}[line.anchor] * letters.size[0]
        letters.draw(surface, complex(line.at[0] + aside, line.at[1] + letters.drop), whole=whole)

    def let_go(self) -> None:
        """Forget labels that the frame just ended did not draw, except a few."""
        if len(self._kept) > len(self._drawn) + _SPARE_LABELS:
            self._kept = {key: self._kept[key] for key in self._drawn}
        self._drawn.clear()


def _label_key(line: Caption) -> Hashable:
    return line.text, line.size, line.colour, line.halo


def _runs(groups: Iterable[Group]) -> Iterator[tuple[Group, ...]]:
    """Yield groups in runs: all shapes of a run lie below all its words; still groups have own runs."""
    run: list[Group] = []
    for group in groups:
        if run and (group.over or group.still != run[-1].still):
            yield tuple(run)
            run = []
        run.append(group)
    if run:
        yield tuple(run)


def _same(one: tuple[Group, ...], other: tuple[Group, ...]) -> bool:
    return len(one) == len(other) and all(a is b for a, b in zip(one, other, strict=True))


def _parts(run: tuple[Group, ...]) -> list[tuple[Hashable, tuple[Group, ...]]]:
    """Return the groups of a run in parts that are filled one after the other, with their keys.

    The key of a still part is its groups, which are kept; None marks a part that is filled anew at every
    pose.
    """
    if run[0].still:
        return [(tuple(map(id, run)), run)]
    return [(key, tuple(groups)) for key, groups in groupby(run, key=attrgetter("key"))]


def _shapes(groups: Sequence[Group]) -> Shapes:
    """Return the shapes of groups, cut off where the rectangle `within` of these groups ends."""
    edge = next((group.within for group in groups if group.within), None)
    kept, free = ([group for group in groups if bool(group.within) is bounded] for bounded in (True, False))
    return Shapes(flat(kept), (int(edge.right), int(edge.bottom)) if edge else None, flat(free))


def _cover(surface: pygame.Surface, groups: Sequence[Group]) -> Cover:
    """Return what the shapes of groups do to a surface."""
    return covers(surface, [_shapes(groups)])[0]


def printed(surface: pygame.Surface, groups: Iterable[Group], type_: Type) -> None:
    """Print groups on a surface, once."""
    printer = SurfacePrinter()
    for run in _runs(groups):
        _cover(surface, run).put(surface)
        printer._words(surface, type_, run)
