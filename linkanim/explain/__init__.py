"""The worked solution: how the numbers of a pose follow from the drawing, line by line.

From the ground up; a module imports from those before it only:

    formula       formulas as trees, printed in LaTeX or MathML
    steps         chapters, steps, lines; what is known so far
    joints        the steps for each kind of joint; the vector loops
    synthesis     the chapter on how a linkage was made
    whole_motion  the chapters on how far the input goes and where the output turns back
    forces        what each body carries: free bodies, their equations, the solution
    solution      the chapters of a pose, in order
    questions     what an exam asks about a pose, each question with the steps that answer it
    tikz          the loops' vectors and free bodies in TikZ
    documents     a solution as HTML, LaTeX or Markdown
    exercise      questions with room to work, and their key
    variant       the same exercise with other round lengths
"""
