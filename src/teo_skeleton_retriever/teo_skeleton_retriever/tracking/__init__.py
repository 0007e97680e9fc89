"""People over time: who is who, who signs, how large they are, and keypoints filtered."""
