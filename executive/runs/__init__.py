"""Running something: a session with its folder; going on with it, and doing it again."""
