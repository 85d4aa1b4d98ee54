"""From a file to a scene: tables, joints, drives, bodies, shorthands, and every problem found."""
