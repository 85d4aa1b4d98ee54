"""Offer the commands of the key table to the mouse: the bar at the foot in each mode, and menus.

A command's name, its key and its action come from the table.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import cached_property, lru_cache
from typing import NamedTuple

from linkanim.frozen import frozen
from linkanim.picture.game_panel import GamePanel
from linkanim.player.action import Action
from linkanim.player.browsing import filtered
from linkanim.player.clock import FASTEST, SLOWEST
from linkanim.player.keys import (
    BACK_BAR,
    BESIDE_GAMES,
    GROUPS,
    HOME_BAR,
    LAST_BAR,
    MOVING_BAR,
    SPEED,
    BarEntry,
    ModeKeys,
    group_key,
)
from linkanim.player.state import BLANK, MOUSE_FRAMES, Game, State
from linkanim.scenes.editing import drives, handles
from linkanim.scenes.scene import Scene
from linkanim.words import LANGUAGES, name_said, said, spoken, to_say

_FADING = 24
"""The frames over which the bar fades out."""


_NONE_YET, _NO_CHANGE = to_say("there is no linkage to keep yet"), to_say("there is nothing to undo")
_SCENE = (
    BarEntry("shelf", Action("shelf"), 1),
    *MOVING_BAR,
    BarEntry("trace", Action("trace"), 11, leads=True),
    BarEntry("names", Action("names"), 10),
    BarEntry("arrows", Action("menu", "arrows"), 9),
    BarEntry("chart", Action("list"), 4),
    BarEntry("construction", Action("menu", "construction"), 14),
    BarEntry("closure", Action("closure"), 16),
    BarEntry("edit", Action("edit"), 3, leads=True),
    BarEntry("build", Action("build"), 12),
    BarEntry("pencil", Action("pencil"), 13),
    BarEntry("record", Action("record_dialog"), 6, leads=True),
    *LAST_BAR,
    BarEntry("chart", Action("chart", 1), 2, on_chart=True),
    BarEntry("axis", Action("over"), 3, on_chart=True),
    BarEntry("add", Action("list", "below"), 4, on_chart=True),
    BarEntry("close", Action("plot", ""), 1, on_chart=True),
)
LISTED_BAR = (BACK_BAR, *_SCENE)
"""In a list the way back stands where the way home stands without: the other buttons stay where they are."""
_CONSTRUCTED = {
    "edit": BarEntry("before", Action("construct", -1), 3, leads=True),
    "build": BarEntry("after", Action("construct", 1), 1),
    "pencil": BarEntry("done", Action("back"), 2),
}
"""What stands in the place of other buttons while a construction is drawn."""
_IN_A_LESSON = {
    "edit": BarEntry("before", Action("lesson_on", -1), 3, leads=True),
    "build": BarEntry("after", Action("lesson_on", 1), 1),
}
"""What stands in the place of other buttons in a lesson."""
BUILD_ON_BAR = BarEntry("build", Action("build_on"), 12)
"""Beside the list of dimensions, the tools work on the linkage that is shown."""
_BARE = (HOME_BAR._replace(rank=0), *_SCENE)


class Button(NamedTuple):
    """A command on the bar: its icon, its English name and key, whether it is on, why it cannot be done.

    Where room is short, buttons of the highest `rank` are left out first. A button that `leads` begins a
    group. With a `share` (0 to 1) it is a slider, three times as wide. With `on_chart` it stands at the
    chart's head.
    """

    icon: str
    name: str
    key: str = ""
    rank: int = 0
    leads: bool = False
    on: bool = False
    lack: str = ""
    share: float | None = None
    on_chart: bool = False


def bar(state: State) -> tuple[Button, ...]:
    """Return the commands on the bar while it shows: for three seconds after the mouse or a finger moved."""
    if not bar_eighths(state):
        return ()
    named = _names(state.keys)
    return tuple(_button(state, handle, named[handle.action]) for handle in _entries(state))


def bar_eighths(state: State) -> int:
    """Return the opacity of the bar in eighths; 0 where it is not seen."""
    if state.last_mouse_move is None:
        return 0
    remaining = state.last_mouse_move + MOUSE_FRAMES - state.frame
    return max(min(8 * remaining // _FADING, 8), 0)


def pressed(state: State, number: int) -> tuple[Action, ...]:
    """Return the actions of a button; where its command cannot be done, a note that says why."""
    handle = _entries(state)[number]
    reason = lack(state, handle.action)
    return (Action("note", reason),) if reason else (_meant(state, handle.action),)


def _entries(state: State) -> tuple[BarEntry, ...]:
    """Return the commands on the bar."""
    if state.lesson and state.mode in ("play", "paused"):
        return tuple(_IN_A_LESSON.get(one.icon, one) for one in LISTED_BAR)
    if state.constructed and state.mode in ("play", "paused"):
        return tuple(_CONSTRUCTED.get(one.icon, one) for one in LISTED_BAR)
    return state.top.bar if state.top else _BARE


def slid(state: State, number: int, share: float) -> tuple[Action, ...]:
    """Return the action that puts a slider's knob at a share, 0 to 1; where it is fixed, a note on why."""
    reason = lack(state, _entries(state)[number].action)
    if reason:
        return (Action("note", reason),)
    return (Action("level", round(SLOWEST + share * (FASTEST - SLOWEST))),)


