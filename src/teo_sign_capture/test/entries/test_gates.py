# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from made_bags import OUT, REST, signing
from made_tracks import lose, make_track, path
from refusals import refused

from teo_description.robot import Robot
from teo_sign_capture.entries.gates import RefusedError, accepted_standing, judge, objections
from teo_sign_capture.entries.sign_entry import Origin, make_sign
from teo_sign_capture.entries.take import Cut, SignTake, capture_take
from teo_sign_capture.tracks.skeleton_track import SkeletonTrack
from teo_signs.errors import LutError

GOOD = {
    "lost_percent": 20.0,
    "palm_error_p95_deg": 50.0,
    "contact_error_p95_mm": 50.0,
    "seen_place_error_p95_mm": 125.0,
    "major_place_wrong": 0.3,
    "stretch_times": 6.0,
}
ORIGIN = Origin(source="made, sha256 0123456789abcdef", standing="recorded", licence="Apache-2.0")


def test_a_sign_at_every_limit_is_taken() -> None:
    assert objections(judge(GOOD, duration=0.25, has_rest=True)) == ()


@pytest.mark.parametrize(
    ("figure", "value", "code", "accepted", "never"),
    [
        ("lost_percent", 21.0, "much_lost", 50.0, 51.0),
        ("palm_error_p95_deg", 51.0, "palm_off", 90.0, 91.0),
        ("contact_error_p95_mm", 51.0, "contact_off", 125.0, 126.0),
        ("seen_place_error_p95_mm", 125.8, "place_off", 200.0, 201.0),
        ("major_place_wrong", 0.31, "wrong_place", 0.7, 0.71),
        ("stretch_times", 6.1, "too_slow", 10.0, 10.1),
    ],
)
def test_beyond_a_limit_a_sign_is_refused_near_it_a_person_decides_and_far_beyond_it_nobody(
    figure: str, value: float, code: str, accepted: float, never: float
) -> None:
    (found,) = objections(judge(GOOD | {figure: value}, duration=1.0, has_rest=True))
    assert (found.code, found.got, found.bound) == (code, value, GOOD[figure])
    assert f"{value:g}" in found.message
    assert f"{GOOD[figure]:g}" in found.message
    assert found.remedy
    near = judge(GOOD | {figure: accepted}, duration=1.0, has_rest=True)
    with refused(code, "--accept takes it as it is"):
        accepted_standing("X", "recorded", near, accept=False)
    assert accepted_standing("X", "recorded", near, accept=True) == "measured"
    # What a person may accept comes first among the gates, but does not give the reason.
    far = judge(GOOD | {"lost_percent": 21.0, figure: never}, duration=1.0, has_rest=True)
    for accept in (False, True):
        with refused(code, "--accept does not take it either"):
            accepted_standing("X", "recorded", far, accept=accept)


def test_an_objection_names_the_second_of_the_recording_at_which_it_is_worst(
    robot: Robot, take: SignTake
) -> None:
    turned = np.full(take.motion.palm_error.shape, [0.2, np.nan])
    turned[3:6, 0] = np.radians([70.0, 80.0, 70.0])
    with pytest.raises(RefusedError) as caught:
        make_sign(robot, "SIGNO", [replace(take, motion=replace(take.motion, palm_error=turned))], ORIGIN)
    (found,) = objections(caught.value.verdicts)
    assert found.at == pytest.approx(take.span.start + take.motion.times[4])
    assert f"worst at {found.at:.2f} s" in str(caught.value)


def test_what_is_too_fast_is_named_by_its_moment(robot: Robot) -> None:
    """Fingers that flutter for a third of a second in a hand that moves slowly."""
    times = np.arange(0.0, 4.2, 1.0 / 30.0)
    wrist = path(times, REST, [(0.5, 1.1, OUT), (1.2, 2.9, (0.40, -0.25, -0.02)), (3.0, 3.6, REST)])
    beats = 0.5 - 0.5 * np.cos(2.0 * np.pi * 6.0 * (times - 2.0))
    track = make_track(times, wrist, bend=np.where((times > 2.0) & (times < 2.34), beats, 0.0), noise=0.002)
    verdicts = make_sign(robot, "SIGNO", [capture_take(robot, track)], ORIGIN, accept=True).verdicts
    (slow,) = (verdict for verdict in verdicts if verdict.code == "too_slow")
    assert slow.at == pytest.approx(2.17, abs=0.3)


