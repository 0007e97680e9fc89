"""Bags as files: MCAP and `metadata.yaml`, as rosbag2 Jazzy writes them. Needs no ROS running."""
