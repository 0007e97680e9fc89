"""MediaPipe Holistic.

Its graph without what is not asked of it, which of its hands are believed, and how far its keypoints
are from the joints.
"""
