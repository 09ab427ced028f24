"""The machinery of the general motion: roots and means of its quartic, its functions of time, rows and grids."""
