"""The parts that take part in a running ROS graph, through rclpy."""
