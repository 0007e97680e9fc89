"""The commands `lut` and `plan`."""
