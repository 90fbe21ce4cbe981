"""From sensors and oracle to where the robot is and what is around it."""
