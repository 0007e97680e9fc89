"""Pictures and films of a pose or motion, drawn without a display."""
