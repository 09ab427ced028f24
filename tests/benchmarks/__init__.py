"""Benchmarks of the whole program: run by make, recorded in reports/data."""
