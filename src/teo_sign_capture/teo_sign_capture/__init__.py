"""From a person to a sign of the robot."""
