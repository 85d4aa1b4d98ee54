"""Actions on the look: what is shown beside the linkage, in which theme, and how near."""

from __future__ import annotations

from dataclasses import replace

from linkanim.errors import LinkanimError
from linkanim.picture.diagrams.quantities import telling
from linkanim.player.state.state import State, told
from linkanim.player.window.framing import panned, zoomed
from linkanim.scenes.reading.closure import other_closure


def chart(state: State, further: int) -> State:
    """Show the telling quantity so many further; none follows the last, and any that is not telling."""
    charts = (None, *telling(state.scene))
    if state.look.chart not in charts:
        return replace(state, look=replace(state.look, chart=None))
    at = charts.index(state.look.chart)
    return replace(state, look=replace(state.look, chart=charts[(at + further) % len(charts)]))


def trace(state: State, _: None) -> State:
    """Show or hide the trace."""
    return replace(state, look=replace(state.look, trace=not state.look.trace))


def names(state: State, _: None) -> State:
    """Show the names of joints and links, then their dimensions, then neither."""
    return replace(state, look=replace(state.look, names=(state.look.names + 1) % 3))


def polygons(state: State, _: None) -> State:
    """Show or hide the velocity and the acceleration polygon."""
    return replace(state, look=replace(state.look, polygons=not state.look.polygons))


def centres(state: State, _: None) -> State:
    """Show the instant centres, then the coupler's centrodes too, then neither."""
    return replace(state, look=replace(state.look, centres=(state.look.centres + 1) % 3))


def vectors(state: State, kind: str) -> State:
    """Show or hide the velocities or accelerations."""
    return replace(state, look=replace(state.look, vectors=state.look.vectors ^ {kind}))


def ghost(state: State, _: None) -> State:
    """Show or hide the other closure, where there is one."""
    if not state.look.ghost:
        try:
            other_closure(state.scene)
        except LinkanimError as error:
            return told(state, str(error))
    return replace(state, look=replace(state.look, ghost=not state.look.ghost))


def theme(state: State, _: None) -> State:
    """Go from light to dark, or back."""
    other = replace(state.look, theme="light" if state.look.theme == "dark" else "dark")
    return replace(state, look=other, faded=state.frame)


def zoom(state: State, about: tuple[float, float, float]) -> State:
    """Go so many notches nearer to a point."""
    notches, x, y = about
    return replace(state, look=zoomed(state.look, notches, (x, y)))


def pan(state: State, by: tuple[float, float]) -> State:
    """Shift the picture."""
    return replace(state, look=panned(state.look, by))


def fit(state: State, _: None) -> State:
    """Let the linkage fill its room again."""
    return replace(state, look=replace(state.look, zoom=1.0, pan=(0.0, 0.0)))


def help_(state: State, _: None) -> State:
    """Open or close the help."""
    return replace(state, help=not state.help)
