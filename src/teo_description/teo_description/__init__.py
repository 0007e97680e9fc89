"""TEO's robot description: URDF, joint groups, limits, collision model and a renderer that needs no display."""
