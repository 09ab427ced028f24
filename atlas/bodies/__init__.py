"""Bodies and fields: moments of inertia, charges, units, conserved quantities."""
