# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest

from teo_skeleton_retriever.detectors.mediapipe.calibration import (
    body_sigma,
    elbow_error,
    extra_hand_sigma,
)
from teo_skeleton_retriever.layouts.layout import BODY_25

ROW = BODY_25.index


def at(confidence: float) -> np.ndarray:
    return body_sigma(np.full(25, 0.012), np.full(25, confidence))


ACROSS, POINTED = 1.0, 0.4  # parts of a forearm's length that are seen


@pytest.mark.parametrize("forearm", [ACROSS, POINTED])
def test_an_elbow_is_farther_off_the_less_the_detector_is_sure_of_it(forearm: float) -> None:
    confidences = (1.0, 0.999, 0.99, 0.98, 0.95, 0.9, 0.5, 0.0)
    sigmas = [elbow_error(confidence, forearm).sigma for confidence in confidences]
    assert sigmas == sorted(sigmas)
    assert sigmas[0] == pytest.approx(0.02)
    assert sigmas[-1] < 0.12


@pytest.mark.parametrize("confidence", [0.99, 0.96, 0.9])
def test_an_elbow_behind_a_forearm_that_points_at_the_camera_is_a_guess(confidence: float) -> None:
    assert elbow_error(confidence, POINTED).sigma > 1.5 * elbow_error(confidence, ACROSS).sigma
    between = elbow_error(confidence, 0.75).sigma
    assert elbow_error(confidence, ACROSS).sigma < between < elbow_error(confidence, POINTED).sigma


def test_only_an_elbow_whose_forearm_points_at_the_camera_is_seen_too_near_to_the_shoulder() -> None:
    short = [elbow_error(confidence, POINTED).short for confidence in (1.0, 0.99, 0.97, 0.9, 0.0)]
    assert short == sorted(short)
    assert short[0] == 0.0
    assert 0.04 < short[-1] < 0.06
    assert elbow_error(0.9, ACROSS).short == 0.0


def test_left_and_right_are_alike_and_shoulders_are_as_they_were() -> None:
    told = at(0.95)
    assert told[ROW["RWrist"]] == told[ROW["LWrist"]]
    assert told[ROW["RShoulder"]] == 0.012


def test_a_keypoint_that_is_absent_has_a_finite_sigma() -> None:
    assert np.isfinite(at(0.0)).all()


def test_a_hand_is_doubted_the_more_the_less_it_seems_to_be_there_and_not_in_plain_view() -> None:
    doubts = extra_hand_sigma(np.array([1.0, 0.98, 0.9, 0.8, 0.6, 0.0]))
    assert (np.diff(doubts) >= 0.0).all()
    assert doubts[0] == doubts[1] == 0.0
    assert 0.01 < doubts[-1] < 0.03
