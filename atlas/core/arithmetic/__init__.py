"""The arithmetic under the kernels: numbers and arrays in two words, exact phases, matrices of turnings, grids."""
