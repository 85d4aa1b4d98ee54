"""What a notebook shows: for a scene a moving page and its facts, for a motion its table and a chart."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterator, Mapping
from html import escape
from typing import Any

import numpy as np

from linkanim.errors import BadInput
from linkanim.mechanics.analysis import link_names, turning_bodies
from linkanim.mechanics.measures import output_body
from linkanim.mechanics.motion import Motion, mechanism
from linkanim.mechanics.quantities import Quantity, register
from linkanim.paper.figure import Figured
from linkanim.paper.html import symbol
from linkanim.paper.svg import svg
from linkanim.picture.chart import Plot, axes, curve_layer, pen_for, plot_area, x_title
from linkanim.picture.items import Caption, Item
from linkanim.picture.layout import layout
from linkanim.picture.look import Look
from linkanim.picture.quantities import around
from linkanim.picture.text import letters
from linkanim.picture.theme import LIGHT
from linkanim.picture.view import Rect
from linkanim.scenes.scene import Scene
from linkanim.share.page import Shared, document
from linkanim.units import significant, typeset
from linkanim.words import said

_FIGURE, _CHART, _FRAME = (560, 360), (640, 260), (720, 560)
_ENDS = 5
"""The rows of a motion's table that are shown at either end; those between are left out."""
_DIGITS = 6


def scene_html(scene: Scene) -> str:
    """Return the page on which a scene moves, and its facts, as HTML.

    A notebook that is not trusted leaves frames out, and shows the figure behind the page.
    """
    svg = b64encode(Figured(scene, _FIGURE, Look(names=1, hud=False)).document().encode()).decode()
    size, source = f"width='{_FIGURE[0]}' height='{_FIGURE[1]}'", f"data:image/svg+xml;base64,{svg}"
    figure = f"<img alt='{escape(said(scene.title))}' {size} src='{source}'/>"
    return _side_by_side(f"<div>{_moving(scene)}{figure}</div>", scene._repr_html_())


def _moving(scene: Scene) -> str:
    """Return the page in a frame, which hides the figure behind it; nothing where there is no such page."""
    try:
        page = document(Shared(scene, names=1))
    except BadInput:
        return ""
    style = f"width:{_FRAME[0]}px;height:{_FRAME[1]}px;max-width:100%;border:0"
    frame = f"class='linkanim' title='{escape(said(scene.title))}' sandbox='allow-scripts' style='{style}'"
    hidden = "<style>iframe.linkanim + img { display: none; }</style>"
    return f"{hidden}<iframe {frame} srcdoc='{escape(page)}'></iframe>"


def motion_html(motion: Motion) -> str:
    """Return a motion's table as HTML, and for several instants in a row the chart of its output."""
    table = _table(motion)
    if np.ndim(motion.phase) != 1 or len(motion.phase) < 2:
        return table
    return _side_by_side(_chart(motion, _telling(motion)), table)


def _side_by_side(picture: str, table: str) -> str:
    return f"<div style='display:flex;flex-wrap:wrap;gap:1em;align-items:start'>{picture}{table}</div>"


def _unit(motion: Motion) -> str:
    """Return the unit of length of a motion."""
    return motion.mechanism.linkage.unit


def _quantities(motion: Motion) -> Mapping[str, Quantity]:
    """Return all quantities by their tokens; bodies have the names of their functions (crank, rocker)."""
    solved = mechanism(motion.mechanism.linkage)
    return register(solved.linkage, link_names(solved, lambda: turning_bodies(solved)))


def _tabulated(motion: Motion) -> Iterator[Quantity]:
    """Yield the quantities of the table: positions of moving joints, angles or travels of bodies."""
    linkage, known = motion.mechanism.linkage, _quantities(motion)
    for joint in linkage.joints:
        if not joint.fixed:
            yield from (known[f"{joint.name}.position.{axis}"] for axis in "xy")
    for body in linkage.bodies:
        yield known[f"{body.name}.{'travel' if body.slider else 'angle'}"]


def _table(motion: Motion) -> str:
    """Return a table of the input, the phase, joints and bodies, with a row for each instant."""
    unit, coordinate, shown = (
        _unit(motion),
        motion.mechanism.linkage.drive.coordinate,
        list(_tabulated(motion)),
    )
    name = said("input {coordinate}", coordinate=said(coordinate.name))
    titles = [f"{name} ({coordinate.display_unit(unit)})", said("phase (°)")]
    titles += [one.headed(unit) for one in shown]
    inputs = coordinate.displayed(motion.coordinate), np.degrees(motion.phase)
    columns = (np.ravel(column) for column in (*inputs, *(one.displayed(motion) for one in shown)))
    rows = np.stack(list(columns), axis=1)
    head = "".join(f"<th>{symbol(title)}</th>" for title in titles)
    cut = range(_ENDS, len(rows) - _ENDS)
    body = [_row(row) for n, row in enumerate(rows) if n not in cut]
    if cut:
        more = said("… {count} more rows …", count=f"{len(cut):,}")
        body.insert(_ENDS, f"<tr><td colspan='{len(titles)}'>{more}</td></tr>")
    return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(body)}</tbody></table>"


def _row(values: Any) -> str:
    cells = (escape(typeset(significant(float(value), _DIGITS))) for value in values)
    return f"<tr>{''.join(f'<td>{cell}</td>' for cell in cells)}</tr>"


def _telling(motion: Motion) -> Quantity:
    """Return the charted quantity: the output's velocity, or its position in a motion without rates."""
    linkage, known = motion.mechanism.linkage, _quantities(motion)
    output = output_body(linkage)
    if output is None:
        return known[linkage.drive.coordinate.rate_token]
    where, rate = ("travel", "travel_velocity") if output.slider else ("angle", "angular_velocity")
    return known[f"{output.name}.{rate if motion.velocity else where}"]


def _chart(motion: Motion, quantity: Quantity) -> str:
    """Return a chart of a quantity over the input's angle, or over the phase where the input swings."""
    coordinate, steps = motion.mechanism.linkage.drive.coordinate, np.diff(motion.coordinate)
    turns = coordinate.is_angle and bool((steps > 0).all() or (steps < 0).all())
    x = np.degrees(motion.coordinate if turns else motion.phase)
    values = np.asarray(quantity.displayed(motion), float)
    type_, parts = letters(), layout(_CHART)
    pen = pen_for(parts, type_, LIGHT)
    y_axis = around(values, most=4)
    area = plot_area(Rect(0, 0, *_CHART), y_axis, pen, foot=True)
    plot = Plot(area, around(x, most=6, unit="°", room=0.0), y_axis)
    title, over = quantity.title(_unit(motion)), said("input angle (°)") if turns else said("phase φ (°)")
    items: list[Item] = [*axes(plot, pen), x_title(plot, over, pen)]
    items.append(Caption(title, (area.x, area.y - 1.35 * pen.text), pen.text, LIGHT.ink))
    items.append(curve_layer(plot, x, values, LIGHT.velocity, 1.3 * pen.line))
    return svg(_CHART, LIGHT.background, items, title=quantity.words)
