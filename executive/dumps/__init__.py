"""Trees for people and other programs to look at."""
