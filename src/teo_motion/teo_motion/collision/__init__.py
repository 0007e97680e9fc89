"""Keeping the robot clear of itself: distances along a motion, idle limbs, detours."""
