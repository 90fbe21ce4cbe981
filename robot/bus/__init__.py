"""Messages between the parts of the robot: the table of topics, and what carries them."""
