"""What outlives the controller: the process that owns the buses, and what it does alone."""
