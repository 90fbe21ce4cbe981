"""Where the robot is in a map that it made before, by its lidar and its odometry alone.

`levelled` lays a scan into the plane, `PlaceFilter` follows it, `Finder` finds it anew where it is
lost, and `LidarPlace` puts the three together and says so when it does not know.
"""
