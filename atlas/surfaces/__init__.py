"""The quadric of initial data on which Omega3 is constant."""