def test_half_of_a_beat_is_accepted_by_nobody() -> None:
    with refused("too_short", "does not take it either"):
        accepted_standing("X", "recorded", judge({}, duration=0.1, has_rest=True), accept=True)


def test_everything_that_speaks_against_a_sign_is_said_at_once() -> None:
    against = judge({"palm_error_p95_deg": 62.0, "lost_percent": 44.0}, duration=0.13, has_rest=False)
    assert {found.code for found in objections(against)} == {"much_lost", "palm_off", "too_short", "no_rest"}
    with refused("much_lost") as caught:
        accepted_standing("X", "recorded", against, accept=False)
    assert all(words in str(caught.value) for words in ("44", "62", "0.13", "--accept"))


@pytest.mark.parametrize(
    ("standing", "after"),
    [
        ("recorded", "measured"),
        ("measured", "described"),
        ("described", "sketched"),
        ("sketched", "sketched"),
    ],
)
def test_accepting_costs_one_level_of_evidence(standing: str, after: str) -> None:
    against = judge({}, duration=0.2, has_rest=True)
    assert accepted_standing("X", standing, against, accept=True) == after  # type: ignore[arg-type]


def test_a_good_sign_keeps_its_evidence_where_any_would_be_accepted(robot: Robot, take: SignTake) -> None:
    sign = make_sign(robot, "SIGNO", [take], ORIGIN, accept=True).sign
    assert sign.provenance.standing == "recorded"
    assert "Accepted" not in sign.provenance.notes


def test_a_contact_is_judged_where_the_hand_is_on_the_body_alone(robot: Robot, take: SignTake) -> None:
    frames = len(take.motion.times)
    touching = np.zeros((frames, 2))
    touching[: frames // 2] = 1.0
    off = np.full((frames, 2), 0.2)
    off[: frames // 2] = 0.02
    near = replace(take, motion=replace(take.motion, contact=touching, seen_place_error=off))
    sign = make_sign(robot, "SIGNO", [near], ORIGIN, accept=True).sign
    assert sign.quality["contact_error_p95_mm"] == pytest.approx(20.0)
    assert sign.quality["seen_place_error_p95_mm"] == pytest.approx(200.0)
    swapped = replace(take, motion=replace(take.motion, contact=1.0 - touching, seen_place_error=off))
    with pytest.raises(LutError, match="200 mm"):
        make_sign(robot, "SIGNO", [swapped], ORIGIN)


def test_a_recording_without_rest_is_taken_where_somebody_says_where_the_sign_is(robot: Robot) -> None:
    # Between two places before the body: the recording begins and ends within the sign.
    moves = [(-1.0, -0.5, OUT), (0.3, 0.9, (0.28, -0.06, 0.02)), (1.1, 1.7, OUT)]
    track = signing(moves=moves, duration=2.0, rate=15.0)
    assert capture_take(robot, track, handedness="right", cut=Cut(start=0.0, end=1.9)).has_rest


def at_the_nape() -> SkeletonTrack:
    """A hand on the back of the head, where no arm of TEO's goes."""
    return signing(moves=[(0.5, 1.1, (-0.13, -0.05, 0.22)), (1.8, 2.4, REST)], rate=15.0)


@pytest.mark.parametrize(
    ("made", "codes"),
    [
        (lambda: lose(signing(rate=15.0), "right_hand", 1.2, 1.75), {"much_lost"}),
        (at_the_nape, {"palm_off", "contact_off", "wrong_place"}),
    ],
)
def test_a_take_that_is_no_good_is_refused_for_what_is_wrong_with_it(
    robot: Robot, made: Callable[[], SkeletonTrack], codes: set[str]
) -> None:
    with pytest.raises(RefusedError) as caught:
        make_sign(robot, "SIGNO", [capture_take(robot, made())], ORIGIN)
    assert {verdict.code for verdict in objections(caught.value.verdicts)} == codes
