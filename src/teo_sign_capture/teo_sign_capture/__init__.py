# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From a person to a sign of the robot: recordings in, entries of the look-up table out.

    >>> from teo_sign_capture import Robot, read_skeletons, retarget_motion
    >>> motion = retarget_motion(Robot.load(), read_skeletons(bag), handedness="right")

Each room imports only rooms above it in this list; the README says more of each.

    signing_space       directions, places of articulation, points of a hand
    tracks              a person's keypoints over time
    recordings          bags, clips and live skeletons
    lifting             from points in a picture to keypoints in space
    retarget            a person's motion as a motion of the robot
    alphabet, notation  letters and numbers; sign scores
    entries             takes, checks, entries, batches
    node, cli           the ROS node, the commands

A name is imported when it is first asked for: the commands start without what they do not need.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from teo_description.robot import Robot
    from teo_sign_capture.alphabet.letters import capture_letter, read_alphabet
    from teo_sign_capture.entries.bag_capture import Job, Saved, Settings, capture_bags
    from teo_sign_capture.entries.pose_capture import capture_pose_file
    from teo_sign_capture.entries.take import Cut, Take, capture_take
    from teo_sign_capture.lifting.clip import lift_clip
    from teo_sign_capture.notation.score_file import read_score, read_scores
    from teo_sign_capture.notation.score_retarget import score_sign
    from teo_sign_capture.recordings.pose_file import PoseClip, read_pose_file
    from teo_sign_capture.recordings.skeleton_bag import read_skeletons
    from teo_sign_capture.retarget.robot_motion import RobotMotion, retarget_motion
    from teo_sign_capture.tracks.skeleton_track import SkeletonTrack

_HOME = {
    "teo_description.robot": ("Robot",),
    "teo_sign_capture.alphabet.letters": ("capture_letter", "read_alphabet"),
    "teo_sign_capture.entries.bag_capture": ("Job", "Saved", "Settings", "capture_bags"),
    "teo_sign_capture.entries.pose_capture": ("capture_pose_file",),
    "teo_sign_capture.entries.take": ("Cut", "Take", "capture_take"),
    "teo_sign_capture.lifting.clip": ("lift_clip",),
    "teo_sign_capture.notation.score_file": ("read_score", "read_scores"),
    "teo_sign_capture.notation.score_retarget": ("score_sign",),
    "teo_sign_capture.recordings.pose_file": ("PoseClip", "read_pose_file"),
    "teo_sign_capture.recordings.skeleton_bag": ("read_skeletons",),
    "teo_sign_capture.retarget.robot_motion": ("RobotMotion", "retarget_motion"),
    "teo_sign_capture.tracks.skeleton_track": ("SkeletonTrack",),
}

__all__ = [
    "Cut",
    "Job",
    "PoseClip",
    "Robot",
    "RobotMotion",
    "Saved",
    "Settings",
    "SkeletonTrack",
    "Take",
    "capture_bags",
    "capture_letter",
    "capture_pose_file",
    "capture_take",
    "lift_clip",
    "read_alphabet",
    "read_pose_file",
    "read_score",
    "read_scores",
    "read_skeletons",
    "retarget_motion",
    "score_sign",
]


def __getattr__(name: str) -> object:
    for module, names in _HOME.items():
        if name in names:
            return getattr(import_module(module), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}; it offers {', '.join(__all__)}")
