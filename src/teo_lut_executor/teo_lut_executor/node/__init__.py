"""The executor as a ROS node: parameters, messages, services, action."""
