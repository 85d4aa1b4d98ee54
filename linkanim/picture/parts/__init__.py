"""What is drawn of a linkage: bodies, pins, springs, dampers, gears, the ground, traces, vectors."""
