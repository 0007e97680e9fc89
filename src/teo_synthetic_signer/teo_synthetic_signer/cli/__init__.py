"""`synthesize`, and `sensor_study`, which compares depth cameras for signing."""
