"""Trajectories graded, the equations integrated, errors and orders of convergence measured."""
