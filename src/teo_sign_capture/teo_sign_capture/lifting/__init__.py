"""From points in a picture to keypoints in space, by the lengths of limbs and bones."""
