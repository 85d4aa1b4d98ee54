"""The kinds of questions: each made from what is solved, its wrong answers from known misconceptions."""
