"""Motions in elementary functions: the paper's family and its hyperbola, the free body, the ball."""
