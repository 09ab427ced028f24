"""Two back ends for one scene: vector (Matplotlib) and shaded (PyVista)."""
