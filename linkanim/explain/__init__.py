"""The worked solution: how the numbers of a pose follow from the drawing, line by line.

From the ground up; a module imports from those before it only:

    formula       formulas as trees, and set in LaTeX or MathML
    steps         chapters, steps, lines; what is known so far
    joints        how each kind of joint is worked out; the vector loops
    synthesis     the chapter on how a linkage was made
    whole_motion  the chapters on how far the input goes and where the output turns back
    solution      the chapters of a pose, in order
    documents     HTML, LaTeX, Markdown
    variant       the same exercise with other round lengths
"""
