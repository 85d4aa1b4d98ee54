"""A linkage that can be made: cut it, pin it together, and it turns.

The door is `request.make`; what it gives is a `MadeLinkage`.

From the ground up; a module imports from those before it only:

    media      the ways of making, pages
    shapes     outlines in mm, with arcs
    sweep      how near moving pieces come to each other over the whole period
    gears      which wheels mesh, and their involute teeth
    parts      a linkage as flat parts: plates with holes and slots, pins, what shares a layer
    layers     in which layer each plate lies: the least number, or which parts are to blame
    made       sizes and scale, and the parts in their layers as a value
    nesting    where parts lie on sheets
    documents  SVG, DXF, PDF in true size, STL
    drawing    pictures: the plan by layers, from the side, exploded, step by step
    sheet      the page that tells how to put it together
    files      all of it as a folder
    request    `linkanim.make`: what is asked for, checked and made
"""
