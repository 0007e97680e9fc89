"""Recordings: which topics they hold, and their images with depth and camera, without ROS running."""
