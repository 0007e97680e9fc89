"""Recordings of ROS 1 and ROS 2, whole or cut off.

Which topics they hold, and their images with depth and camera.
"""
