"""Moments of inertia as exact rationals."""
