# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from robot_person import bent_hand, keypoints

from teo_description.hand_geometry import HandPoints, HandTable
from teo_names import RIGHT_ARM, RIGHT_HAND, joint_limits
from teo_sign_capture.retarget.hand_motion import finger_flexions, follow_hand
from teo_sign_capture.tracks.signer_motion import signer_arm
from teo_skeleton_retriever.lifting.hand_axes import (
    finger_bends,
    in_palm,
    straight_bends,
    with_last_joints,
)

JOINTS = RIGHT_ARM + RIGHT_HAND
STRAIGHT = np.zeros((4, 3))


@pytest.fixture(scope="module")
def table(robot):
    return HandTable(robot)


def person_hand(bends, frames=10, length=0.09):
    """A right hand whose fingers, from index to little finger, are bent so, joint by joint [deg]."""
    points = bent_hand(bends, length)
    points[1:5] = [(0.02, -0.03, 0.0), (0.05, -0.05, 0.0), (0.08, -0.06, 0.0), (0.10, -0.07, 0.0)]
    return np.tile(points, (frames, 1, 1))


def followed(table, times, hand, straight):
    return follow_hand(table, times, signer_arm("right", np.zeros((len(hand), 3, 3)), hand, straight))


def test_a_hand_of_teo_is_recovered(robot, table):
    knots = np.radians([[10, -60, 10, 20, 30, 40], [30, -40, 60, 50, 30, 20], [10, -60, 80, 80, 80, 80]])
    times = np.linspace(0.0, 2.0, 41)
    axes = np.stack([np.interp(times, [0.0, 1.0, 2.0], knot) for knot in knots.T], axis=1)
    motion = np.concatenate([np.zeros((41, 6)), axes], axis=1)
    _, _, hand, _ = keypoints(robot, JOINTS, motion)
    found = followed(table, times, hand, STRAIGHT)
    assert np.degrees(np.abs(found.axes[:, 2:] - axes[:, 2:])).max() < 1.5
    thumb, wanted = (table.thumb_points(row[:, 0], row[:, 1])[:, 2] for row in (found.axes, axes))
    assert 1000.0 * np.linalg.norm(thumb - wanted, axis=1).max() < 12.0
    assert np.degrees(found.error).max() < 1.5


@pytest.mark.parametrize(
    ("bends", "least", "most"),
    [
        ([(0, 0, 0)] * 4, (7, 7, 7, 7), (7, 7, 7, 7)),
        ([(90, 100, 60)] * 4, (75, 75, 75, 75), (85, 85, 85, 85)),
        ([(0, 0, 0), *[(90, 100, 60)] * 3], (7, 75, 75, 75), (7, 85, 85, 85)),
        # Bent at the knuckles alone: more than a third of it, for the tips are to be where they are.
        ([(90, 0, 0)] * 4, (35, 35, 35, 35), (60, 60, 60, 60)),
    ],
)
def test_shapes_become_what_the_inventory_calls_them(table, bends, least, most):
    found = followed(table, np.arange(10) / 30.0, person_hand(bends), STRAIGHT)
    flexions = np.degrees(found.axes[:, 2:])
    assert (flexions >= np.array(least) - 0.5).all()
    assert (flexions <= np.array(most) + 0.5).all()


def test_what_the_coupled_joints_cannot_do_is_reported(table):
    straight, bent, fist = (
        np.degrees(followed(table, np.arange(5) / 30.0, person_hand([joints] * 4, 5), STRAIGHT).error[0])
        for joints in ((0, 0, 0), (90, 0, 0), (80, 80, 80))
    )
    assert straight == pytest.approx(7.0, abs=0.1)  # TEO's straightest
    assert bent > 5.0
    assert fist < 1.0


def test_a_finger_that_seems_bent_while_straight_is_straight_for_its_signer(table):
    seeming = [(8, 12, 6)] * 4
    hand = np.concatenate([person_hand(seeming, 20), person_hand([(80, 90, 60)] * 4, 20)])
    straight = straight_bends(hand)
    assert np.degrees(straight) == pytest.approx(np.array(seeming, float), abs=0.1)
    found = followed(table, np.arange(40) / 30.0, hand, straight)
    assert np.degrees(finger_bends(in_palm(hand)) - straight)[0].max() < 0.1
    assert np.degrees(found.axes[0, 2:]) == pytest.approx(np.full(4, 7.0), abs=0.1)


def test_a_signer_who_shows_only_a_fist_is_not_taken_for_straight():
    straight = straight_bends(person_hand([(80, 90, 60)] * 4))
    assert np.degrees(straight).max() < 10.0
    lost = np.full((5, 21, 3), np.nan)
    assert straight_bends(lost) == pytest.approx(straight)


def test_a_fist_whose_last_joints_a_detector_hardly_sees_is_closed(table):
    """As MediaPipe saw rendered fists of joints bent by (81, 95, 60)."""
    seen = person_hand([(79, 86, 33)] * 4)
    arm = signer_arm("right", np.zeros((10, 3, 3)), seen, np.zeros((4, 3)))
    assert np.degrees(arm.bends.sum(axis=2)) == pytest.approx(236.0, abs=15.0)
    whole, as_seen = (finger_flexions(table, bends)[0] for bends in (arm.bends, finger_bends(in_palm(seen))))
    true = finger_flexions(table, np.radians(np.tile([81.0, 95.0, 60.0], (1, 4, 1))))[0]
    assert (np.abs(true - whole) < 0.6 * np.abs(true - as_seen)).all()
    straight = np.radians([[[3.0, 2.0, 4.0], [40.0, 0.0, 0.0], [0.0, 30.0, 25.0], [-5.0, -3.0, -2.0]]])
    assert with_last_joints(straight) == pytest.approx(straight)


def test_a_thumb_on_the_index_touches_it_and_nothing_goes_through_anything(table):
    hand = person_hand([(40, 50, 30), *[(0, 0, 0)] * 3])
    tip = hand[0, 8]
    hand[:, 4] = tip + np.array([0.0, -0.008, 0.004])
    hand[:, 3] = hand[:, 4] * 0.7 + (0.0, -0.01, 0.0)
    found = followed(table, np.arange(10) / 30.0, hand, STRAIGHT)
    fingers = table.finger_points(found.axes[:, 2:])[0]
    thumb = table.thumb_points(found.axes[:, 0], found.axes[:, 1])[0]
    assert np.linalg.norm(thumb[2] - fingers[0, 3]) < 0.03
    assert table.hand.thumb_clearances(HandPoints(fingers, thumb)).min() > -0.006
    limits = joint_limits(RIGHT_HAND)
    assert (found.axes >= limits.lower - 1e-9).all()
    assert (found.axes <= limits.upper + 1e-9).all()
