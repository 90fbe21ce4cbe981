"""Phrases: what describes a thing, a person or a place, and what it stands for."""
