"""What a notebook shows of objects, figures and plotters; it is loaded when one is shown, and needs no IPython."""
