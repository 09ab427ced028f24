"""Surfaces and curves of initial data: the quadric, the hyperbola on it, the closed motions on that."""
