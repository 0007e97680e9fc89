# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from itertools import product

import numpy as np
import pytest


@pytest.mark.parametrize(("side", "medial"), [("Left", -1.0), ("Right", 1.0)])
class TestAtHome:
    def test_palms_face_the_body_and_fingers_point_down(self, robot, side, medial):
        palm = robot.placement(robot.configuration({}), f"{side.lower()}_palm")
        assert palm[:3, 2] == pytest.approx([0, medial, 0])
        assert palm[:3, 0] == pytest.approx([0, 0, -1])

    def test_thumb_and_index_can_touch(self, robot, side, medial):  # noqa: ARG002 - class parameters
        axes = [f"{side}{axis}" for axis in ("HandAbductor", "ThumbFinger", "IndexFinger")]
        gaps = []
        for angles in product(range(60, 85, 6), range(-70, -29, 5), range(30, 61, 5)):
            q = robot.configuration(dict(zip(axes, np.radians(angles).tolist(), strict=True)))
            tips = robot.placements(q, [f"{side}ThumbFingerTip", f"{side}IndexFingerTip"])[:, :3, 3]
            gaps.append(np.linalg.norm(tips[0] - tips[1]))
        assert min(gaps) < 0.020  # [m]: two radii of 9 mm and the grid's step

    def test_abductor_brings_the_thumb_before_the_palm_where_it_opposes_the_fingers(
        self, robot, side, medial
    ):
        q = robot.configuration({f"{side}HandAbductor": np.pi / 2})
        palm, base = robot.placements(q, [f"{side.lower()}_palm", f"{side}ThumbFinger_link"])
        assert (base - palm)[:3, 3] @ palm[:3, 2] > 0.005  # before the palmar face
        before = robot.placement(q, f"{side}ThumbFingerTip")
        closed = robot.configuration({f"{side}HandAbductor": np.pi / 2, f"{side}ThumbFinger": 0.5})
        moved = robot.placement(closed, f"{side}ThumbFingerTip") - before
        assert moved[1, 3] * medial < -0.01  # flexing moves it towards the palm: against the fingers


@pytest.mark.parametrize(("first", "second"), [(-90, 7), (-45, 26.5), (0, 46), (30, 59), (90, 85)])
def test_the_thumbs_second_joint_follows_the_first_over_its_whole_range(robot, first, second):
    q = robot.configuration({"RightThumbFinger": np.radians(first)})
    knuckle, joint, tip = robot.placements(
        q, ["RightThumbFinger_link", "RightThumbFingerDistal_link", "RightThumbFingerTip"]
    )[:, :3, 3]
    # 30 mm of first phalanx; both joints turn about y, flexion towards the fingers (from +x over -z to -x).
    for (start, end), angle in (((knuckle, joint), first), ((joint, tip), first + second)):
        along = (end - start) / np.linalg.norm(end - start)
        expected = [-np.sin(np.radians(angle)), 0.0, -np.cos(np.radians(angle))]
        assert along == pytest.approx(expected, abs=1e-9)
    assert np.linalg.norm(joint - knuckle) == pytest.approx(0.030)


def test_phalanges_copy_the_first_one(robot):
    for angle in (0.2, 1.0, 1.4):
        q = robot.configuration({"RightIndexFinger": angle})
        tip, wrist = robot.placements(q, ["RightIndexFingerTip", "FrontalRightWrist_link"])
        # Three equal joints about the wrist's x, segments of 35, 25 and 27 mm from the knuckle on.
        expected = np.array([0.0395, -0.001, -0.213])
        for length, turns in ((0.035, 1), (0.025, 2), (0.027, 3)):
            expected = expected + length * np.array([0.0, np.sin(turns * angle), -np.cos(turns * angle)])
        assert tip[:3, 3] - wrist[:3, 3] == pytest.approx(expected, abs=1e-12)
