"""What a depth camera makes of a scene: ray casting, colours, and the errors of its depth."""
