"""Definitions of interfaces as text, and their hashes, from the installed files. Needs no ROS running."""
