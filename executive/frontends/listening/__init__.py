"""`humanoid listen`: speech in, and the robot does it."""
