"""A drawn path to the linkages that follow it."""
