"""From points in a picture to keypoints in space, by the lengths of a person's limbs and bones."""
