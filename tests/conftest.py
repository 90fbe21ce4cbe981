"""What all tests share: one hypothesis profile."""

from hypothesis import settings

# Repeatable, and patient with a slow machine: a deadline would fail a test for the machine's sake.
settings.register_profile("repeatable", deadline=None, derandomize=True, print_blob=True)
settings.load_profile("repeatable")
