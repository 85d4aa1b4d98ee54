"""The picture: everything between a pose and the pixels of a surface.

From the ground up; a module imports from those before it only:

    raster        filling outlines with exact coverage
    shapes        outlines, and rigid parts that are turned and placed
    text          fonts and lines of text
    theme         colours
    view          the only conversion between the scene's lengths and pixels
    items         what pictures are made of: shapes and captions, in groups
    layout        the slots of a picture, and how large things are for its size
    purpose       sizes for a book's column, a page, a slide
    look          what is shown of a scene, and how users change it
    figure        what of a linkage is drawn
    drawn         what is drawn beside a scene: by what is open, and at the mouse
    fittings      sliders and guides, springs, dampers, the ground
    bodies        bars, plates, pins, centres of mass, the causal chain
    gears         wheels, teeth, belts
    placing       one of its places for each label, for a whole period
    motion_marks  traces, the input's arrow, velocity and acceleration arrows
    ink           traces thickened and coloured by speed
    dimensions    symbols of dimensions, and dimension lines
    quantities    quantities over one true period, and axes
    chart         charts, and the chart beside the scene
    construction  the construction of a synthesis
    anchors       places of labels as functions of the pose
    polygons      the velocity and the acceleration polygon
    centres       instant centres and centrodes
    constructed  which constructions a scene has, and their steps
    dead_centres  a slider's dead centres on its guide
    layered       parts in layers, from above or lifted off each other
    names         names and dimensions, each with its anchor
    drawing       a linkage drawn in one view, back to front
    hud           the words about a scene
    fit           how far what is drawn extends, and the view that fits it into a room
    composition   slots, view and names of a picture
    board         what every panel is drawn on
    lists         lists of dimensions, of quantities, of commands
    game_panel    what a game shows
    hover         the arrows of the joint under the mouse, lights at an instant
    slider        a small slider on the picture
    marks         the bar being edited, handles, a ram's lane
    photograph    a photograph behind a sheet
    sheet_rows    rows of words on the sheet
    build_sheet   the sheet: its grid, a draft, the pencil's path
    cognates      cognates of the pencil's linkage
    poses         poses of a body, pins, Burmester's curves
    picture       the one description of a picture, for every printer
    stills        the pose of a still
    frame_words   what a frame of a recording says, and where
    surface       the printer for surfaces
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from linkanim.picture.frame_words import labelled

__all__ = ["labelled"]


def __getattr__(name: str) -> object:
    """Import `labelled` when it is asked for: parts of the picture are used without a picture."""
    if name == "labelled":
        from linkanim.picture.frame_words import labelled

        return labelled
    raise AttributeError(name)
