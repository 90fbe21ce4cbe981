"""Teaches the network that names things: scenes to learn from, learning, judging, its file."""
