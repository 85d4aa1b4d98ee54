"""What a linkage is, as data: joints, bodies, lines of travel, the drive; nothing here moves."""
