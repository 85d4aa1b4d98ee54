"""Charts, polygons and centres: quantities drawn beside the linkage or over it."""
