"""Bags: MCAP files with a `metadata.yaml` beside them, as rosbag2 Jazzy writes them. Needs no ROS running."""
