"""The arithmetic under the balls: roots of quartics, numbers with one square root, powers."""
