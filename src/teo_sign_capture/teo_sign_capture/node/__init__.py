"""The ROS node that captures a sign live."""
