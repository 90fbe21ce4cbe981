"""Readings of one clause, by what the clause is; their order is in :mod:`intents.english.order`."""
