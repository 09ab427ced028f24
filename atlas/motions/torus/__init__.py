"""Motions of a body with three moments of inertia, on a torus of two phases."""
