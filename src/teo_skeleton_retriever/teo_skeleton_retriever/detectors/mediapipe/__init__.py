"""MediaPipe Holistic: its graph without what is not asked of it, and how its keypoints are off."""
