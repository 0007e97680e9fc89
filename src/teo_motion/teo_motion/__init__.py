"""From signs to motion within the robot's limits. See `planner` for the whole, the rooms for its parts."""
