"""How people reach the robot: command line, prompt, listening, and what they see of it."""
