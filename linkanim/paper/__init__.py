"""What goes onto paper: figures, charts and reports, from the same description as the window's picture."""
