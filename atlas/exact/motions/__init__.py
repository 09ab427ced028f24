"""Motions as balls: one file a family, and the torus of a body with three moments."""
