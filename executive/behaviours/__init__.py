"""Leaves of the tree: each runs a skill or reads a key, and does no work of its own."""
