"""The console: a page on this machine alone, that shows a robot at work and steers it."""
