# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest

from teo_motion.neck_paths import GestureWindow, Leaning, hold_paths, nod_paths, shake_paths
from teo_motion.trajectory.joint_motion import JointMotion, motion_of
from teo_motion.trajectory.joint_motion import standing as stand
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.splice import Splicer

LIMITS = MotionLimits.of_robot()
PITCH = LIMITS.names.index("FrontalNeck")


def least_time(way: float) -> float:
    return float(LIMITS.least_times(np.array([way]), [PITCH])[0])


def standing(positions: dict[float, float], until: float = 20.0) -> JointMotion:
    """At each position [deg] from a time on [s]; it jumps from one to the next."""
    parts = [(time, stand(np.array(math.radians(position)))) for time, position in positions.items()]
    return motion_of(parts, until)


def window(
    begin: float,
    first: float,
    last: float,
    end: float,
    *,
    motion: JointMotion | None = None,
    joined: tuple[bool, bool] = (False, False),
) -> GestureWindow:
    return GestureWindow(
        begin=begin,
        first=first,
        last=last,
        end=end,
        comes_from_sign=joined[0],
        goes_on_into_sign=joined[1],
        motion=standing({0.0: 0.0}, 30.0) if motion is None else motion,
        least_time=least_time,
    )


def test_a_shake_without_room_for_both_sides_is_none() -> None:
    assert list(shake_paths(1.0, window(5.0, 5.2, 5.5, 6.5))) == []


@pytest.mark.parametrize("end", [6.0, 7.0, 7.5, 8.0, 8.5])
@pytest.mark.parametrize("behind", [-12.0, 12.0])
def test_a_shake_goes_on_into_a_sign_that_shakes(end: float, behind: float) -> None:
    motion = standing({0.0: 0.0, 10.0: behind})
    into = window(10.0 - end, 10.0 - end + 1.0, 10.0, 10.0, motion=motion, joined=(False, True))
    paths = list(shake_paths(1.0, into))
    assert paths
    for path in paths:
        assert path.begin >= 10.0 - end - 1e-9 and path.end == pytest.approx(10.0)
        assert math.copysign(1.0, path.points[-1].position) == -math.copysign(1.0, behind)


@pytest.mark.parametrize("before", [-12.0, 12.0])
@pytest.mark.parametrize("behind", [-12.0, 12.0])
@pytest.mark.parametrize("length", [1.5, 2.2, 2.9, 3.6])
def test_a_shake_between_two_signs_that_shake_alternates(before: float, behind: float, length: float) -> None:
    motion = standing({0.0: before, 5.0: 0.0, 5.0 + length: behind})
    between = window(5.0, 5.0, 5.0 + length, 5.0 + length, motion=motion, joined=(True, True))
    for path in shake_paths(1.0, between):
        turns = [before, *(math.degrees(point.position) for point in path.points), behind]
        assert all(one * other < 0.0 for one, other in pairwise(turns))
        assert (path.begin, path.end) == pytest.approx((5.0, 5.0 + length))


def test_a_position_is_kept_as_long_as_there_is_room() -> None:
    path = next(hold_paths(0.15, window(0.0, 5.0, 9.0, 20.0)))
    assert [(point.time, point.position) for point in path.points] == [(5.0, 0.15), (9.0, 0.15)]
    narrow = next(hold_paths(0.15, window(5.0, 5.0, 9.0, 9.0)))
    assert narrow.begin >= 5.0 - 1e-9 and narrow.end <= 9.0 + 1e-9
    assert list(hold_paths(0.15, window(5.0, 5.0, 5.9, 5.9))) == [], "not seen to be kept"


def test_a_nod_with_little_room_is_a_bow() -> None:
    paths = list(nod_paths(1.0, window(5.0, 5.0, 6.0, 6.0)))
    assert paths and all(len(path.points) == 1 for path in paths)
    assert all(path.begin >= 5.0 and path.end <= 6.0 for path in paths)


FORWARD = math.radians(9.0)


@pytest.fixture
def leaning() -> Leaning:
    return Leaning(Splicer(LIMITS.bounds.of([PITCH])), least_time)


@pytest.fixture
def motion() -> JointMotion:
    """A head that stands still for 20 s."""
    return standing({0.0: 0.0})


def degrees(motion: JointMotion, *times: float) -> list[float]:
    return np.degrees(motion.at(np.array(times))[0]).tolist()


def test_neighbours_without_time_for_the_way_between_are_turned_by_the_lesser(
    leaning: Leaning, motion: JointMotion
) -> None:
    kept, shifts = [(5.0, 6.0), (6.05, 9.0)], [math.radians(8.0), math.radians(2.0)]
    lean = leaning.leaned(motion, FORWARD, (5.0, 9.0), kept, shifts)
    assert lean is not None
    assert degrees(lean.motion, 5.0, 6.02, 9.0) == pytest.approx([2.0] * 3, abs=1e-6)


def test_a_sign_that_begins_with_the_motion_cannot_be_turned(leaning: Leaning, motion: JointMotion) -> None:
    assert leaning.leaned(motion, FORWARD, (0.0, 20.0), [(0.0, 20.0)], [FORWARD]) is None
    lean = leaning.leaned(motion, FORWARD, (0.0, 9.0), [(0.0, 2.0)], [FORWARD])
    assert lean is not None
    assert degrees(lean.motion, 0.0, 2.0, 5.0) == pytest.approx([0.0, 0.0, 9.0], abs=1e-6)


def test_without_time_there_is_no_lean(leaning: Leaning, motion: JointMotion) -> None:
    assert leaning.leaned(motion, FORWARD, (5.0, 5.2), [(0.0, 5.0), (5.2, 20.0)], [0.0, 0.0]) is None
