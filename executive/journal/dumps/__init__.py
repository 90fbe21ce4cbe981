"""A run and its tree for people and other programs to look at."""
