"""Linkages for a given purpose: a path, poses, a function, a time ratio.

From the ground up; a module imports from those before it only:

    roberts        a coupler curve's cognates
    linkages       many four-bars and slider-cranks at once; limits on them
    curves         a curve to be followed: points, or a stroke by hand
    curve_files    a curve's file: numbers, or an SVG's first path
    atlas          coupler curves to start from
    fitting        the task of a path; least squares over many candidates
    drivers        a motor for a linkage whose input swings
    pairs          a linkage and its mirror image on one motor
    answers        answers checked by the solver; cognates; files
    search         from a curve to linkages that follow it, the best first
    front          deviation, size and transmission angle judged together
    path           `linkanim.path`: a drawn path
    burmester      points of a body that stay on a circle through its poses
    guidance       `linkanim.guide`: poses of the coupler
    generation     `linkanim.function`: a function of the input
    follower       paths and poses beside the window, while they are drawn
    quick_returns  `linkanim.quick_return`: a time ratio
    dwells         `linkanim.dwell`: an output that rests
    constructions  how each linkage was made, drawn step by step
"""
