"""Where to stand, how to get there, how to move an arm: asked as values, answered as values."""
