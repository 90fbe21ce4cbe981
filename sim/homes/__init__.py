"""Homes made from a seed: rooms, furniture, things, people, and what to ask of a robot there."""
