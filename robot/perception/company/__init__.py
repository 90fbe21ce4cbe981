"""People by the robot's own lidar and depth camera: what is strange, figures, tracks, names."""
