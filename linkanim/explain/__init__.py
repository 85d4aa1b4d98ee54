"""The worked solution: how the numbers of a pose follow from the drawing, line by line.

From the ground up; a module imports from those before it only:

    formula       formulas as trees, printed in LaTeX or MathML
    steps         chapters, steps, lines; what is known so far
    joints        the steps for each kind of joint; the vector loops
    synthesis     the chapter on how a linkage was made
    whole_motion  the chapters on how far the input goes and where the output turns back
    solution      the chapters of a pose, in order
    documents     a solution or an exercise as HTML, LaTeX or Markdown
    variant       the same exercise with other round lengths
"""
