"""A person: mesh, rig, shape, clothes, the places that hands go to, and the skin of a pose."""
