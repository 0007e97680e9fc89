# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The movement of a letter without what the tracker and the search for arms add to it.

Arms that are sought frame by frame lead the hand where it was seen, and tremble: of 3 s that TEO's V took,
one was movement. Of all motions of the arm whose palm stays within a tube around the captured one, the one is
taken that the slowest joint makes soonest, with few and small corners: a linear program (corners count by
their size, as in S.-J. Kim, K. Koh, S. Boyd, D. Gorinevsky, "l1 trend filtering", SIAM Review 51, 2009). The
hand's own axes stay as captured: Y's little finger wags by 15 deg, and with half of that Y is taken for I.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_sign_authoring.alphabet.spelling_arm import spelling_bounds
from teo_sign_authoring.linear_program import DIRECTIONS, LinearProgram
from teo_sign_capture.retarget.arm_kinematics import ArmKinematics

# [m] The palm's tube. The smallest letters sway by 4 cm; at 4 mm all eleven take a second less together, but
# LL's way agrees with the recording by .87 instead of .94.
_SHIFT = 0.003
# [rad] Turns of the palm: a third of what is just seen.
_TURN = np.radians(5.0)
# [rad] A joint of the arm goes no farther, so that an elbow that is free stays where it hangs.
_ROOM = np.radians(10.0)
# Seconds at a joint's greatest speed that a corner costs, over a second of the slowest joint [1]. At 1
# letters take longer.
_CORNER = 0.4
# What a joint's being off where it was captured costs [1], likewise: enough that nothing is off for nothing.
_OFF = 0.01
# A corner, by the frames around it.
_SECOND_DIFFERENCE = ((1, 1.0), (0, -2.0), (-1, 1.0))
# Programs, each about what the last one found: a third makes no letter quicker.
_ROUNDS = 2


def quick_movement(robot: Robot, arm: Array) -> Array:
    """The quickest motion in the tube around a captured one.

    Args:
        robot: The robot.
        arm: Joints of its right arm in each frame [rad]. Shape (n, j).

    Returns:
        Shape (n, j); as it is where nothing moves.

    Raises:
        LutError: "no_posture" if the solver finds nothing.
    """
    if not np.ptp(arm, axis=0).any():
        return arm
    found = arm
    for _ in range(_ROUNDS):
        found = found + _program(robot, arm, found)
    return found


def _program(robot: Robot, captured: Array, now: Array) -> Array:
    """The change [rad], in a program that is linear about the motion as it is now. Shapes (n, j)."""
    chain = ArmKinematics(robot)
    own = np.arange(captured.size).reshape(captured.shape)
    program = LinearProgram(captured.size)
    wanted, poses = chain.poses(captured), chain.poses(now)
    places = poses.point_jacobian(poses.place)
    for frame, columns in enumerate(own):
        turned = Rotation.from_matrix(poses.rotation[frame] @ wanted.rotation[frame].T).as_rotvec()
        shifted = poses.place[frame] - wanted.place[frame]
        program.add([(columns, DIRECTIONS @ poses.axes[frame].T)], _TURN - DIRECTIONS @ turned)
        program.add([(columns, DIRECTIONS @ places[frame])], _SHIFT - DIRECTIONS @ shifted)
    # In seconds at each joint's greatest speed.
    speeds = robot.humanoid.limits(robot.humanoid.arm("right")).velocity
    seconds, off = np.diag(1.0 / speeds), (now - captured) / speeds
    steps = np.diff(now, axis=0) / speeds
    corners = np.diff(steps, axis=0)
    for frame, joint in np.ndindex(captured.shape):
        one, price = seconds[[joint], [joint]][:, None], program.variable(_OFF)
        program.add_distance([(own[frame, [joint]], one)], off[frame, [joint]], price)
        if 0 < frame < len(captured) - 1:
            ways = [(own[frame + beside, [joint]], times * one) for beside, times in _SECOND_DIFFERENCE]
            program.add_distance(ways, corners[frame - 1, [joint]], program.variable(_CORNER))
    for frame, step in enumerate(steps):
        ways = [(own[frame + 1], seconds), (own[frame], -seconds)]
        program.add_distance(ways, step, program.variable(1.0))
    least, most = spelling_bounds(chain)
    # What is captured is in its tube, also where rounding has it a hair outside a limit.
    lower = np.maximum(captured - _ROOM, np.minimum(least, captured))
    upper = np.minimum(captured + _ROOM, np.maximum(most, captured))
    return program.solved((lower - now).ravel(), (upper - now).ravel()).reshape(captured.shape)
