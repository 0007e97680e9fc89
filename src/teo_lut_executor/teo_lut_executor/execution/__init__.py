"""Sentences in their order, one at a time, and whether the robot follows. Knows neither ROS nor planning."""
