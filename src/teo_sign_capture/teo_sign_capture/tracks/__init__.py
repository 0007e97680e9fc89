"""A person's keypoints over time [m].

Axes of the body, smoothing, cutting into signs, measures of body, hands and head.
"""
