# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import bag_take
import pytest

from teo_skeleton_retriever.detectors import make_detector
from teo_skeleton_retriever.errors import RetrieverError, TopicError
from teo_skeleton_retriever.image_retriever import ImageRetriever
from teo_skeleton_retriever.layouts.skeleton_3d import KeypointStatus
from teo_skeleton_retriever.recording import RetrievalReport, retrieve_recording
from teo_skeleton_retriever.retriever import Retriever, RetrieverParameters

IMAGES = 10


def retrieve(bag: Path, keypoints: Path, **options: Any) -> RetrievalReport:
    """Retrieve with keypoints that are known, so that no network runs."""
    images = ImageRetriever(make_detector("replay", folder=str(keypoints)), Retriever(recorded=True))
    return retrieve_recording(bag, images, **options)


def test_a_recording_becomes_a_report_and_progress_counts_every_message(bag, keypoints):
    told: list[tuple[int, int]] = []
    report = retrieve(bag, keypoints, on_progress=lambda *progress: told.append(progress))
    assert told == [(i + 1, 3 * IMAGES) for i in range(3 * IMAGES)]
    assert (report.images, report.people, report.left_out, report.complaints) == (IMAGES, 1, {}, ())
    assert report.images_with_people == IMAGES
    assert report.topics.color == bag_take.COLOR
    assert report.statuses["body"][KeypointStatus.MEASURED] > 0
    assert report.own_time > 0.0


def test_images_that_are_refused_are_counted_with_the_reason(bag):
    class Refusing:
        def detect(self, *_):
            raise RetrieverError("bad_image", "expected another image")

        def close(self):
            pass

    report = retrieve_recording(bag, ImageRetriever(Refusing(), Retriever(RetrieverParameters())))
    assert (report.images, report.left_out) == (0, {"bad_image": IMAGES})
    assert report.reasons == {"bad_image": "expected another image"}
    refused, nothing = report.complaints
    assert refused == f"{IMAGES} images left out, bad_image: expected another image"
    assert nothing.startswith(f"no image of {bag_take.COLOR} could be used")


def test_people_whom_the_detector_has_no_place_for_are_told(bag, keypoints):
    class Crowded:
        people_left_out = 1

        def detect(self, *image):
            return detector.detect(*image)

    detector = make_detector("replay", folder=str(keypoints))
    report = retrieve_recording(bag, ImageRetriever(Crowded(), Retriever(RetrieverParameters())))
    assert (report.images, report.people_left_out) == (IMAGES, 1)
    (complaint,) = report.complaints
    assert complaint.startswith("1 more person is seen than the detector follows")


def test_a_missing_topic_is_named_by_the_argument_that_would_name_it(tmp_path, keypoints):
    stored = [one for one in bag_take.messages(IMAGES) if one[0] != bag_take.DEPTH]
    with pytest.raises(TopicError, match="expected a topic of depth") as caught:
        retrieve(bag_take.write_ros2(tmp_path / "no_depth", stored), keypoints)
    assert (caught.value.code, caught.value.argument) == ("no_depth", "depth_topic")


def test_several_topics_that_may_be_meant_are_refused_until_one_is_named(tmp_path, keypoints):
    stored = [(f"/{side}{topic}", *rest) for topic, *rest in bag_take.messages(IMAGES) for side in "ab"]
    bag = bag_take.write_ros2(tmp_path / "two", stored)
    with pytest.raises(TopicError, match=f"/a{bag_take.COLOR}, /b{bag_take.COLOR}") as caught:
        retrieve(bag, keypoints)
    assert (caught.value.code, caught.value.argument) == ("ambiguous_color", "color_topic")
    named = {
        "color": f"b{bag_take.COLOR}",
        "depth": f"/b{bag_take.DEPTH}",
        "camera_info": f"b{bag_take.INFO}",
    }
    report = retrieve(bag, keypoints, **{f"{what}_topic": name for what, name in named.items()})
    assert report.images == IMAGES
    assert [topic.lstrip("/") for topic in report.topics] == [name.lstrip("/") for name in named.values()]


def test_the_input_is_looked_at_before_the_detector_is_loaded(bag, tmp_path, monkeypatch):
    def load(*_):
        raise AssertionError("the detector was loaded")

    monkeypatch.setattr("teo_skeleton_retriever.recording.make_detector", load)
    with pytest.raises(RetrieverError, match="missing_bag"):
        retrieve_recording(tmp_path / "none.mcap")
    with pytest.raises(RetrieverError, match="unknown_topic"):
        retrieve_recording(bag, color_topic="/none")
    with pytest.raises(RetrieverError, match="bad_name"):
        retrieve_recording(bag, out=tmp_path / "x.bag")


def test_errors_pass_from_one_process_to_another():
    error = pickle.loads(pickle.dumps(TopicError("no_depth", "expected a topic", "depth_topic")))
    assert (type(error), error.code, error.sentence) == (TopicError, "no_depth", "expected a topic")
    assert error.argument == "depth_topic"
    assert str(pickle.loads(pickle.dumps(RetrieverError("bad_name", "other")))) == "bad_name: other"
