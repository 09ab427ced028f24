"""The explorer on the user's own machine: its subjects, its answers, and the server that sends them."""
