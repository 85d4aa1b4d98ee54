"""A curve to be followed: checked points, from a file or a stroke drawn by hand."""
