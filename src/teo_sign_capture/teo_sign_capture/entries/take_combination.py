# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Several takes of one sign become one motion: those that agree are averaged, or the best is chosen.

Takes are compared by what the robot shows: where each palm is, how hand and fingers are directed, and how the
fingers are bent, in units that people just tell apart; time is warped, as nobody signs
twice at the same pace.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d

from teo_common.arrays import Array
from teo_common.dynamic_programming import warp
from teo_description.humanoid import Side
from teo_description.robot import Robot
from teo_sign_capture.retarget.robot_motion import RobotMotion
from teo_signs.errors import LutError

_SIDES: tuple[Side, Side] = ("right", "left")
# [m] Unit of places: two fingers' breadth.
_PLACE = 0.03
# [rad] Unit of directions and bends, as in `lut nearest`.
_TURN = np.radians(15.0)
# A take that is farther from the others than this many times what they usually are is another sign, or a
# mistake.
_OUTLIER = 2.0
# [unit] Takes within a unit of each other are never outliers.
_ALIKE = 1.0
# [rad] Joints that differ by more between takes are two ways of making a sign: their mean may be neither.
_AGREE = np.radians(15.0)
# The mean of two is half of a mistake.
_LEAST_AVERAGED = 3
# [%] Percentile of the differences between takes, so that one image does not decide.
_SPREAD = 95.0


@dataclass(frozen=True, kw_only=True, eq=False)
class Combined:
    """One motion of several takes.

    Attributes:
        times: From 0 [s]. Shape (n,).
        joints: The m joints that every take used moves.
        positions: [rad]. Shape (n, m).
        leader: Index of the take that leads: it was chosen, or the others were averaged onto it.
        used: Indices of the takes that are in the motion.
        reason: Why, a sentence.
    """

    times: Array
    joints: tuple[str, ...]
    positions: Array
    leader: int
    used: tuple[int, ...]
    reason: str


def combine(robot: Robot, motions: Sequence[RobotMotion], names: Sequence[str]) -> Combined:
    """Make one motion of takes.

    Args:
        robot: The robot.
        motions: A motion for each take.
        names: Of the takes, for the reason.

    Raises:
        LutError: "takes_differ" if they are not made with the same joints.
    """
    if len(motions) == 1:
        return _chosen(motions, 0, (0,), "One take.")
    for name, motion in zip(names, motions, strict=True):
        if _hands(robot, motion) != _hands(robot, motions[0]):
            raise LutError(
                "takes_differ",
                f"expected takes made with the same hands, got {_hands(robot, motions[0])} in {names[0]} and "
                f"{_hands(robot, motion)} in {name}: leave one out, or name the hands with --hands",
            )
    shown = [features(robot, motion) for motion in motions]
    count = len(motions)
    warps = {(a, b): warp(shown[a], shown[b]) for a in range(count) for b in range(count) if a != b}
    apart = np.array(
        [[warps[a, b].distance if a != b else np.nan for b in range(count)] for a in range(count)]
    )
    usual = np.nanmedian(apart, axis=1)
    kept = [
        index
        for index in range(count)
        if count < 3 or usual[index] <= max(_ALIKE, _OUTLIER * float(np.median(usual)))
    ]
    dropped = [index for index in range(count) if index not in kept]
    reason = f"{count} takes, {np.nanmedian(apart):.2f} apart (1 is 3 cm or 15 deg)."
    for index in dropped:
        reason += f" {names[index]} is left out: {usual[index]:.2f} from the others."
    leader = min(kept, key=lambda index: _shortfall(motions[index]) + float(np.nanmean(apart[index][kept])))
    if len(kept) < _LEAST_AVERAGED:
        reason += f" {names[leader]} is taken: it reaches best what was shown and is nearest to the others."
        return _chosen(motions, leader, (leader,), reason)
    joints = tuple(
        joint for joint in motions[leader].joints if all(joint in motions[index].joints for index in kept)
    )
    warped = np.stack(
        [
            _warped(motions[index], joints, warps[leader, index].pairs if index != leader else None)
            for index in kept
        ]
    )
    differ = float(np.percentile(np.abs(warped - warped.mean(axis=0)).max(axis=2), _SPREAD))
    if differ > _AGREE:
        reason += (
            f" {names[leader]} is taken: joints differ by {np.degrees(differ):.0f} deg between takes, "
            "too much for a mean."
        )
        return _chosen(motions, leader, (leader,), reason)
    times = motions[leader].times - motions[leader].times[0]
    pace = float(np.mean([np.ptp(motions[index].times) for index in kept])) / float(np.ptp(times))
    reason += (
        f" Mean of {len(kept)}, on the time of {names[leader]}; they differ by {np.degrees(differ):.1f} deg."
    )
    # Warping doubles and skips frames: a frame's width takes the steps away.
    mean = gaussian_filter1d(warped.mean(axis=0), 1.0, axis=0, mode="nearest")
    return Combined(
        times=times * pace, joints=joints, positions=mean, leader=leader, used=tuple(kept), reason=reason
    )


def features(robot: Robot, motion: RobotMotion) -> Array:
    """What the robot shows in each frame, in units that people tell apart.

    Returns:
        For each hand its place and two of its directions, then the bend of each axis of a hand (second and
        third number 0). Shape (n, f, 3).
    """
    humanoid = robot.humanoid
    sides = _hands(robot, motion)
    palm = humanoid.file.hand.palm
    palms = {"right": palm, "left": humanoid.mirrored_name(palm)}
    hands = set(humanoid.hand("right") + humanoid.hand("left"))
    fingers = [index for index, joint in enumerate(motion.joints) if joint in hands]
    rows = []
    for pose in motion.positions:
        q = robot.configuration(dict(zip(motion.joints, pose.tolist(), strict=True)))
        row = []
        for palm in robot.placements(q, [palms[side] for side in sides]):
            row += [palm[:3, 3] / _PLACE, palm[:3, 0] / _TURN, palm[:3, 2] / _TURN]
        bends = np.zeros((len(fingers), 3))
        bends[:, 0] = pose[fingers] / _TURN
        rows.append(np.concatenate([np.array(row), bends]))
    return np.array(rows)


def _hands(robot: Robot, motion: RobotMotion) -> tuple[Side, ...]:
    humanoid = robot.humanoid
    return tuple(side for side in _SIDES if set(humanoid.arm(side)) <= set(motion.joints))


def _shortfall(motion: RobotMotion) -> float:
    """How far a motion falls short of what was shown [unit]."""
    errors = (motion.place_error / _PLACE, motion.palm_error / _TURN, motion.flexion_error / _TURN)
    return float(np.nanmean(np.stack(errors)))


def _chosen(motions: Sequence[RobotMotion], leader: int, used: tuple[int, ...], reason: str) -> Combined:
    motion = motions[leader]
    return Combined(
        times=motion.times - motion.times[0],
        joints=motion.joints,
        positions=motion.positions,
        leader=leader,
        used=used,
        reason=reason,
    )


def _warped(motion: RobotMotion, joints: tuple[str, ...], pairs: NDArray[np.int64] | None) -> Array:
    """Positions of a take at the leader's frames. Shape (n, m)."""
    columns = [motion.joints.index(joint) for joint in joints]
    positions = motion.positions[:, columns]
    if pairs is None:
        return positions
    count = int(pairs[-1, 0]) + 1
    return np.array([positions[pairs[pairs[:, 0] == frame, 1]].mean(axis=0) for frame in range(count)])
