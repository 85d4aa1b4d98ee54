"""Poses and motions: what is solved, requested, measured and derived."""
