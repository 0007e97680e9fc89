"""OpenPose's files of keypoints: read as it writes them, beside a recording, or all known already."""
