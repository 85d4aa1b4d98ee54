"""Make the mathematics font of the pages: a subset of Latin Modern Math, as woff2.

Run it with the paths of latinmodern-math.otf and of the file to write; it needs fonttools and brotli.
"""

from __future__ import annotations

import sys

from fontTools import subset

_LEFT_OUT = set(map(ord, '~^_`{}|\\@#$%&*"!?;<>:'))
_SIGNS = set(
    map(ord, "\u00a0\u00a8\u00b0\u00b1\u00b2\u00b7\u00d7\u00f7\u02d9\u0307\u0308\u2013\u2026\u2032\u2033")
)
_SIGNS |= set(
    map(
        ord,
        "\u2061\u2062\u210e\u2113\u2212\u221a\u2248\u22c5\u2264\u2265\u03d5\u0394\u03a3\u03c0\u03b8\u03c9\u03b1",
    )
)
_LETTERS = set(range(0x20, 0x7F)) - _LEFT_OUT
_ITALIC = set(range(0x1D434, 0x1D468)) | set(range(0x1D6FC, 0x1D71C)) - {0x1D715}


def main(source: str, target: str) -> None:
    """Write the letters and signs that our formulas have, with the variants that stretch."""
    options = subset.Options()
    options.flavor, options.layout_features, options.hinting = "woff2", [], False
    options.name_IDs, options.desubroutinize, options.glyph_names = [0, 1, 2, 3, 4, 5, 6, 13, 14], True, False
    options.drop_tables += ["DSIG", "FFTM"]
    font = subset.load_font(source, options)
    cut = subset.Subsetter(options)
    cut.populate(unicodes=_LETTERS | _SIGNS | _ITALIC)
    cut.subset(font)
    names = {1: "Linkanim Math", 4: "Linkanim Math", 6: "LinkanimMath-Regular"}
    names[3] = "Linkanim Math, a subset of Latin Modern Math 1.959"
    for record in font["name"].names:
        record.string = names.get(record.nameID, record.toUnicode())
    font["CFF "].cff.fontNames = ["LinkanimMath-Regular"]
    font.recalcTimestamp = False
    subset.save_font(font, target, options)


if __name__ == "__main__":
    main(*sys.argv[1:])
