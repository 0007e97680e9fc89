# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import camera_take as take
import numpy as np
import pytest
from refusals import refused

from teo_skeleton_retriever.compat.compat_retriever import CompatRetriever, original_parameters_from
from teo_skeleton_retriever.detectors.detector import DetectionFrame
from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_skeleton_retriever.layouts.person_2d import Person2D
from teo_skeleton_retriever.layouts.skeleton_3d import KeypointStatus
from teo_skeleton_retriever.retriever_parameters import RetrieverParameters

WRIST = BODY_25.index["RWrist"]


def frame(time: float, *people: Person2D, scale: int = 1) -> DetectionFrame:
    return DetectionFrame(stamp=time, people=people, depth=take.depth(scale), camera=take.camera(scale))


def test_a_keypoint_is_one_pixel_of_the_skin_seen_by_a_centred_camera():
    (person,) = CompatRetriever(RetrieverParameters()).process(frame(0.0, take.person()))
    expected = [(130 - 159.5) / 300 * 1.5, (155 - 119.5) / 300 * 1.5, 1.5]
    np.testing.assert_allclose(person.body.points[WRIST], expected, atol=1e-6)
    assert person.body.status[WRIST] == KeypointStatus.MEASURED
    assert np.isnan(person.body.confidence[WRIST])
    assert not person.left_hand.status.any()
    assert person.is_signer
    assert person.body_frame is not None
    np.testing.assert_allclose(person.body_frame.rotation[:, 0], [0, 0, -1], atol=1e-6)  # faces the camera


def test_the_signer_can_be_locked():
    retriever = CompatRetriever(RetrieverParameters())
    people = (take.person(-28), take.person(28))
    two = retriever.process(frame(0.0, *people))
    other = next(person.track_id for person in two if not person.is_signer)
    retriever.lock_signer(other)
    assert [p.track_id for p in retriever.process(frame(0.1, *people)) if p.is_signer] == [other]
    retriever.lock_signer(None)


def test_another_camera_begins_anew():
    retriever = CompatRetriever(RetrieverParameters())
    retriever.process(frame(0.0, take.person()))
    (person,) = retriever.process(frame(0.1, take.person(scale=2.0), scale=2))
    assert person.body.points[WRIST, 2] == pytest.approx(1.5)


def test_the_shipped_configuration_can_be_given_by_its_own_names():
    got = original_parameters_from(
        [
            "skeleton::keys-acceptable-misses=10",
            "skeleton::tracking-threshold=200",
            "skeleton::time-to-live=3.0",
            "depth::kernel-size=8",
            "depth::iterations = 2",
            "depth::min-distance=0.6",
            "filtering::filter-keypoint-order=12",
            "filtering::optimize-limblength=false",
        ]
    )
    assert (got.keys_acceptable_misses, got.tracking_threshold, got.time_to_live) == (10, 200.0, 3.0)
    assert (got.filter_keypoint_order, got.optimize_limblength) == (12, False)
    assert got.depth_filter is not None
    assert original_parameters_from(["depth::enable=false"]).depth_filter is None


@pytest.mark.parametrize(
    ("code", "word"),
    [
        ("unknown_compat_option", "filter-keypoint-order=8"),  # the original ignores it without its group
        ("unknown_compat_option", "nonsense"),
        ("wrong_type", "filtering::filter-keypoint-order=many"),
        ("wrong_type", "depth::enable=perhaps"),
        ("out_of_range", "skeleton::time-to-live=-1"),
        ("out_of_range", "skeleton::time-to-live=nan"),
        ("out_of_range", "depth::kernel-size=0"),
        ("out_of_range", "depth::iterations=-1"),
        ("out_of_range", "depth::min-distance=nan"),
    ],
)
def test_what_is_no_option_is_refused(code, word):
    with refused(code):
        original_parameters_from([word])
