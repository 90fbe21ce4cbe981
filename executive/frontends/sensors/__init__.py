"""Commands that work on recordings of sensors: they move no robot and need none."""
