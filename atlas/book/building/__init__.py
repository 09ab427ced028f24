"""Building of figures and reports: only if an input changed, and written whole or not at all."""
