# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From a person to a sign of the robot: recordings in, entries of the look-up table out.

    >>> from teo_description.robot import Robot
    >>> from teo_sign_capture import read_skeletons, retarget_motion, signer_motion
    >>> signer = signer_motion(read_skeletons(bag), handedness="right")
    >>> motion = retarget_motion(Robot.load(), signer)

Each room imports only rooms above it in this list; the README says more of each.

    signing_space       directions, places of articulation, points of a hand
    tracks              a person's keypoints over time
    recordings          bags, clips and live skeletons
    lifting             from points in a picture to keypoints in space
    retarget            a person's motion as a motion of the robot
    entries             takes, checks, entries, batches
    node, cli           the ROS node, the commands

A name is imported when it is first asked for: the commands start without what they do not need.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
