"""Messages as plain values and text: their classes, filling from YAML, printing. Needs no ROS running."""
