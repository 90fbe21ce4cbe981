"""The 20 Hz heart: jobs in, ticks of the tree, health watched, an outcome out."""
