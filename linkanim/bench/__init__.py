"""Speed against error: this solver beside the usual ways of solving a linkage, measured in one run.

From the ground up; a module imports from those before it only:

    questions  what every method is asked
    reference  answers of many digits, and what others' answers are worth beside them
    methods    the usual ways, other people's packages, this solver
    result     what a run found, as rows, a table and JSON
    drawing    speed against error as a picture
    paths      what `linkanim path` finds
    command    the command's options and what it prints
"""
