"""`humanoid dump`, and the options by which other commands dump as they run."""
