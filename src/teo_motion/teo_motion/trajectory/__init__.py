"""Joints between waypoints: limits, Ruckig segments, timing, splicing, stopping."""