def slides(state: State, number: int) -> bool:
    """Tell whether a button is a slider; False for a number that this mode's bar does not have."""
    return any(one.action == SPEED for one in _entries(state)[number : number + 1])


def _button(state: State, handle: BarEntry, named: tuple[str, str]) -> Button:
    action, (name, key) = handle.action, named
    share = (state.clock.level - SLOWEST) / (FASTEST - SLOWEST) if action == SPEED else None
    icon = _ICONS[handle.icon](state) if handle.icon in _ICONS else handle.icon
    on = action in _ON and _ON[action](state)
    reason = lack(state, action)
    return Button(icon, name, key, handle.rank, handle.leads, on, reason, share, handle.on_chart)


@lru_cache(maxsize=32)
def _names(mode: ModeKeys) -> Mapping[Action, tuple[str, str]]:
    """Return the names and keys of a mode's commands; for a group of them, its name and their keys."""
    groups = {Action("menu", name): (title.lower(), group_key(name)) for name, (title, _) in GROUPS.items()}
    named = {action: (words, key) for words, key, action in mode.commands}
    speed = {SPEED: ("speed", "↑ ↓" if named[SPEED][1] else "")} if SPEED in named else {}
    return {**named, **groups, **speed}


def _meant(state: State, action: Action) -> Action:
    """Return the action of a button in this state: the button that began a recording stops it."""
    if action == Action("record_dialog") and state.recording:
        return Action("record", state.recording.format)
    return action


def lack(state: State, action: Action) -> str:
    """Say why a command cannot be done in the state as it is; empty where it can."""
    return said(_LACKS[action](state)) if action in _LACKS else ""


# Menus: all commands, or those of the thing under the hand.


class ListRow(NamedTuple):
    """A row of a list: its words, the key that does the same, its action; texts by which it is found.

    Without these it is found by its words and its key. A command is found by its English name, too.
    """

    words: str
    key: str
    action: Action
    texts: tuple[str, ...] = ()


@frozen
class Entries:
    """Rows under a title, and the letters that filter them; a folder may give a hundred thousand rows."""

    title: str
    entries: tuple[ListRow, ...]
    typed: str = ""

    @cached_property
    def matches(self) -> tuple[ListRow, ...]:
        """The rows that have all the typed words."""
        return filtered({one: one.texts or (one.words, one.key) for one in self.entries}, self.typed)

    @cached_property
    def rows(self) -> tuple[tuple[str, str], ...]:
        """The matching rows as a list shows them: their words and keys."""
        return tuple((one.words, one.key) for one in self.matches)


def menu_of(state: State, what: str | None) -> Entries | None:
    """Return a list of commands; None where `what` does not exist, or has no commands.

    Without `what` the list has all commands of the present mode. Else `what` is the name of a group; "chart";
    "chosen", the chosen thing of a sheet; "joint", "link" or "strut" with a name; "things", all that have
    commands; or "keys" with the keys of a line of the help.
    """
    usual = {
        action: ListRow(said(words), key, action, (said(words), key, words))
        for words, key, action in state.keys.commands
    }
    if what is None or what in GROUPS:
        return _of_mode(state, usual, what)
    if what == "things":
        rows = tuple(ListRow(thing_said(one), "", Action("menu", one)) for one in things(state.scene))
        return Entries(to_say("Joints and links"), rows)
    if what.startswith("keys "):
        keys = what.removeprefix("keys ")
        return Entries(keys, tuple(usual[one] for one in state.keys.row_actions(keys) if one in usual))
    if what in _CHOSEN:
        return Entries(what.capitalize(), tuple(usual[one] for one in _CHOSEN[what] if one in usual))
    kind, _, name = what.partition(" ")
    rows = tuple(_of_thing(state, kind, name)) if what in things(state.scene) else ()
    title = thing_said(what)
    return Entries(title[:1].upper() + title[1:], (*rows, usual[Action("names")])) if rows else None


