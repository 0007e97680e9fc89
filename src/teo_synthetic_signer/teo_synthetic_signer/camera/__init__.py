"""What a camera makes of a scene: rays, colours, visibility, and the errors of its depth."""
