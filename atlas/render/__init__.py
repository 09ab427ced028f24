"""Two back ends for one scene: on paper (Matplotlib, hidden lines) and shaded (PyVista)."""
