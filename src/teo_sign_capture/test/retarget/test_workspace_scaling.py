from __future__ import annotations

import numpy as np
import pytest
from robot_person import JOINTS, keypoints, track_of

from teo_description.robot import Robot
from teo_sign_capture.retarget.workspace_scaling import FarMap
from teo_sign_capture.signing_space.places import find_place
from teo_sign_capture.tracks.person import measure_person

REACH, SHOULDER, HEIGHT = 0.705, 0.347, 0.498
"""TEO's [m]."""
SIZES = [(1.0, 1.0, 1.0), (0.8, 0.5, 0.9), (1.1, 0.6, 1.2)]


@pytest.fixture(scope="module", params=SIZES, ids=str)
def person(request):
    points = keypoints(Robot.load(), JOINTS, np.zeros((2, len(JOINTS))))
    return measure_person(track_of(np.arange(2) / 30.0, [part * request.param for part in points]))


@pytest.fixture
def far(person):
    return FarMap(person, REACH, SHOULDER, HEIGHT)


def heights(far, values):
    return far(np.stack([np.zeros(len(values)), np.zeros(len(values)), values], axis=1))[:, 2]


def test_crown_shoulders_and_waist_keep_their_heights_and_hanging_hands_hang(far, person):
    crown = find_place("head_top").point[2] - HEIGHT
    found = heights(far, [person.places["head_top"][2], 0.0, -0.7 * person.trunk, -person.arm])
    assert found == pytest.approx([crown, 0.0, -0.7 * HEIGHT, -REACH], abs=1e-9)


def test_arms_stretched_out_stay_stretched_out(far, person):
    aside = person.shoulder + person.arm
    found = far(np.array([[person.arm, 0.0, 0.0], [0.0, -aside, 0.0], [0.0, aside, 0.0]]))
    assert found[0, 0] == pytest.approx(REACH)
    assert found[1:, 1] == pytest.approx([-SHOULDER - REACH, SHOULDER + REACH])


def test_higher_farther_and_more_aside_stay_so(far):
    steps = np.linspace(-1.5, 1.5, 301)
    for axis in range(3):
        moved = far(steps[:, None] * np.eye(3)[axis])[:, axis]
        assert (np.diff(moved) > 0.0).all()


def test_the_middle_stays_the_middle_and_both_sides_are_alike(far):
    points = np.random.default_rng(0).uniform(-0.6, 0.6, (50, 3))
    mirror = np.array([1.0, -1.0, 1.0])
    assert far(points * mirror) == pytest.approx(far(points) * mirror)
    assert far(points * (1.0, 0.0, 1.0))[:, 1] == pytest.approx(np.zeros(50))
