"""How joints close, one after the other, and where on the way they cannot."""
