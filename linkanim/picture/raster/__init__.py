"""Pixels: shapes with exact coverage, blending, outlines that turn; it knows no linkage."""
