"""What a linkage is and how it moves; numpy is all it needs.

From the ground up; a module imports from those before it only:

    tolerances  what counts as nothing, as one, or as near
    arithmetic  formulas written once, for floats, arrays and blocks
    angles      circular functions, unit vectors, exact sums of two floats
    precise     fifty digits, for what is worked out once
    machine_code  passes over arrays as machine code, where llvmlite is installed
    program     formulas compiled: a function of floats, passes over arrays
    search      where a condition ends, a function changes sign, is highest
    linkage     what a linkage is, as data
    groups      links that are solved together, as data
    solver      closing it; no other room imports this one
    closures    all closures of links that are solved together
    measures    what follows from solved quantities
    centres     instant centres, and Kennedy's theorem
    forces      what the input has to deliver
    reactions   what joints, guides and the ground carry
    followed    links that are solved together, closed: followed once, read from there
    motion      a linkage made ready; its motion and its poses
    many        linkages of one form, each at its own phase, in one call
    balance     the work that a flywheel stores, counterweights of a four-bar
    nearest     the phase at which a point is nearest to a place
    quantities  the register of all that is known of a linkage
    polygons    velocity and acceleration polygons
    analysis    class, names, transmission angles, solving steps
"""
