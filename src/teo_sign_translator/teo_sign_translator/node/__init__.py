"""The translator as a ROS node: texts in, sign tokens out, in the order in which they come."""
