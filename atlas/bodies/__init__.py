"""Bodies and what acts on them: moments of inertia, charges, fields, units, what is conserved."""
