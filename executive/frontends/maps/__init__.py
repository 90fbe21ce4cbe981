"""`humanoid map`: maps of buildings from recordings of a lidar."""
