"""Trees over py_trees' stock nodes: what is done, in which order, and what if it fails."""
