"""A linkage that is being built: the sheet, the draft on it, the tools beside it, a photograph behind it."""
