"""Commands that look at recordings of sensors: they move no robot and need none."""
