"""Files to cut or print: parts on sheets as SVG and DXF, on pages in true size as PDF, as bodies in STL."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from importlib.util import find_spec
from typing import TYPE_CHECKING, NamedTuple
from xml.sax.saxutils import escape

import numpy as np

from linkanim.errors import BadInput
from linkanim.paper.pdf import pages
from linkanim.picture.items import Caption, Item
from linkanim.picture.raster import Layer
from linkanim.picture.shapes import cut, segments, stroke
from linkanim.picture.text import subscripted
from linkanim.words import said
from linkanim.workshop.made import MadeLinkage
from linkanim.workshop.nesting import FOOT, MARGIN, nested
from linkanim.workshop.parts import MadePin, Plate
from linkanim.workshop.shapes import Outline, arc, box, moved, polygon, rounded, sides, upright

if TYPE_CHECKING:
    from manifold3d import Manifold

_BETWEEN = 3.0
"""The distance between parts on a sheet, and from parts to its edge, in mm."""
_PIXELS = 96 / 25.4
"""Pixels in a millimetre."""
_INK, _PAPER = (20, 20, 20), (255, 255, 255)
_HAIR = 0.2
"""The width of a line on paper, in mm."""
_RULER = 100
_OVERLAP = 10.0
"""The overlap of the pages of one part, in mm."""
_MOST_PAGES = 100
_READABLE = 2.0
"""The least height of words on paper, in mm; words with less room stand above their part."""
_LETTER = 0.55
"""The usual width of a letter, in heights of the words."""
_LETTERED = 0.26
"""The height of a joint's letter beside its hole, in widths of a bar."""
_SUNK = 1 / 3
"""How deep a printed pin's head and its cap lie in the plates, as a share of their thickness."""


class FlatPart(NamedTuple):
    """A flat part as it is cut: the words on it and their place, its outer edge, and the edges of its holes.

    The words are at most `room` mm high. `letters` are the joints of its holes, each beside its hole.
    """

    label: str
    at: complex
    edge: Outline
    holes: tuple[Outline, ...]
    room: float = math.inf
    letters: tuple[tuple[str, complex], ...] = ()

    def words(self, size: float, letter: float) -> Iterator[tuple[str, complex, float]]:
        """Yield its label, at most `size` high, and its letters, `letter` high: text, place, height."""
        if self.label:
            yield self.label, self.at, min(size, self.room)
        for text, place in self.letters:
            yield text, place, letter


def _letters(made: MadeLinkage, plate: Plate, label: str) -> Iterator[tuple[str, complex]]:
    """Yield the joints of a plate's holes, each on the side of its hole that has most room, off the label."""
    size, wide = _LETTERED * made.sizes.bar, 0.5 * _LETTER * len(label) * _LETTERED * made.sizes.bar
    for at, _, radius, joint in (one for one in plate.holes + plate.slots if one.joint):
        away = plate.clearest - at
        turned = away / abs(away) if abs(away) > radius else 1 + 0j
        if radius < abs(away) < radius + 1.8 * size + wide:
            turned = -turned
        yield joint, at + turned * (radius + 0.8 * size)


def flat_parts(made: MadeLinkage) -> list[FlatPart]:
    """Return every plate, and the rings that keep layers apart, enlarged by half the width of the cut."""
    grown = made.kerf / 2
    parts = []
    for number, plate in enumerate(made.plates):
        # a slider's tongue has no room for its name
        label = made.numbers[number] if plate.role == "slider" else made.label(number)
        edges, letters = (plate.outline(grown), tuple(plate.cuts(grown))), tuple(_letters(made, plate, label))
        parts.append(FlatPart(label, plate.clearest, *edges, letters=letters))
    for pin in made.pins:
        for layer, diameter in pin.spacers:
            hole = rounded([0j], made.sizes.hole / 2 - grown)
            edge = rounded([0j], diameter / 2 + grown)
            label, outer, inner = f"{pin.name} {layer}", diameter / 2, made.sizes.hole / 2
            room = _room_in_ring(outer, inner, _LETTER * len(label))
            parts.append(FlatPart(label, -0.5j * (outer + inner), edge, (hole,), room))
    return parts


def _room_in_ring(outer: float, inner: float, wide: float) -> float:
    """Return how high words may be on a ring, below its hole, that are `wide` times as wide as high."""
    middle, rim = (outer + inner) / 2, 0.96 * outer
    # their lower corners lie on the rim: (wide h / 2)² + (middle + h / 2)² = rim²
    square = (wide**2 + 1) / 4
    within = (math.sqrt(middle**2 - 4 * square * (middle**2 - rim**2)) - middle) / (2 * square)
    return min(within, 0.8 * (outer - inner))