def line_asks(mode: ModeKeys, keys: str) -> Action | None:
    """Return the action of a line of the help, or the one that lists several; None where it has none.

    The line is found by its keys as they are written.
    """
    actions = mode.row_actions(keys)
    return Action("menu", f"keys {keys}") if len(actions) > 1 else next(iter(actions), None)


def _of_mode(state: State, usual: Mapping[Action, ListRow], group: str | None) -> Entries:
    listed = [row for action, row in usual.items() if action.name != "menu"] + [*_constructions(state)]
    if state.game:
        listed = [
            *_of_game(state, state.game, usual),
            *(row for row in listed if row.action.name in BESIDE_GAMES),
        ]
    if group is None:
        return Entries(to_say("Commands"), (*listed, *_languages(state)))
    title, members = GROUPS[group]
    rows = (row for row in listed if row.action in members)
    named = _constructions(state) if group == "construction" else ()
    return Entries(title, (*sorted(rows, key=lambda row: members.index(row.action)), *named))


def _of_game(state: State, game: Game, usual: Mapping[Action, ListRow]) -> Iterator[ListRow]:
    """Yield what can be done in a game now: its answers or doors by their words, then other keys of use."""
    panel = game.panel(state)
    choices = panel.choices if isinstance(panel, GamePanel) else ()
    for n, choice in enumerate(choices):
        yield ListRow(choice.text or said("answer {number}", number=n + 1), choice.key, Action("option", n))
    for n, spot in enumerate(game.spots(state)):
        yield ListRow(said("the place {key} on the picture", key=spot.key), spot.key, Action("option", n))
    for action in (*dict.fromkeys(bind.action for bind in state.keys.binds), Action("back")):
        if action.name != "option" and game.carried(state, action) is not state:
            kind = game.words.partition(" ")[0]
            own = _IN_ONE_GAME.get((kind, action))
            yield usual[action]._replace(words=said(own)) if own else usual[action]


_IN_ONE_GAME: Mapping[tuple[str, Action], str] = {
    ("menu", Action("turn", -1)): to_say("a level down"),
    ("menu", Action("turn", 1)): to_say("a level up"),
}
"""Other names of commands in particular games."""


def _constructions(state: State) -> Iterator[ListRow]:
    """Yield the constructions that the scene has, each by its name."""
    if state.mode in ("play", "paused", "edit"):
        from linkanim.picture.constructed import NAMES, kinds_of

        for number, kind in enumerate(kinds_of(state.scene)):
            yield ListRow(said(NAMES[kind]), "" if number else "F7", Action("construction", kind))


def _languages(state: State) -> Iterator[ListRow]:
    """Yield the languages in which words are not now, each by its own name; a game that runs has its own."""
    runs = state.game is not None and state.game.words.partition(" ")[0] not in ("title", "menu")
    for language, name in LANGUAGES.items():
        if language != spoken() and not runs:
            yield ListRow(name, "", Action("language", language), (name, language, "language"))


_CHOSEN: Mapping[str, tuple[Action, ...]] = {
    "chart": (
        *(Action("over"), Action("unit"), Action("chart", 1), Action("list"), Action("list", "below")),
        *(Action("plot", ""), Action("screenshot")),
    ),
    "chosen": (
        *(Action("trace_on"), Action("drive_by"), Action("remove"), Action("number", 1)),
        *(Action("undo_sheet"), Action("redo_sheet")),
    ),
}
"""The commands of the thing under the hand that stand in the table."""


def thing_said(thing: str) -> str:
    """Return what one of the `things` is called."""
    kind, _, name = thing.partition(" ")
    return {
        "joint": lambda: said("joint {name}", name=name),
        "link": lambda: said("link {name}", name=name_said(name)),
        "strut": lambda: said("strut {name}", name=name_said(name)),
    }[kind]()


def things(scene: Scene) -> tuple[str, ...]:
    """Return the things that have commands of their own: joints, links and struts, by kind and name."""
    linkage = scene.linkage
    joints = (f"joint {joint.name}" for joint in linkage.joints)
    links = (f"link {body.name}" for body in linkage.bodies if body.name)
    springs = (f"strut {spring.name}" for spring in linkage.springs)
    return (*joints, *links, *springs, *(f"strut {damper.name}" for damper in linkage.dampers))


