"""OpenPose's files of keypoints, as it writes them or beside a recording."""
