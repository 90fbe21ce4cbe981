"""Runs that were recorded: done again and compared, or gone on with after they were cut off."""
