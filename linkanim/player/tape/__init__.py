"""Recordings of actions: in memory and as files."""
