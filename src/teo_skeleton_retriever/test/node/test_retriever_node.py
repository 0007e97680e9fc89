# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Any

import camera_take as take
import numpy as np
import pytest
from rclpy.parameter import Parameter
from refusals import refused
from sensor_msgs.msg import Image
from teo_sign_msgs.srv import LockSigner
from visualization_msgs.msg import MarkerArray

from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_skeleton_retriever.node.node_parameters import PARAMETERS
from teo_skeleton_retriever.node.retriever_node import RetrieverNode


def test_a_person_is_published_in_the_cameras_frame_with_the_stamp_of_the_image(start):
    bench = start(take.person())
    bench.send_until(bench.followed)
    message = bench.arrays[-1]
    assert message.header.frame_id == take.FRAME_ID
    nanoseconds = message.header.stamp.sec * 10**9 + message.header.stamp.nanosec - take.START
    assert nanoseconds % take.PERIOD == 0
    (skeleton,) = message.skeletons
    assert skeleton.is_signer
    wrist = skeleton.body[BODY_25.index["RWrist"]]
    # Where the pixel and the depth put it; the joint lies behind the skin, by less than a decimetre.
    x, y = (130 - take.camera().cx) / take.FOCAL, (155 - take.camera().cy) / take.FOCAL
    assert 0.0 <= wrist.position.z - take.DISTANCE < 0.1
    np.testing.assert_allclose([wrist.position.x, wrist.position.y], [x * 1.5, y * 1.5], atol=0.03)
    assert 0.0 < wrist.sigma[2] < 0.2


def test_an_empty_scene_gives_an_empty_array_for_each_image(start):
    bench = start()
    bench.send_until(lambda: len(bench.arrays) > 3)
    assert all(not message.skeletons for message in bench.arrays)
    bench.until(lambda: bench.said("people") == "0" and int(bench.said("results")) > 3)
    assert (bench.said("depth known [%]"), bench.said("median depth [m]")) == ("100", "3.00")


@pytest.mark.parametrize(
    "options",
    [
        {"publishes_compressed": True},
        {"color_transport": "compressed", "depth_transport": "compressedDepth"},
    ],
    ids=["found by itself", "named"],
)
def test_what_is_published_compressed_alone_is_followed(start, options):
    bench = start(take.person(), **options)
    bench.send_until(bench.followed, color=take.compressed_color, depth=take.compressed_depth)


def test_the_signer_can_be_locked_to_a_person_and_let_go(start):
    bench = start(take.person(-25), take.person(30))
    bench.until(bench.lock.service_is_ready)
    bench.send_until(lambda: bench.arrays and len(bench.arrays[-1].skeletons) == 2)
    other = next(s.id for s in bench.arrays[-1].skeletons if not s.is_signer)

    def ask(wanted: int) -> Any:
        answer = bench.lock.call_async(LockSigner.Request(id=wanted))
        bench.until(answer.done)
        return answer.result()

    assert ask(other).success
    bench.send_until(lambda: [s.id for s in bench.arrays[-1].skeletons if s.is_signer] == [other])
    refused = ask(77)
    assert (refused.success, refused.code) == (False, "unknown_id")
    assert ask(LockSigner.Request.NOBODY).success


def test_markers_and_the_overlay_are_made_for_those_who_listen(start):
    bench = start(take.person())
    bench.send_until(bench.followed)
    markers: list[MarkerArray] = []
    pictures: list[Image] = []
    bench.client.create_subscription(MarkerArray, "skeleton_markers", markers.append, 10)
    bench.client.create_subscription(Image, "overlay/image", pictures.append, 10)
    bench.send_until(lambda: markers and pictures)
    picture = pictures[-1]
    assert (picture.width, picture.height, picture.encoding) == (take.WIDTH, take.HEIGHT, "rgb8")
    assert len(picture.data) == take.WIDTH * take.HEIGHT * 3
    assert np.frombuffer(picture.data, np.uint8).tobytes() != take.color().tobytes()
    assert {marker.header.frame_id for marker in markers[-1].markers} == {take.FRAME_ID}


def test_the_originals_processing_can_be_asked_for(start):
    bench = start(take.person(), compat="skeleton_retriever")
    bench.send_until(bench.followed)
    wrist = bench.arrays[-1].skeletons[0].body[BODY_25.index["RWrist"]]
    assert wrist.position.z == pytest.approx(take.DISTANCE, abs=1e-6)  # the skin, as the original has it
    assert math.isnan(wrist.sigma[0])


def test_images_between_periods_are_left_out(start):
    bench = start(take.person(), period=0.1)
    bench.send_until(lambda: len(bench.arrays) > 3)
    stamps = np.array([m.header.stamp.sec + m.header.stamp.nanosec * 1e-9 for m in bench.arrays])
    assert np.diff(stamps).min() >= 0.1 - 1e-6


def test_every_parameter_has_a_description_and_a_range_and_wrong_values_are_refused(start):
    bench = start()
    for row in PARAMETERS:
        descriptor = bench.node.describe_parameter(row.name)
        assert descriptor.description
        value = bench.node.get_parameter(row.name).value
        assert (tuple(value) if isinstance(value, list) else value) == row.default
        if isinstance(row.default, float) or type(row.default) is int:
            assert len(descriptor.integer_range) + len(descriptor.floating_point_range) == 1

    def set_to(name: str, value: Any) -> bool:
        return bool(bench.node.set_parameters([Parameter(name, value=value)])[0].successful)

    assert not set_to("slop", 0.1)  # read-only
    assert not set_to("signer_rule", "tallest")
    assert not set_to("min_confidence", 1.5)
    assert not set_to("max_depth", 0.2)  # not above min_depth
    assert set_to("signer_rule", "central")
    assert set_to("period", 0.05)


@pytest.mark.parametrize(
    ("name", "value", "code"),
    [
        ("compat", "other", "unknown_choice"),
        ("detector", "guess", "unknown_choice"),
        ("detector_options", ["folder"], "bad_option"),
        ("detector_options", ["=x"], "bad_option"),
    ],
)
def test_a_wrong_parameter_stops_the_start_with_its_reason(context, name, value, code):
    with refused(code):
        RetrieverNode(context=context, parameter_overrides=[Parameter(name, value=value)])
