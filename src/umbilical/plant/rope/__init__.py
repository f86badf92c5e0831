"""The rope: an elastic cable in space, slack included, paid out and hauled in, with the body at its end."""
