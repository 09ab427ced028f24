"""The explorer on the user's own machine: what can be explored, what it answers, and the server that hands it over."""
