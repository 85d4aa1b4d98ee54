"""The window: events to actions, `advance`, paint, flip; and what is asked of the outside.

`frames` owns the time, and says how many frames have gone by; `Window.tick` does them. A frame that
comes late is skipped, never slowed down: the frame's number follows the clock.
"""

from __future__ import annotations

import gc
import os
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

from linkanim.picture.look import Look
from linkanim.player.state.action import Action
from linkanim.player.state.advance import carried
from linkanim.player.state.clock import FRAMES_PER_SECOND
from linkanim.player.state.state import begin
from linkanim.player.tape.tape import Tape
from linkanim.player.window import display
from linkanim.player.window.drafts import DraftFile
from linkanim.player.window.files import SceneFile, beside
from linkanim.player.window.keeper import GameKeeper
from linkanim.player.window.window import Window
from linkanim.scenes.files import path_of
from linkanim.scenes.scene import Scene

_STALLED = FRAMES_PER_SECOND


def run(
    scene: Scene | str | os.PathLike[str] | None = None,
    *,
    look: Look | None = None,
    attract: bool = False,
    size: tuple[int, int] | None = None,
    keeper: GameKeeper | None = None,
    drafts: Path | None = None,
    sheet: bool = False,
    game: str | None = None,
    photo: Path | None = None,
) -> int:
    """Open the window on a scene, a scene file or a tape, and return 0 when it is closed.

    Without a scene it opens on the title, where a `keeper` has games; left alone for a minute it walks on
    through the catalogue. With `attract` it fills the screen, Esc does not leave that, and left alone it goes
    back to the title. NoDisplay where there is no screen, or none any more; BadInput as loading raises it.
    Whatever ends the window, a recording that runs is finished. `drafts` is the file in which a draft is
    kept; with `sheet` the window opens on an empty one, on a `photo` if there is one. `game` are the words of
    one to begin with.
    """
    tape = _tape(scene, keeper)
    state = tape.begun if tape else begin(scene, look=look)
    state = replace(state, games=keeper.game_of if keeper else None)
    opening = game or ("title" if scene is None else None)
    if opening and keeper:
        words = keeper.completed(opening)
        keeper.game_of(words)  # which says what is wrong with them before a window opens
        state = carried(state, Action("play", words))
    with display.opened(size) as connection:
        state = replace(state, attract=attract or scene is None, kiosk=attract)
        kept = DraftFile(drafts) if drafts and not tape else None
        window = Window(state, tape, None if tape else _file(scene), keeper, kept)
        if sheet:
            window.state = carried(window.state, Action("sheet"))
        if photo:
            window.state = carried(window.state, Action("photo", beside(str(photo))))
        if attract:
            window.fill()
        gc.freeze()  # what is there by now stays: not to be searched for rubbish in the midst of a frame
        try:
            for count in frames(time.monotonic, time.sleep):
                if not window.tick(count):
                    break
                connection.check()
        finally:
            window.close()
            gc.unfreeze()
    return 0


def frames(now: Callable[[], float], wait: Callable[[float], object]) -> Iterator[int]:
    """Yield how many frames are due since the last time, at 60 a second; wait where none is.

    After a stall of more than a second (a window being moved, a laptop that slept) the time in
    between is left out, and so is what a clock is set back by.
    """
    start, shown = now() - 1 / FRAMES_PER_SECOND, 1
    yield 1
    while True:
        early = start + (shown + 1) / FRAMES_PER_SECOND - now()
        if early > 2 / FRAMES_PER_SECOND:
            start, early = start - early + 1 / FRAMES_PER_SECOND, 1 / FRAMES_PER_SECOND
        wait(max(0.0, early))
        due = max(int((now() - start) * FRAMES_PER_SECOND), shown + 1)
        if due - shown > _STALLED:
            start += (due - shown - 1) / FRAMES_PER_SECOND
            due = shown + 1
        yield due - shown
        shown = due


def _file(scene: object) -> SceneFile | None:
    path = path_of(scene) if isinstance(scene, str | os.PathLike) else None
    return SceneFile(path) if path else None


def _tape(scene: object, keeper: GameKeeper | None) -> Tape | None:
    path = str(scene) if isinstance(scene, str | os.PathLike) else ""
    if not path.lower().endswith(".json"):
        return None
    from linkanim.player.tape import tape_file

    return tape_file.read(Path(path), keeper.game_of if keeper else None)
