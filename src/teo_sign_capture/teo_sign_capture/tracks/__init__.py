"""A person's keypoints over time: axes, smoothing, cutting, body, hands, head."""
