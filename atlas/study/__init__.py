"""Integrators as peers, work against precision, stress."""
