"""What happened, a JSON line an event: written, read again, told, explained, drawn."""
