"""How `teo.urdf` is written from published figures."""
