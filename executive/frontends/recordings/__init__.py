"""Commands on recordings of sensors, and maps made of them: they move no robot and need none."""
