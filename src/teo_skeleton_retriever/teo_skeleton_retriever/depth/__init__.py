"""From keypoints in an image and its depth to joints in space, one part of the body at a time."""
