"""Clauses: what several readings share, and syntax of its own (questions, conditions, speech)."""
