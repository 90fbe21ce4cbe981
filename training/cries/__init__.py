"""Trains the network that spots cries (`intents.speech.cries`) on synthesised voices."""
