"""Recordings: frames to GIF, MP4 and numbered PNG."""
