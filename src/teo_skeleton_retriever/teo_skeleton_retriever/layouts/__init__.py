"""Which keypoints people have, in which order.

Bodies, hands and faces; a person in an image (`Person2D`), a person in space (`Skeleton`), and the
frame of a body.
"""
