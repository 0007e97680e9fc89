"""A person's motion as a motion of TEO."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from teo_description.robot import Robot
from teo_lut_executor.capture.skeleton_track import SkeletonTrack
from teo_lut_executor.sign_schema import Handedness

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class RobotMotion:
    """TEO doing what a person did, frame by frame, and how far it falls short.

    The errors are of shape (T, 2), right and left; NaN where that hand takes no part.

    Attributes:
        times: [s]. Shape (T,).
        joints: The m joints that take part: arm and hand of each side that signs; head, trunk if they move.
        positions: Within the limits, clear of the robot's own body [rad]. Shape (T, m).
        place_error: Distance of the hand from where the person's hand belongs on TEO [m].
        palm_error: Angle between the ways the palms face [rad].
        finger_error: Angle between the ways from wrist to knuckles [rad].
        flexion_error: Mean over the four fingers of the difference of bends, of one joint's share [rad].
        head_error: Angle by which the head falls short of the person's. Shape (T,) [rad].
        trunk_error: The same of the trunk. Shape (T,) [rad].
        clearance: Smallest distance between parts of the robot. Shape (T,) [m].
    """

    times: Array
    joints: tuple[str, ...]
    positions: Array
    place_error: Array
    palm_error: Array
    finger_error: Array
    flexion_error: Array
    head_error: Array
    trunk_error: Array
    clearance: Array


def retarget_motion(robot: Robot, track: SkeletonTrack, *, handedness: Handedness) -> RobotMotion:
    """Bring a person's motion onto TEO.

    Args:
        robot: The robot.
        track: The person; smoothed, as what trembles in it trembles in TEO.
        handedness: The hands that take part.

    Raises:
        LutError: "no_torso" or "no_hand" if what is needed was not seen, "self_collision" if TEO cannot take
            a posture without touching itself.
    """
    raise NotImplementedError