def _sheets(made: MadeLinkage) -> tuple[list[tuple[FlatPart, complex, complex]], int, float]:
    """Return all flat parts on sheets side by side: each with its place and its frame's direction.

    Also the number of sheets, and the step from one to the next. BadInput for a part that no sheet holds.
    """
    (wide, high), placed, last = made.sheet, [], 0
    parts, step = flat_parts(made), made.sheet[0] + 20.0
    laid = nested([part.edge for part in parts], (wide - 2 * _BETWEEN, high - 2 * _BETWEEN), _BETWEEN)
    for part, one in zip(parts, laid, strict=True):
        if one is None:
            long, broad = sides(part.edge)
            raise BadInput(
                f"{part.label} is {long:.0f} x {broad:.0f} mm, which a sheet of {wide:g} x {high:g} mm does "
                "not hold; take a larger one (--sheet), or make everything smaller (--fit A4)"
            )
        placed.append((part, one.at + complex(_BETWEEN + one.sheet * step, _BETWEEN), one.turn))
        last = max(last, one.sheet)
    return placed, last + 1, step


def svg(made: MadeLinkage) -> str:
    """Return all flat parts on sheets as SVG in mm: red lines are cut, blue words engraved.

    Sheets lie side by side, their edges grey. BadInput for a part that is larger than a sheet.
    """
    (placed, many, step), (wide, high) = _sheets(made), made.sheet
    width = step * (many - 1) + wide
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:g}mm" height="{high:g}mm" '
        f'viewBox="0 0 {width:g} {high:g}" fill="none" stroke-width="0.1">',
        f"<title>{escape(made.scene.title)}</title>",
    ]
    lines += [
        f'<rect x="{n * step:g}" y="0" width="{wide:g}" height="{high:g}" stroke="#999"/>'
        for n in range(many)
    ]
    for part, at, turn in placed:
        outlines = [moved(outline, at, turn) for outline in (part.edge, *part.holes)]
        lines.append(f'<path stroke="#f00" d="{"".join(_path(outline, high) for outline in outlines)}"/>')
        lean = -math.degrees(math.atan2(turn.imag, turn.real))
        for text, own, high_ in part.words(0.35 * made.sizes.bar, _LETTERED * made.sizes.bar):
            place = at + turn * own
            how = f'transform="translate({place.real:.3f} {high - place.imag:.3f}) rotate({lean:.3f})"'
            lines.append(
                f'<text {how} font-size="{high_:.2f}" text-anchor="middle" dominant-baseline="central" '
                f'font-family="sans-serif" fill="#00f">{escape(text)}</text>'
            )
    return "\n".join([*lines, "</svg>", ""])


def _path(outline: Outline, high: float) -> str:
    """Return an outline as path data, with arcs as arcs, y down."""
    start = outline[0][0]
    data = f"M{start.real:.6f} {high - start.imag:.6f}"
    for (begin, bulge), (end, _) in zip(outline, outline[1:] + outline[:1], strict=True):
        if bulge:
            _, radius, sweep = arc(begin, end, bulge)
            flags = f"0 {int(abs(sweep) > math.pi)} {int(sweep < 0)}"
            data += f"A{radius:.6f} {radius:.6f} {flags} {end.real:.6f} {high - end.imag:.6f}"
        else:
            data += f"L{end.real:.6f} {high - end.imag:.6f}"
    return data + "Z"


def require(library: str, what: str) -> None:
    """Raise BadInput where a library of the extra `make` is not installed; it says how to install it."""
    if find_spec(library) is None:
        raise BadInput(
            f'{what} needs {library}, which is not installed; install with: pip install "linkanim[make]"'
        )


