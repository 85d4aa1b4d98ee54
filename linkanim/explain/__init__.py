"""The worked solution: how the numbers of a pose follow from the drawing, line by line."""
