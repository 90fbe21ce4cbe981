"""Pages of the documentation that are made of the code's own tables."""
