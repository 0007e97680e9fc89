# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
import coal
import numpy as np
import pytest

from teo_description import LEFT_HAND, RIGHT_HAND, joint_limits
from teo_description.hand_contact import TOUCH, thumb_gaps, with_clear_thumb
from teo_description.hand_geometry import FINGERS, dextra_table

# Radii of the collision model's rods, from the knuckle on [m]: data/shapes.csv, typed once more.
FINGER_RADII, THUMB_RADII = (0.009, 0.0085, 0.008), (0.0095, 0.009)


@pytest.fixture(scope="module")
def hands():
    limits = joint_limits(RIGHT_HAND)
    return np.random.default_rng(7).uniform(limits.lower, limits.upper, (60, 6))


def capsules(robot, q, side, chain, radii):
    """Capsules between the origins of a chain's links and to its tip, as coal has them."""
    frames = [f"{side}{name}" for name in chain]
    points = robot.placements(q, frames)[:, :3, 3]
    for index, (begin, end, radius) in enumerate(zip(points[:-1], points[1:], radii, strict=True)):
        along = (end - begin) / np.linalg.norm(end - begin)
        end -= (index == len(radii) - 1) * radius * along
        aside = np.linalg.svd(along[None])[2][1]
        rotation = np.column_stack([aside, np.cross(along, aside), along])
        yield (
            coal.Capsule(radius, float((end - begin) @ along)),
            coal.Transform3s(rotation, (begin + end) / 2.0),
        )


@pytest.mark.parametrize(("side", "joints"), [("Right", RIGHT_HAND), ("Left", LEFT_HAND)])
def test_gaps_are_those_that_a_collision_library_finds(robot, hands, side, joints):
    request = coal.DistanceRequest()
    request.enable_signed_distance = True
    for hand, gap in zip(hands, thumb_gaps(dextra_table(robot), hands), strict=True):
        q = robot.configuration(dict(zip(joints, hand.tolist(), strict=True)))
        chain = ("ThumbFinger_link", "ThumbFingerDistal_link", "ThumbFingerTip")
        thumb = list(capsules(robot, q, side, chain, THUMB_RADII))
        fingers = [
            capsule
            for finger in FINGERS
            for capsule in capsules(
                robot,
                q,
                side,
                [f"{finger}Finger{part}" for part in ("_link", "Middle_link", "Distal_link", "Tip")],
                FINGER_RADII,
            )
        ]
        least = min(
            coal.distance(*one, *other, request, coal.DistanceResult()) for one in thumb for other in fingers
        )
        assert gap == pytest.approx(least, abs=3e-4)  # the table is off by 0.1 mm at each of its points


def test_a_thumb_leaves_the_fingers_and_a_clear_one_stays(robot, hands):
    table = dextra_table(robot)
    before = thumb_gaps(table, hands)
    assert (before < -TOUCH).sum() > 10
    for hand, gap in zip(hands, before, strict=True):
        cleared = with_clear_thumb(table, hand)
        assert np.array_equal(cleared[2:], hand[2:])
        assert np.array_equal(cleared, hand) is bool(gap >= -TOUCH)
        assert thumb_gaps(table, cleared[None])[0] >= min(gap, 0.0) or gap >= -TOUCH
        assert thumb_gaps(table, cleared[None])[0] >= -TOUCH
