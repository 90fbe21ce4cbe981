"""What the robot's camera sees of the simulated world: pictures with depth, and their flaws."""
