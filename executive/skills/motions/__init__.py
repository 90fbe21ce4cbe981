"""What skills are made of: scripts that walk, reach, grasp, look, and come to rest."""
