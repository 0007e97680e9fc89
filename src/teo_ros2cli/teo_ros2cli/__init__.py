"""A `ros2` command for machines whose ROS 2 comes from PyPI; it steps aside for the genuine one."""
