"""The window itself: it holds what outlasts a frame, and lets everything pure do the work."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import pygame
from pygame.event import Event

from linkanim.errors import LinkanimError
from linkanim.player import display, files
from linkanim.player.actions import Action
from linkanim.player.easel import Easel
from linkanim.player.keyboard import Keyboard
from linkanim.player.keys import bind_of
from linkanim.player.mouse import Mouse
from linkanim.player.rendering import Rendering, render
from linkanim.player.show import overlay
from linkanim.player.state import State, advance
from linkanim.player.tape import Reel, Tape, Taping
from linkanim.scenes.write import save

_MOUSE = (pygame.MOUSEWHEEL, pygame.MOUSEBUTTONDOWN, pygame.MOUSEBUTTONUP, pygame.MOUSEMOTION)
_UNCOVERED = (pygame.WINDOWEXPOSED, pygame.WINDOWSIZECHANGED)
_TOLD_EVERY = 15
_BESIDE_A_TAPE = frozenset({"screenshot", "fullscreen", "quit", "back"})


class Window:
    """One open window: `state` is what it shows, and `easel` how.

    A tape plays in it until a key is pressed.
    """

    def __init__(self, state: State, tape: Tape | None = None) -> None:
        self.state = state
        self._reel = Reel(tape) if tape else None
        self._taping: Taping | None = None
        self._renderings: list[Rendering] = []
        self.easel = Easel(state)
        self._keyboard, self._mouse = Keyboard(), Mouse()
        self._told: list[str] = []
        self._windowed = display.frame()
        self._open = True

    def tick(self, frames: int = 1) -> bool:
        """Go so many frames on, paint and flip; False when the window is to be closed.

        What happened since the last tick comes at its first frame.
        """
        actions = self._actions(pygame.event.get())
        for frame in range(frames):
            self._advance(actions if frame == 0 else ())
        self.easel.show(self.state, overlay(self.state))
        return self._open

    def close(self) -> None:
        """Let go of what the window holds; recordings under way go on."""
        for rendering in self._renderings:
            rendering.close()

    def _advance(self, asked: tuple[Action, ...]) -> None:
        actions = (*self._reeled(asked), *asked, *self._news())
        self.state = advance(self.state, actions)
        if self._taping:
            self._taping.note(self.state.frame, actions)
        if asked:
            for effect in self.state.effects:
                self._carry_out(effect)

    def _reeled(self, asked: tuple[Action, ...]) -> tuple[Action, ...]:
        """Return what the tape does at the next frame; a key that changes something ends it."""
        if self._reel is None:
            return ()
        if any(action.name not in _BESIDE_A_TAPE for action in asked):
            self._reel = None
            return (Action("note", "the tape is left: the keys are yours"),)
        self.state, actions = self._reel.next(self.state)
        return actions

    def _news(self) -> tuple[Action, ...]:
        """Return, as notes, what was done outside, and how far recordings are."""
        told, self._told = self._told, []
        if self._renderings and self.state.frame % _TOLD_EVERY == 0:
            told.append(" · ".join(rendering.words() for rendering in self._renderings))
            for rendering in [one for one in self._renderings if one.done]:
                self._renderings.remove(rendering)
                rendering.close()
        return tuple(Action("note", text) for text in told)

    def _carry_out(self, effect: Action) -> None:
        """Do what the state asks of the outside; what cannot be done is told, and the window runs on."""
        try:
            self._do(effect)
        except LinkanimError as error:
            self._told.append(str(error))

    def _do(self, effect: Action) -> None:
        match effect.name:
            case "record":
                self._taping = Taping(self.state, pygame.display.get_window_size())
            case "render":
                self._render(str(effect.value))
            case "screenshot":
                picture = self.easel.picture(self.state, overlay(self.state))
                self._told.append(str(files.screenshot(picture, self.state.scene.name)))
            case "save":
                self._told.append(f"{save(self.state.scene, Path())} is written")
            case "fullscreen":
                self._windowed = display.fill(self._windowed)
            case "quit":
                self._open = False
                if self.state.recording:
                    self._render(self.state.recording.format)

    def _render(self, form: str) -> None:
        taping, self._taping = self._taping, None
        if taping:
            self._renderings.append(render(taping.tape(self.state.frame), form))

    def _actions(self, events: Iterable[Event]) -> tuple[Action, ...]:
        """Return what the events ask for, each key as it is meant after those before it."""
        asked: list[Action] = []
        then = self.state
        for event in events:
            for action in self._asked(event, then):
                asked.append(action)
                then = advance(then, [action])
        return (*asked, *self._keyboard.repeated(self.state.frame))

    def _asked(self, event: Event, state: State) -> tuple[Action, ...]:
        if event.type == pygame.QUIT:
            return (Action("quit"),)
        if event.type in _UNCOVERED:
            self.easel.uncovered()
        if event.type in _MOUSE:
            return self._mouse.actions(event, self.easel)
        if event.type != pygame.KEYDOWN:
            return ()
        press = self._keyboard.press(event)
        editing = state.editing
        bind = bind_of(press, editing=editing.open, typing=editing.typed != "") if press else None
        self._keyboard.hold(event, bind, state.frame)
        return (bind.action,) if bind else ()
