# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest

from teo_sign_capture.tracks.skeleton_track import Keypoints, SkeletonTrack
from teo_signs.errors import LutError


def track(times, **changes):
    count = len(times)
    parts = {
        "body": Keypoints.lost(count, 25),
        "left_hand": Keypoints.lost(count, 21),
        "right_hand": Keypoints.lost(count, 21),
        "face": Keypoints.lost(count, 70),
    }
    fields = {"times": np.asarray(times, float), "source": "clip", "recorded": None} | parts | changes
    return SkeletonTrack(**fields)


def numbered(count, size):
    lost = Keypoints.lost(count, size)
    lost.positions[:] = np.arange(count)[:, None, None]
    return lost


def test_a_part_of_a_track_holds_both_ends_and_begins_at_zero():
    whole = track(np.arange(10) * 0.1, right_hand=numbered(10, 21), trunk=np.arange(30.0).reshape(10, 3))
    part = whole.between(0.3 - 1e-9, 0.6 + 1e-9)
    assert part.times == pytest.approx([0.0, 0.1, 0.2, 0.3])
    assert part.right_hand.positions[:, 0, 0] == pytest.approx([3, 4, 5, 6])
    assert part.trunk[:, 0] == pytest.approx([9, 12, 15, 18])
    assert part.hand("right") is part.right_hand
    assert part.hand("left") is part.left_hand


def test_a_part_without_frames_says_how_long_the_track_is():
    with pytest.raises(LutError, match=r"clip: .* 0\.90 s") as error:
        track(np.arange(10) * 0.1).between(2.0, 3.0)
    assert error.value.code == "empty_track"


def test_a_track_without_frames_is_refused():
    with pytest.raises(LutError) as error:
        track([])
    assert error.value.code == "empty_track"


@pytest.mark.parametrize("times", [(0.0, 0.1, 0.1), (0.0, 0.2, 0.1), (0.0, np.nan, 0.2), (np.inf,)])
def test_times_that_do_not_go_on_are_refused(times):
    with pytest.raises(LutError) as error:
        track(times)
    assert error.value.code == "bad_stamps"
