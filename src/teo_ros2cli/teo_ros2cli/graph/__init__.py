"""Taking part in a running ROS graph through rclpy: discovery, subscribing, recording, playing, calling."""
