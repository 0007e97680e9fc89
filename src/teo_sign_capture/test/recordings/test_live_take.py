# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Sequence

import pytest
from made_bags import messages, signing
from refusals import refused
from teo_sign_msgs.msg import SkeletonArray

from teo_sign_capture.recordings.live_take import LiveState, LiveTake, Phase
from teo_sign_capture.recordings.skeleton_bag import stamp_of

STEP = 0.1  # [s]
DELAY = 0.2  # [s] from an image to its skeletons


def follow(take: LiveTake, arrays: Sequence[SkeletonArray], until: float) -> tuple[LiveState, float]:
    """Let time pass, messages arriving as they would; the last state, and when it was."""
    waiting, now = list(arrays), 0.0
    begins = stamp_of(arrays[0]) if arrays else 0.0
    state = take.step(now)
    while now < until and state.phase in (Phase.COUNTDOWN, Phase.SIGN):
        now += STEP
        while waiting and stamp_of(waiting[0]) - begins + DELAY <= now:
            take.add(waiting.pop(0), now)
        state = take.step(now)
    return state, now


def test_it_counts_down_then_waits_and_ends_when_the_hands_are_back() -> None:
    take = LiveTake(started=0.0, countdown=0.4)
    assert take.step(0.1) == LiveState(phase=Phase.COUNTDOWN, remaining=pytest.approx(0.3))
    state, now = follow(take, messages(signing(rate=15.0, duration=6.0)), until=9.0)
    assert state.phase is Phase.DONE
    # The hands are back at 2.4 s, and stay for half a second.
    assert 2.6 < now < 4.2
    assert take.step(now + 1.0).phase is Phase.DONE
    kept = len(take.messages)
    take.add(messages(signing(rate=15.0))[0], now + 1.0)
    assert len(take.messages) == kept


def test_of_a_long_countdown_only_the_end_is_kept() -> None:
    take = LiveTake(started=0.0, countdown=10.0)
    arrays = messages(signing(rate=15.0))
    take.add(arrays[0], 5.0)
    assert take.messages == []
    take.add(arrays[1], 9.5)
    assert take.messages == arrays[1:2]


def test_messages_that_come_late_or_twice_are_left_out() -> None:
    take = LiveTake(started=0.0, countdown=0.0)
    first, second, *_ = messages(signing(rate=15.0))
    for message in (second, first, second):
        take.add(message, 0.5)
    assert take.messages == [second]


def test_after_a_bounded_time_it_says_who_is_missing_does_not_move_or_does_not_return() -> None:
    empty = [SkeletonArray(header=message.header) for message in messages(signing(rate=15.0))]
    still = messages(signing(moves=[], rate=15.0, duration=4.0))
    up = messages(signing(moves=[(0.5, 1.1, (0.3, -0.1, 0.0))], rate=15.0, duration=6.0))
    never = ([], "no_skeletons"), (empty, "no_person"), (still, "no_motion"), (up, "no_motion")
    for arrays, code in never:
        state, now = follow(LiveTake(started=0.0, countdown=0.2, longest=3.0), arrays, until=20.0)
        assert state.phase is Phase.FAILED
        assert state.problem is not None
        assert state.problem.code == code
        assert now == pytest.approx(3.2, abs=2.0 * STEP)


@pytest.mark.parametrize("countdown", [-1.0, 31.0, float("nan"), float("inf")])
def test_a_countdown_that_is_none_is_refused(countdown: float) -> None:
    with refused("bad_countdown"):
        LiveTake(started=0.0, countdown=countdown)
