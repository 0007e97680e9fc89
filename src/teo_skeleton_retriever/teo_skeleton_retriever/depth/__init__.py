"""From keypoints in an image and its depth to joints in space.

What lies around a keypoint, the skin before a joint, the lengths of limbs, the shape of a hand.
"""
