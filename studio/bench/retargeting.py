# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How well TEO does what a person does: exact keypoints of four people, with angles copied to compare."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from unittest.mock import patch

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

from report import Figure
from signs.joint_copy import copied_joints
from signs.retargeting_errors import Errors, errors
from signs.signer_tracks import signer_track
from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_sign_capture.recordings.skeleton_bag import read_skeletons
from teo_sign_capture.retarget import robot_motion
from teo_sign_capture.retarget.arm_kinematics import Bounds
from teo_sign_capture.retarget.arm_residuals import ArmProblem
from teo_sign_capture.retarget.arm_trajectory import solve_arms
from teo_sign_capture.retarget.collision_clearing import clear_arms
from teo_sign_capture.retarget.collision_terms import CollisionModel
from teo_sign_capture.retarget.robot_motion import RobotMotion
from teo_sign_capture.tracks.signer_motion import SignerMotion, signer_motion
from teo_sign_capture.tracks.skeleton_track import SkeletonTrack
from teo_signs.sign_schema import Handedness

BODIES = ("woman_small", "woman_average", "man_tall", "man_heavy")
SCRIPTS: tuple[tuple[str, Handedness], ...] = (
    ("face", "right"),
    ("spelling", "right"),
    ("two_hands", "both"),
    ("crossing", "both"),
)
# [Hz] The errors do not depend on it; the bench takes half the time.
_RATE = 15.0
_BAG = Path(__file__).parents[2] / "bags" / "signer_d435"


_FIELDS = {
    "palm": ("palm direction", "deg"),
    "hand": ("direction from wrist to knuckles", "deg"),
    "pointing": ("pointing direction of an index", "deg"),
    "wrist": ("wrist to the nearest of face, ears, chest, belly, scaled", "mm"),
    "contact": ("finger tip at the face, to the same place of TEO's", "mm"),
    "flexion": ("finger flexion, a joint's share", "deg"),
}


def measure() -> list[Figure]:
    """Figures of the shipped bag's truth, and of other scripts and bodies together."""
    robot = Robot.load()
    bag = read_skeletons(_BAG, topic="/truth/skeletons")
    takes: list[tuple[SkeletonTrack, Handedness]] = [
        (signer_track(script, body, _RATE), hands) for body in BODIES for script, hands in SCRIPTS
    ]
    with _watched() as watch:
        figures = _compared(robot, "bags/signer_d435", [(bag, "both")])
        figures += _compared(robot, f"{len(takes)} takes of {len(BODIES)} bodies", takes)
    problem, times, bounds, arms = watch.solved[0]
    alone, cost = _frame_by_frame(problem, bounds[0], arms[:, :6])
    together = float(problem.of_hand(0, arms[:, :6], np.arange(len(arms))).cost.sum())
    return [
        *figures,
        Figure("inverse kinematics of the arms, a frame", f"{1e3 * watch.solving / watch.frames:.2f} ms"),
        Figure(
            "the right arm frame by frame instead (L-BFGS-B, from the one before)",
            f"{1e3 * alone / len(times):.2f} ms; what is wanted costs {cost:.1f}, as a whole {together:.1f}",
        ),
        Figure("arms off what they touch, a frame", f"{1e3 * watch.clearing / watch.frames:.1f} ms"),
        Figure("all of retargeting, a frame", f"{1e3 * watch.all / watch.frames:.1f} ms"),
    ]


def _compared(robot: Robot, what: str, tracks: list[tuple[SkeletonTrack, Handedness]]) -> list[Figure]:
    ours, copied = [], []
    for track, hands in tracks:
        motion = robot_motion.retarget_motion(robot, signer_motion(track, handedness=hands))
        for side in ("right", "left") if hands == "both" else (hands,):
            ours.append(errors(robot, track, side, motion.joints, motion.positions))
            copied.append(errors(robot, track, side, *copied_joints(track, side)))
    figures = [
        Figure(
            f"{what}: {text}", f"{_spread(ours, field, unit)}; angles copied {_spread(copied, field, unit)}"
        )
        for field, (text, unit) in _FIELDS.items()
    ]
    touching, of_copies = (np.concatenate([one.touching for one in found]).mean() for found in (ours, copied))
    return [
        *figures,
        Figure(f"{what}: frames that touch", f"{touching:.1%}; angles copied {of_copies:.1%}"),
    ]


def _spread(found: list[Errors], field: str, unit: str) -> str:
    values = np.concatenate([getattr(one, field) for one in found])
    median, most = np.percentile(values, [50, 90])
    return f"median {median:.0f}, p90 {most:.0f} {unit}"


class _Watch:
    """Time of one core that retargeting takes [s], and what it solved."""

    def __init__(self) -> None:
        self.frames = 0
        self.solving = self.clearing = self.all = 0.0
        self.solved: list[tuple[ArmProblem, Array, list[Bounds], Array]] = []


@contextmanager
def _watched() -> Iterator[_Watch]:
    watch = _Watch()
    retarget = robot_motion.retarget_motion

    def solving(problem: ArmProblem, times: Array, bounds: list[Bounds], starts: Array) -> Array:
        start = time.process_time()
        arms = solve_arms(problem, times, bounds, starts)
        watch.solving += time.process_time() - start
        watch.solved.append((problem, times, bounds, arms))
        return arms

    def clearing(
        problem: ArmProblem,
        model: CollisionModel,
        times: Array,
        bounds: list[Bounds],
        arms: Array,
        *,
        source: str,
    ) -> tuple[Array, Array]:
        start = time.process_time()
        cleared = clear_arms(problem, model, times, bounds, arms, source=source)
        watch.clearing += time.process_time() - start
        return cleared

    def retargeting(robot: Robot, signer: SignerMotion) -> RobotMotion:
        start = time.process_time()
        motion = retarget(robot, signer)
        watch.all += time.process_time() - start
        watch.frames += len(signer.times)
        return motion

    with (
        patch.object(robot_motion, "solve_arms", solving),
        patch.object(robot_motion, "clear_arms", clearing),
        patch.object(robot_motion, "retarget_motion", retargeting),
    ):
        yield watch


def _frame_by_frame(problem: ArmProblem, bounds: Bounds, path: Array) -> tuple[float, float]:
    """Time [s] and cost of the first arm, each frame sought from the one before."""
    limits = list(zip(*bounds, strict=True))
    start, cost, arm = time.process_time(), 0.0, path[0]
    for frame in range(len(path)):
        at = np.array([frame])

        def value(arm: Array, at: NDArray[np.intp] = at) -> tuple[float, Array]:
            found = problem.of_hand(0, arm[None], at)
            return float(found.cost[0]), found.gradient[0]

        found = minimize(value, arm, jac=True, bounds=limits, method="L-BFGS-B")
        arm, cost = found.x, cost + float(found.fun)
    return time.process_time() - start, cost


if __name__ == "__main__":
    for figure in measure():
        print(f"{figure.what}: {figure.value}")
