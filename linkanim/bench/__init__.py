"""Speed against error: this solver and the usual ways of solving a linkage, measured in one run.

From the ground up; a module imports from those before it only:

    questions  the linkages and inputs that every method has to solve
    reference  exact answers with many digits, and the scores of other answers by them
    methods    the usual ways, other people's packages, this solver
    result     the result of a run, as rows, a table and JSON
    drawing    speed against error as a picture
    paths      the quality of the linkages that `linkanim path` finds
    command    the command's options and what it prints
"""
