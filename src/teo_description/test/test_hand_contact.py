# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from thumb_capsules import thumb_gap

from teo_description.hand_geometry import TOUCH, hand_table, thumb_gaps, with_clear_thumb
from teo_names import RIGHT_HAND, joint_limits


@pytest.fixture(scope="module")
def hands():
    limits = joint_limits(RIGHT_HAND)
    return np.random.default_rng(7).uniform(limits.lower, limits.upper, (60, 6))


@pytest.mark.parametrize("side", ["Right", "Left"])
def test_gaps_are_those_that_a_collision_library_finds(robot, hands, side):
    for hand, gap in zip(hands, thumb_gaps(hand_table(robot), hands), strict=True):
        # The table is off by 0.1 mm at each of its points.
        assert gap == pytest.approx(thumb_gap(robot, hand, side), abs=3e-4)


def test_a_thumb_leaves_the_fingers_and_a_clear_one_stays(robot, hands):
    table = hand_table(robot)
    before = thumb_gaps(table, hands)
    assert (before < -TOUCH).sum() > 10
    for hand, gap in zip(hands, before, strict=True):
        cleared = with_clear_thumb(table, hand)
        assert np.array_equal(cleared[2:], hand[2:])
        assert np.array_equal(cleared, hand) is bool(gap >= -TOUCH)
        assert thumb_gaps(table, cleared[None])[0] >= min(gap, 0.0) or gap >= -TOUCH
        assert thumb_gaps(table, cleared[None])[0] >= -TOUCH
