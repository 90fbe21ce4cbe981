"""Words: tokens, spelling, names, numbers, verbs, and the lists of words that have a meaning."""
