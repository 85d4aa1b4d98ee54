"""Speed against error: this solver, measured, and the usual ways of solving a linkage, as recorded.

From the ground up; a module imports from those before it only:

    questions  the linkages and inputs that every method has to solve
    reference  exact answers with many digits, and the scores of other answers by them
    methods    this solver's ways to answer
    further    a cycle, many linkages, links solved together, forces
    result     the result of a run, as rows, a table and JSON
    drawing    speed against error as a picture
    command    the command's options and what it prints
"""
