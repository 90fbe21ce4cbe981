"""The robot for ROS 2 machines: its topics over zenoh as rmw_zenoh has them, without ROS."""
