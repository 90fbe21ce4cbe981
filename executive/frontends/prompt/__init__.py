"""The prompt: sentences and commands in one place, while the robot works."""
