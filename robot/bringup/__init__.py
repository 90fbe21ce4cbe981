"""Putting the parts together: in one process (`fast`), or as processes under a supervisor."""