def dxf(made: MadeLinkage) -> str:
    """Return the sheets as DXF in mm: edges are closed lines with arcs, round holes circles.

    Layers: CUT, ENGRAVE, and SHEET for the sheets' own edges. BadInput as `svg`. Needs ezdxf.
    """
    from io import StringIO

    from ezdxf import units
    from ezdxf.enums import TextEntityAlignment
    from ezdxf.filemanagement import new

    (placed, many, step), (wide, high) = _sheets(made), made.sheet
    drawing = new("R2010", units=units.MM)
    for name, colour in (("CUT", 1), ("ENGRAVE", 5), ("SHEET", 8)):
        drawing.layers.add(name, color=colour)
    space = drawing.modelspace()
    for n in range(many):
        left = n * step
        corners = [(left, 0), (left + wide, 0), (left + wide, high), (left, high)]
        space.add_lwpolyline(corners, close=True, dxfattribs={"layer": "SHEET"})
    for part, at, turn in placed:
        for outline in (part.edge, *part.holes):
            lying = moved(outline, at, turn)
            if len(lying) == 2 and lying[0][1] == lying[1][1] == 1.0:
                middle = (lying[0][0] + lying[1][0]) / 2
                radius = abs(lying[0][0] - lying[1][0]) / 2
                space.add_circle((middle.real, middle.imag), radius, dxfattribs={"layer": "CUT"})
            else:
                points = [(corner.real, corner.imag, bulge) for corner, bulge in lying]
                space.add_lwpolyline(points, format="xyb", close=True, dxfattribs={"layer": "CUT"})
        lean = math.degrees(math.atan2(turn.imag, turn.real))
        for text_shown, own, size in part.words(0.3 * made.sizes.bar, _LETTERED * made.sizes.bar):
            place = at + turn * own
            text = space.add_text(text_shown, height=size, rotation=lean, dxfattribs={"layer": "ENGRAVE"})
            text.set_placement((place.real, place.imag), align=TextEntityAlignment.MIDDLE_CENTER)
    written = StringIO()
    drawing.write(written)
    return written.getvalue()


def paper(made: MadeLinkage) -> bytes:
    """Return pages with all flat parts in true size as PDF, each with a ruler of 100 mm. Needs fpdf2.

    A part longer than a page goes over several, which overlap and have crosses to lay over each other.
    BadInput for more than a hundred pages.
    """
    parts, (wide, high) = flat_parts(made), made.sheet
    room = wide - 2 * MARGIN, high - 2 * MARGIN - FOOT
    laid = nested([part.edge for part in parts], room, _BETWEEN)
    tiled = [_Tiles.of(part, room) for part, one in zip(parts, laid, strict=True) if one is None]
    count = max((one.sheet + 1 for one in laid if one), default=0)
    total = count + sum(tiles.across * tiles.up for tiles in tiled)
    if total > _MOST_PAGES:
        raise BadInput(
            f"{made.scene.name} takes {total} pages of {wide:g} x {high:g} mm; make it smaller (--fit A4), "
            "or take larger paper (--sheet 841x1189)"
        )
    drawn: list[list[Item]] = [[] for _ in range(count)]
    for part, one in zip(parts, laid, strict=True):
        if one:
            drawn[one.sheet] += _drawn(made, part, one.at, one.turn)
    for tiles in tiled:
        drawn += tiles.pages(made)
    framed = (
        [*items, *_frame(made, said("page {number} of {count}", number=n, count=len(drawn)))]
        for n, items in enumerate(drawn, start=1)
    )
    return pages(
        (wide * _PIXELS, high * _PIXELS),
        None,
        framed,
        title=said("{title}: parts", title=said(made.scene.title)),
    )


