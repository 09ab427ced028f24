"""The kernels, file by file in the paper's order; NumPy only."""
