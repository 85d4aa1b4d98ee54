"""One page that moves in any browser: a scene's picture and motion in one file.

From the ground up; a module imports from those before it only:

    movers   the parts of a picture that move, how, and in which colours
    tables   numbers over a period, read between entries
    forces   the arrows of forces, as tables
    laws     how a quantity follows from the motion of joints
    lengths  a linkage as data for the page's own solver
    page     the page itself
    site     every scene as a page, and an index of them
"""
