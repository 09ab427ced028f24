"""The quadric and the hyperbola of initial data as balls."""
