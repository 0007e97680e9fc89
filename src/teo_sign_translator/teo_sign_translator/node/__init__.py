"""The translator as a ROS node."""
