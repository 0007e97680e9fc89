"""People: mesh, rig, shapes, clothes, the places that hands go to, and from a pose to the skin."""
