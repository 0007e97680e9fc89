"""Which keypoints people have: their names, order and links; a person in an image and in space."""
