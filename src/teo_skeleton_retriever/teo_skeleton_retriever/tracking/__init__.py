"""People over time: who is who, who signs, how long their limbs are, and keypoints filtered."""