_CHARTED: Mapping[str, tuple[tuple[str, str], ...]] = {
    "joint": (("velocity", to_say("chart its speed")), ("acceleration", to_say("chart its acceleration"))),
    "link": (
        *(("angle", to_say("chart its angle")), ("angular_velocity", to_say("chart its angular velocity"))),
        *(("travel", to_say("chart its travel")), ("travel_velocity", to_say("chart its velocity"))),
    ),
    "strut": (("length", to_say("chart its length")), ("force", to_say("chart its force"))),
}
"""What can be charted of a thing: the end of the quantity's token, and the words."""


def _of_thing(state: State, kind: str, name: str) -> Iterator[ListRow]:
    """Yield the commands of a joint, a link, or a spring or damper."""
    scene = state.scene
    for end, words in _CHARTED[kind]:
        if f"{name}.{end}" in scene.quantities:
            yield ListRow(said(words), "", Action("plot", f"{name}.{end}"))
    bodies = {body.name: body.joints for body in scene.linkage.bodies}
    joints = (name,) if kind == "joint" else bodies.get(name, ()) if kind == "link" else ()
    if kind == "joint":
        words = said("stop tracing it") if name in scene.trace else said("trace it")
        yield ListRow(words, "", Action("trace_joint", name))
        if name in drives(scene):
            yield ListRow(said("make it the drive"), "", Action("drive_joint", name))
    sized = next((joint for joint in reversed(joints) if handles(scene, joint)), None)
    if sized:
        placed = scene.linkage.joint(sized).bars == ()
        words = said("edit its place") if placed else said("edit its length")
        yield ListRow(words, "", Action("edit_at", sized))
    if kind == "link":
        yield from _constructions(state)


def _shows(title: str) -> Callable[[State], bool]:
    """Return the function that tells whether the list of a group of commands is open."""
    return lambda state: state.top is not None and state.top.title == title


_ICONS: Mapping[str, Callable[[State], str]] = {
    "pause": lambda state: "play" if state.clock.paused else "pause",
    "record": lambda state: "stop" if state.recording else "record",
}
_ON: Mapping[Action, Callable[[State], bool]] = {
    Action("trace"): lambda state: state.look.trace and bool(state.scene.trace),
    Action("names"): lambda state: state.look.names > 0,
    Action("menu", "arrows"): lambda state: bool(state.look.vectors) or _shows(GROUPS["arrows"][0])(state),
    Action("list"): lambda state: state.look.chart is not None,
    Action("menu", "construction"): lambda state: (
        state.look.polygons_shown > 0 or state.look.centres > 0 or state.constructed > 0
    ),
    Action("record_dialog"): lambda state: state.recording is not None,
    Action("menu"): _shows("Commands"),
    **dict.fromkeys((Action("edit"), Action("numbers")), lambda state: state.edits_dimensions),
    Action("help"): lambda state: state.help,
    Action("theory"): lambda state: state.posing is not None and state.posing.curves,
}
"""Whether a command is on, for commands that show it."""


def _nothing_drawn(state: State) -> str:
    sheet = state.building
    return "" if sheet and sheet.building.draft.places else BLANK


def _nothing_moves(state: State) -> str:
    sheet = state.building
    return sheet.building.made.missing if sheet else ""


_LACKS: Mapping[Action, Callable[[State], str]] = {
    Action("play", "title door=play"): lambda state: (
        "" if state.games else to_say("there are no games in this window; the program's own has them")
    ),
    Action("trace"): lambda state: (
        "" if state.scene.trace else to_say("no joint of this mechanism is traced")
    ),
    Action("keep"): lambda state: "" if state.sketch and not state.sketch.is_blank else _NONE_YET,
    Action("undo_sketch"): lambda state: "" if state.sketch and state.sketch.earlier else _NO_CHANGE,
    Action("undo_sheet"): lambda state: "" if state.building and state.building.building.past else _NO_CHANGE,
    Action("redo_sheet"): lambda state: (
        "" if state.building and state.building.building.future else to_say("there is nothing to redo")
    ),
    Action("numbers"): _nothing_drawn,
    Action("pause"): _nothing_moves,
    Action("step", -1): _nothing_moves,
    Action("step", 1): _nothing_moves,
    SPEED: _nothing_moves,
}
"""Why a command cannot be done, for commands that may be impossible."""
