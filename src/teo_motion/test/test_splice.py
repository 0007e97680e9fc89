# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from teo_motion.trajectory.joint_motion import JointMotion, motion_of, standing, take
from teo_motion.trajectory.ruckig_segment import Bounds, RuckigSolver, State
from teo_motion.trajectory.splice import Splicer, StandPoint, position_at, shifted

BOUNDS = Bounds(*(np.array([limit]) for limit in (-0.5, 0.5, 0.87, 6.5, 105.0)))


def there_and_back(angle: float = 0.3) -> JointMotion:
    """At 0 for 1 s, to an angle in 1 s, there for 1 s, back in 1 s, and 1 s more at 0."""
    ends = [State.still(np.array([turn])) for turn in (0.0, angle, 0.0)]
    parts = [(2.0 * index, standing(end.position[0])) for index, end in enumerate(ends)]
    for start, (first, second) in zip((1.0, 3.0), pairwise(ends), strict=True):
        segment = RuckigSolver(1).segment(first, second, BOUNDS, duration=1.0)
        assert segment is not None
        parts.append((start, take(segment.pieces, 0)))
    return motion_of(sorted(parts, key=lambda part: part[0]), 5.0)


def jumps(motion: JointMotion) -> float:
    """The most by which position, velocity or acceleration differ where two pieces meet."""
    pieces = motion.pieces
    begins = (pieces.positions, pieces.velocities, pieces.accelerations)
    ends = pieces.after(pieces.lengths)
    return max(float(np.abs(end[:-1] - begin[1:]).max()) for end, begin in zip(ends, begins, strict=True))


@settings(max_examples=60)
@given(
    begin=st.floats(0.0, 3.0),
    length=st.floats(1.5, 2.0),
    position=st.floats(-0.2, 0.2),
)
def test_another_way_is_left_and_met_smoothly(begin: float, length: float, position: float) -> None:
    motion = there_and_back()
    end = begin + length
    point = StandPoint((begin + end) / 2.0, position)
    changed = Splicer(BOUNDS).spliced(motion, begin, [point], end)
    if changed is None:  # the joint may have too far to go
        assert abs(position - 0.3) > 0.3
        return
    assert jumps(changed) < 1e-6
    assert changed.duration == motion.duration
    at, speed, _ = changed.at(np.array([point.time]))
    assert at[0] == pytest.approx(position, abs=1e-6) and speed[0] == pytest.approx(0.0, abs=1e-6)
    outside = np.linspace(0.0, 5.0, 501)
    outside = outside[(outside < begin) | (outside > end)]
    np.testing.assert_allclose(changed.at(outside)[0], motion.at(outside)[0], atol=1e-6)
    reached = changed.extremes()
    assert reached.velocity <= 0.87 * (1.0 + 1e-8)
    assert reached.acceleration <= 6.5 * (1.0 + 1e-8) and reached.jerk <= 105.0 * (1.0 + 1e-8)


def test_a_way_that_the_joint_cannot_make_is_none() -> None:
    splicer, motion = Splicer(BOUNDS), there_and_back()
    assert splicer.spliced(motion, 2.2, [StandPoint(2.3, -0.3)], 2.9) is None, "too fast"
    assert splicer.spliced(motion, 2.0, [StandPoint(2.5, 0.6)], 3.0) is None, "outside the limits"


def test_a_turned_part_jumps_at_its_ends_and_a_splice_bridges_that() -> None:
    motion = shifted(there_and_back(), 2.0, 3.0, 0.1)
    assert position_at(motion, 2.0, side="left") == pytest.approx(0.3)
    assert position_at(motion, 2.0, side="right") == pytest.approx(0.4)
    assert motion.at(np.array([2.5]))[0][0] == pytest.approx(0.4)
    splicer = Splicer(BOUNDS)
    bridged = splicer.spliced(motion, 1.0, [], 2.0)
    bridged = bridged and splicer.spliced(bridged, 3.0, [], 4.0)
    assert bridged is not None and jumps(bridged) < 1e-6
    assert bridged.extremes().greatest == pytest.approx(0.4, abs=1e-6)
