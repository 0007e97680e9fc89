# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Easy postures show the same as the entry, seen through Pinocchio's kinematics, and are quicker."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from nearest_parts import touching
from scipy.spatial.transform import Rotation

from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_motion.trajectory.limits import MotionLimits
from teo_names import COMMANDED_JOINTS
from teo_sign_authoring.easing.easy_words import EasyWords, neighbours
from teo_sign_authoring.easing.word_tolerance import WordTolerance
from teo_signs.look_up_table import Lut
from teo_signs.sign import Sign

_FINGERS = ("Thumb", "Index", "Middle", "Ring", "Pinky")
FACE = np.array([0.0, 0.0, 0.715])  # the middle of it, upright [m]
_FRAMES = {
    side: (f"{side}_palm", *(f"{side.capitalize()}{finger}FingerTip" for finger in _FINGERS))
    for side in ("right", "left")
}


def places(robot: Robot, sign: Sign, knots: Array) -> dict[str, Array]:
    """Palm and finger tips of both hands at every knot. Shape (n, 6, 4, 4) each."""
    qs = [robot.configuration(dict(zip(sign.joints, row.tolist(), strict=True))) for row in knots]
    return {side: np.stack([robot.placements(q, frames) for q in qs]) for side, frames in _FRAMES.items()}


def turned(palms: Array, others: Array) -> Array:
    """Angles between palms [rad]."""
    angles: Array = Rotation.from_matrix(others[:, :3, :3] @ palms[:, :3, :3].transpose(0, 2, 1)).magnitude()
    return angles


def half_turn(palms: Array) -> float:
    """The most that a palm is turned from its mean over the sign [rad]."""
    rotations = Rotation.from_matrix(np.unique(palms[:, :3, :3].round(6), axis=0))
    return float((rotations * rotations.mean().inv()).magnitude().max())


def assert_shows_the_same(robot: Robot, sign: Sign, knots: Array) -> None:
    """The same places and handshapes; palms within 15 deg of the entry, or of what a smaller sign turns."""
    assert knots.shape == sign.knots.shape
    before, after = places(robot, sign, sign.knots), places(robot, sign, knots)
    for side in _FRAMES:
        palms = [found[side][:, 0] for found in (before, after)]
        assert np.degrees(turned(*palms).max()) <= 15.1 + 0.2 * np.degrees(half_turn(palms[0])), sign.gloss
        assert np.linalg.norm(palms[1][:, :3, 3] - palms[0][:, :3, 3], axis=1).max() <= 0.0205, sign.gloss
        local = [
            np.einsum(
                "nji,nkj->nki", found[side][:, 0, :3, :3], found[side][:, 1:, :3, 3] - palm[:, None, :3, 3]
            )
            for found, palm in zip((before, after), palms, strict=True)
        ]
        assert np.linalg.norm(local[1] - local[0], axis=2).max() <= 0.0155, sign.gloss
        ends = [found[side][:, 1:, :3, 3] for found in (before, after)]
        moved, at_face = np.linalg.norm(ends[1] - ends[0], axis=2), np.linalg.norm(ends[0] - FACE, axis=2)
        assert moved[at_face < 0.23].max(initial=0.0) <= 0.0285, f"{sign.gloss} points elsewhere"
        for first, second in pairwise(range(len(knots))):
            way = [palm[second, :3, 3] - palm[first, :3, 3] for palm in palms]
            allowed = max(0.014, 0.3 * float(np.linalg.norm(way[0])))
            assert np.linalg.norm(way[1] - way[0]) <= allowed, f"{sign.gloss} moves otherwise"
    for row, other in zip(sign.knots, knots, strict=True):
        poses = [dict(zip(sign.joints, one.tolist(), strict=True)) for one in (row, other)]
        clear = [robot.clearance(robot.configuration(pose)).distance for pose in poses]
        assert clear[1] >= min(0.006, clear[0]) - 1e-3, sign.gloss
        distances = [touching(robot, pose) for pose in poses]
        if distances[0] < 0.025:
            assert distances[1] <= distances[0] + 0.0105, f"{sign.gloss} still touches"


def test_alternatives_of_the_table_show_the_same(robot: Robot, shipped: Lut) -> None:
    words = [sign for sign in (shipped[gloss] for gloss in sorted(shipped)[::9]) if sign.kind == "lexical"]
    eased = [sign for sign in words if sign.alternatives]
    assert len(eased) > len(words) / 2
    for sign in eased:
        for knots in sign.alternatives:
            assert_shows_the_same(robot, sign, knots)


@pytest.mark.parametrize("gloss", ["CASA", "QUIÉN"])
def test_an_easy_posture_takes_less_time_from_and_to_its_neighbours(
    robot: Robot, shipped: Lut, gloss: str
) -> None:
    limits = MotionLimits.of_robot()
    sign = shipped[gloss]
    before, after = neighbours(robot.humanoid, shipped, -1), neighbours(robot.humanoid, shipped, 0)
    assert before.weights.sum() == pytest.approx(1.0) == after.weights.sum()
    knots = EasyWords(robot.humanoid, limits, before, after).eased(WordTolerance(robot, sign), lambda _: True)
    assert knots is not None
    assert_shows_the_same(robot, sign, knots)
    columns = [COMMANDED_JOINTS.index(joint) for joint in sign.joints]

    def takes(knots: Array) -> float:
        ends = ((before, knots[0]), (after, knots[-1]))
        ways = sum(
            weight * np.nanmax(np.append(np.abs(row[columns] - knot) / limits.velocity[columns], 0.0))
            for one, knot in ends
            for row, weight in zip(one.postures, one.weights.tolist(), strict=True)
        )
        steps = np.maximum(
            (np.abs(np.diff(knots, axis=0)) / limits.velocity[columns]).max(axis=1), np.diff(sign.times)
        )
        return float(ways + steps.sum())

    assert takes(knots) < takes(sign.knots) - 0.05