class _Tiles(NamedTuple):
    """A part over several pages, `across` of them side by side and `up` one above another."""

    part: FlatPart
    room: tuple[float, float]
    turn: complex
    corner: complex
    across: int
    up: int

    @classmethod
    def of(cls, part: FlatPart, room: tuple[float, float]) -> _Tiles:
        """Return a part turned so that it takes the fewest pages."""
        points = polygon(part.edge)

        def tiles(turn: complex) -> _Tiles:
            left, right, low, high = box(turn * point for point in points)
            across, up = (
                max(math.ceil((size - _OVERLAP) / (most - _OVERLAP)), 1)
                for size, most in zip((right - left, high - low), room, strict=True)
            )
            return cls(part, room, turn, complex(left, low), across, up)

        long = upright(points)
        return min(tiles(long), tiles(1j * long), key=lambda one: one.across * one.up)

    def pages(self, made: MadeLinkage) -> Iterator[list[Item]]:
        """Yield the content of each page on which some of the part lies."""
        step = self.room[0] - _OVERLAP, self.room[1] - _OVERLAP
        points = np.array([self.turn * point for point in polygon(self.part.edge)])
        for row in range(self.up):
            for column in range(self.across):
                corner = self.corner + complex(column * step[0], row * step[1])
                seen = -cut(-cut(cut(points - corner, self.room[0]), self.room[1], down=True), 0.0)
                if len(seen) < 3 or len(-cut(-seen, 0.0, down=True)) < 3:
                    continue
                items = list(_drawn(made, self.part, -corner, self.turn))
                items += self._crosses(made, column, row)
                words = said(
                    "{part}: {column} of {columns} from the left, {row} of {rows} from the foot; lay its "
                    "crosses over those of its neighbours",
                    part=self.part.label,
                    column=column + 1,
                    columns=self.across,
                    row=row + 1,
                    rows=self.up,
                )
                items.append(_words(made, words, complex(0, self.room[1] + 2)))
                yield items

    def _crosses(self, made: MadeLinkage, column: int, row: int) -> Iterator[Item]:
        """Yield the crosses of a page: in the middle of each overlap with a neighbour, near both ends."""
        half, (wide, high) = _OVERLAP / 2, self.room
        xs = [half] * (column > 0) + [wide - half] * (column + 1 < self.across)
        ys = [half] * (row > 0) + [high - half] * (row + 1 < self.up)
        places = [complex(x, y) for x in xs for y in (3 * half, high - 3 * half)]
        places += [complex(x, y) for y in ys for x in (3 * half, wide - 3 * half)]
        for place in places:
            for arm in (3, 3j):
                yield _line(made, place - arm, place + arm, _HAIR)


def _on_page(made: MadeLinkage, place: complex) -> complex:
    """Return a place within a page's margins (x + yi, mm, y up) in pixels from the page's upper left."""
    return _PIXELS * complex(MARGIN + place.real, made.sheet[1] - MARGIN - FOOT - place.imag)


def _drawn(made: MadeLinkage, part: FlatPart, at: complex, turn: complex) -> Iterator[Item]:
    """Yield a part's lines, a cross in each round hole, and its label."""
    for outline in (part.edge, *part.holes):
        points = np.array([_on_page(made, at + turn * point) for point in polygon(outline)])
        yield Layer(_INK, stroke(points, _HAIR * _PIXELS, closed=True))
    for outline in part.holes:
        if len(outline) == 2:
            middle = at + turn * (outline[0][0] + outline[1][0]) / 2
            for arm in (1.5, 1.5j):
                yield _line(made, middle - arm, middle + arm, _HAIR / 2)
    for joint, own in part.letters:
        size = min(max(_LETTERED * made.sizes.bar, _READABLE), 4.0)
        place = _on_page(made, at + turn * own)
        corner = place.real, place.imag - 0.5 * size * _PIXELS
        yield Caption(subscripted(joint), corner, round(size * _PIXELS), _INK, "centre")
    if part.label:
        size = min(max(made.sizes.bar / 3, _READABLE), 5.0, max(part.room, _READABLE))
        # words are level on the page; those of a ring stay below its hole however it is turned
        place = _on_page(made, at + (part.at if math.isfinite(part.room) else turn * part.at))
        if part.room < _READABLE:
            top = max((at + turn * point).imag for point in polygon(part.edge))
            place = _on_page(made, complex(at.real, top + 0.65 * size))
        yield Caption(
            part.label,
            (place.real, place.imag - 0.5 * size * _PIXELS),
            round(size * _PIXELS),
            _INK,
            "centre",
        )


def _line(made: MadeLinkage, begin: complex, end: complex, width: float) -> Layer:
    return Layer(_INK, segments(_on_page(made, begin), _on_page(made, end), width * _PIXELS))


def _words(made: MadeLinkage, text: str, place: complex) -> Caption:
    at = _on_page(made, place)
    return Caption(text, (at.real, at.imag), 12, _INK)


def _frame(made: MadeLinkage, number: str) -> Iterator[Item]:
    """Yield the frame of every page: white margins, the ruler, and how to print it."""
    wide, high = (side * _PIXELS for side in made.sheet)
    # so that lines at the margins' edge stay visible
    edge, foot = (MARGIN - _HAIR) * _PIXELS, (MARGIN + FOOT - _HAIR) * _PIXELS
    for left, right, top, low in (
        (0.0, wide, 0.0, edge),
        (0.0, wide, high - foot, high),
        (0.0, edge, 0.0, high),
        (wide - edge, wide, 0.0, high),
    ):
        yield Layer(
            _PAPER,
            [np.array([complex(left, top), complex(right, top), complex(right, low), complex(left, low)])],
        )
    yield _line(made, complex(0, -8), complex(_RULER, -8), _HAIR)
    for n in range(0, _RULER + 1, 5):
        yield _line(
            made, complex(n, -8), complex(n, -8 + (4 if n % 50 == 0 else 3 if n % 10 == 0 else 2)), _HAIR
        )
    yield _words(made, "0", complex(-0.9, -9))
    yield _words(
        made,
        said("{length} mm: print at 100 % and check with a ruler", length=_RULER),
        complex(_RULER - 2.5, -9),
    )
    above = complex(0, made.sheet[1] - 2 * MARGIN - FOOT + 6)
    yield _words(
        made,
        said("{title}, {size}; {page}", title=said(made.scene.title), size=made.size_words, page=number),
        above,
    )


