# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from made_bags import OUT, REST, SIGN, signing
from made_tracks import HANGING, Move, lose, make_track, path
from refusals import refused

from teo_description.robot import Robot
from teo_names import joint_limits
from teo_sign_capture.entries.take import Cut, SignTake, capture_take
from teo_sign_capture.tracks.skeleton_track import SkeletonTrack

FRAMES = 2.0 / 30.0


def test_the_stroke_is_cut_out_and_on_the_robot(robot: Robot, take: SignTake) -> None:
    assert take.span.start == pytest.approx(1.1, abs=FRAMES)
    assert take.span.end == pytest.approx(1.8, abs=FRAMES)
    assert take.motion.times[-1] == pytest.approx(take.span.duration, abs=1e-3)
    assert take.lost == 0.0
    assert take.smoothing < 0.008
    limits = joint_limits(take.motion.joints)
    assert (take.motion.positions >= limits.lower - 1e-6).all()
    assert (take.motion.positions <= limits.upper + 1e-6).all()
    # The hand goes forwards and down from the chin on the robot, too.
    postures = [
        dict(zip(take.motion.joints, row, strict=True)) for row in take.motion.positions[[0, -1]].tolist()
    ]
    first, last = (robot.placement(robot.configuration(one), "right_palm")[:3, 3] for one in postures)
    assert last[0] > first[0] + 0.02
    assert last[2] < first[2] - 0.06


def test_times_are_of_the_recording_where_a_part_of_it_is_looked_at(robot: Robot) -> None:
    later = [(start + 3.5, end + 3.5, place) for start, end, place in SIGN]
    track = signing(moves=[*SIGN, *later], duration=6.7)
    second = capture_take(robot, track, cut=Cut(start=3.2))
    assert second.span.start == pytest.approx(1.1 + 3.5, abs=FRAMES)
    assert second.track.times[0] == 0.0


@pytest.mark.parametrize(
    "cut", [Cut(start=-1.0), Cut(end=9.0), Cut(start=2.0, end=1.0), Cut(start=1.001, end=1.002)]
)
def test_a_cut_outside_the_recording_is_refused(robot: Robot, cut: Cut) -> None:
    with refused("outside_recording"):
        capture_take(robot, signing(), cut=cut)


@pytest.mark.parametrize("rate", [2.0, 10.0])
def test_too_few_frames_are_refused_with_how_many_there_are(robot: Robot, rate: float) -> None:
    with refused("few_frames", f"12 frames a second or more in the sign, got {rate:.0f}"):
        capture_take(robot, signing(rate=rate))


def test_a_hand_that_is_held_up_signs_in_a_part_of_the_recording_too(robot: Robot) -> None:
    """Nothing of the part tells a hand that is held up from one at rest; what is around it does."""
    times = np.arange(0.0, 3.2, 1.0 / 30.0)
    held = path(times, HANGING["left"], [(0.5, 1.1, (0.25, 0.30, 0.05)), (1.8, 2.4, HANGING["left"])])
    track = make_track(times, path(times, REST, SIGN), held, noise=0.004)
    assert capture_take(robot, track).span.handedness == "both"
    assert capture_take(robot, track, cut=Cut(start=1.1, end=1.8)).span.handedness == "both"


def test_the_end_that_was_chosen_is_kept_where_a_hand_is_held_low(robot: Robot) -> None:
    low = (0.30, -0.20, -0.36)
    moves: list[Move] = [(0.5, 1.0, OUT), (1.1, 1.4, low), (1.9, 2.3, REST)]
    span = capture_take(robot, signing(moves=moves), cut=Cut(start=1.0, end=1.9)).span
    assert (span.start, span.end) == (pytest.approx(1.0, abs=FRAMES), pytest.approx(1.9, abs=FRAMES))


def test_a_hand_that_is_lost_shortly_is_filled_in_and_said(robot: Robot) -> None:
    found = capture_take(robot, lose(signing(), "right_hand", 1.4, 1.5))
    (gap,) = found.gaps
    assert np.isfinite(found.track.right_hand.positions).all()
    assert gap.start == pytest.approx(1.4, abs=FRAMES)
    assert 0.1 < found.lost < 0.4


def test_a_hand_that_is_lost_for_long_is_refused_with_when(robot: Robot) -> None:
    with refused("hand_lost", r"right hand in view .* lost from 1\.3.* to 1\.7"):
        capture_take(robot, lose(lose(signing(), "right_hand", 1.2, 1.75), "body", 1.3, 1.7))
    with refused("hand_lost", r"lost from 1\.0"):
        capture_take(robot, lose(signing(noise=0.0), "right_hand", 0.0, 1.8))


@pytest.mark.parametrize("lost_from", [0.7, 1.25])
def test_a_hand_that_never_rises_into_the_signing_space_takes_no_part(robot: Robot, lost_from: float) -> None:
    """The left one goes from hanging onto the hip, below the picture, while the right one signs."""
    times = np.arange(0.0, 3.2, 1.0 / 15.0)

    def beside(*places: tuple[float, float, float]) -> SkeletonTrack:
        goes = [(0.5, 1.0, places[0]), (1.0, 1.9, places[-1]), (1.9, 2.4, HANGING["left"])]
        left = path(times, HANGING["left"], goes)
        track = make_track(times, path(times, REST, SIGN), left, noise=0.004)
        return lose(track, "left_hand", lost_from, 2.3)

    assert capture_take(robot, beside((0.16, 0.26, -0.36))).span.handedness == "right"
    with refused("hand_lost", "left hand in view"):
        capture_take(robot, beside((0.25, 0.26, -0.10), (0.30, 0.30, 0.15)))


def test_a_hand_too_near_to_its_shoulder_is_at_its_own_place_for_who_watches(robot: Robot) -> None:
    """TEO's elbow keeps it 46 cm off: straight before its place, not across the body nor at the face."""
    beside = (0.15, -0.30, 0.0)
    motion = capture_take(robot, signing(moves=[(0.5, 1.1, beside), (1.8, 2.4, REST)])).motion
    assert np.nanmax(motion.place_error[:, 0]) > 0.15
    assert np.nanmax(motion.seen_place_error[:, 0]) < 0.08  # a hand is 9 cm broad
    assert np.nanmean(motion.wrong_place[:, 0]) == 0.0
    assert np.nanmean(motion.same_zone[:, 0]) > 0.9
