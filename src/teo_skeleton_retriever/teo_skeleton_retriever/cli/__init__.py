"""Commands that need no ROS running."""
