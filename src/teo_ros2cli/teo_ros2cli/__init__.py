"""A ros2 command for machines whose ROS 2 comes from PyPI; MCAP recording and playing. Steps aside for the genuine ros2cli."""
