"""The input: its path over the phase, its range, its stroke."""
