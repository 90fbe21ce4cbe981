"""Sentences with their background marked, and how the tagger learns from them.

`sentences/` was written for this project by many hands, each with voices and a world of its own.
"""
