# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From a person to a sign of the robot: recordings in, entries of the look-up table out.

    >>> from teo_description.robot import Robot
    >>> from teo_sign_capture import read_skeletons, retarget_motion, signer_motion
    >>> signer = signer_motion(read_skeletons(bag), handedness="right")
    >>> motion = retarget_motion(Robot.load(), signer)

Each room imports only rooms above it in this list; the README says more of each.

    signing_space       directions, places of articulation, points of a hand
    tracks              a person's keypoints over time, and the signer described once
    recordings          bags, films, clips and live skeletons, each read as a track
    retarget            a person's motion as a motion of the robot
    recognition         the signs that a demonstration may be
    entries             takes, checks, entries, batches
    cli, node           the commands, the ROS node

A name is imported when it is first asked for: the commands start without what they do not need.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