def bodies(made: MadeLinkage) -> Iterator[tuple[str, bytes]]:
    """Yield a name and an STL file in mm for each plate, pin and ring, lying flat. Needs manifold3d.

    BadInput for a part that is larger than a sheet's size, where one is given.

    A pin's head is sunk in its lowest plate, and a cap, stuck on the pin, in its highest; a plate with a slot
    for the pin has neither. All plates but the ground turn on the pin.
    """
    sizes = made.sizes
    _sheets(made)  # refuses a part that the printer's bed does not hold
    thick = sizes.thickness
    sunk, head = _SUNK * thick, _head(made)
    for number, plate in enumerate(made.plates):
        body = _prism(plate.outline(), thick, tuple(plate.cuts()))
        (origin, direction), places = made.placed(0.0)[number], made.pinned(0.0)
        for pin, place in zip(made.pins, places, strict=True):
            at = (place - origin) * direction.conjugate()
            # The disc extends beyond the plate's face, so that no skin is left there.
            for end, foot in ((pin.low, -1.0), (pin.high, thick - sunk)):
                if number == _end_plate(made, pin, end):
                    body -= _disc(at, head + sizes.clearance, sunk + 1.0, foot)
        yield f"part-{made.label(number)}", _stl(body)
    caps = False
    for pin in made.pins:
        body = _disc(0j, sizes.pin, (pin.high - pin.low + 1) * thick, 0.0)
        if _end_plate(made, pin, pin.low) is not None:
            body += _disc(0j, head, sunk, 0.0)
        caps |= _end_plate(made, pin, pin.high) is not None
        yield f"pin-{pin.name}", _stl(body)
        for layer, diameter in pin.spacers:
            yield (
                f"ring-{pin.name}-layer-{layer}",
                _stl(_disc(0j, diameter, thick, 0.0) - _disc(0j, sizes.hole, thick + 2, -1.0)),
            )
    if caps:
        yield "cap", _stl(_disc(0j, head, sunk, 0.0) - _disc(0j, sizes.snug, sunk + 2, -1.0))


def _head(made: MadeLinkage) -> float:
    """Return the diameter of a printed pin's head: it fits into the narrowest plate, a tongue."""
    return made.sizes.hole + made.sizes.wall / 2


def _end_plate(made: MadeLinkage, pin: MadePin, layer: int) -> int | None:
    """Return the plate in a layer that holds a pin's head or cap; None for a slot, and for a dowel."""
    if pin.stuck:
        return None
    return next((n for n in pin.plates if made.layer[n] == layer and n not in pin.sliding), None)


def _prism(edge: Outline, thick: float, holes: Sequence[Outline]) -> Manifold:
    from manifold3d import CrossSection, FillRule

    loops = [polygon(edge), *(polygon(hole)[::-1] for hole in holes)]
    return CrossSection([[(p.real, p.imag) for p in loop] for loop in loops], FillRule.Positive).extrude(
        thick
    )


def _disc(at: complex, diameter: float, thick: float, foot: float) -> Manifold:
    return _prism(rounded([at], diameter / 2), thick, ()).translate((0.0, 0.0, foot))


def _stl(body: Manifold) -> bytes:
    """Return a body as binary STL: triangles with their normals, which point outwards."""
    mesh = body.to_mesh()
    corners = np.asarray(mesh.vert_properties, np.float64)[:, :3][np.asarray(mesh.tri_verts)]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    records = np.zeros(len(corners), [("numbers", "<f4", (4, 3)), ("attribute", "<u2")])
    records["numbers"][:, 0], records["numbers"][:, 1:] = normals, corners
    return bytes(80) + np.uint32(len(corners)).tobytes() + records.tobytes()
