"""A linkage that can be made: cut it, pin it together, and it turns.

The door is `request.make`; what it gives is a `MadeLinkage`.

From the ground up; a module imports from those before it only:

    media      the ways of making, the sizes of paper
    shapes     outlines in mm, with arcs
    sweep      how near moving pieces come to each other over the true period
    gears      which wheels mesh, and their involute teeth
    parts      a linkage as flat parts: plates with holes and slots, pins, plates that share a layer
    layers     the layer of each plate: as few layers as possible, or the clashes that prevent any
    made       sizes and scale, and the parts in their layers as a value
    nesting    the places of parts on sheets
    documents  SVG, DXF, PDF in true size, STL
    drawing    pictures: the plan by layers, from the side, exploded, step by step
    sheet      the page of instructions for assembly
    files      all of these as a folder
    request    `linkanim.make`: a request, checked and carried out
"""
