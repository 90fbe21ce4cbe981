"""English: the words, and how noun phrases and clauses are made of them."""
