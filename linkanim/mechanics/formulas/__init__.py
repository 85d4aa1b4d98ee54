"""Arithmetic that knows no linkage: expressions and programs, circular functions, exact sums."""
