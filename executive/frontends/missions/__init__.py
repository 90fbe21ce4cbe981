"""`humanoid mission`: its command lines, and what they do."""
