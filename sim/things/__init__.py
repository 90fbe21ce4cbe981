"""Household things with the forms that they have: a catalogue, and how each of them is made."""
