"""`synthesize` and `sensor_study`."""
