"""Names and dimensions, and where there is room for them."""
