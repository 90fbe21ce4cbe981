"""The commands of the prompt: `table`, and what they do."""
