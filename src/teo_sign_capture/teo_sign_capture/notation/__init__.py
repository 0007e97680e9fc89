"""Sign scores: signs written down by their form, and brought onto the robot."""
