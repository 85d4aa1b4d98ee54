"""What goes onto a page: charts as PNG, SVG and CSV, from the same description as the window's strip."""
