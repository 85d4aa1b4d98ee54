"""Loops on a crank pin: their signed roots, what keeps them exact, the input at one instant."""
