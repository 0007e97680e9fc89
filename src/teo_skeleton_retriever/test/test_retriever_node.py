from __future__ import annotations

import itertools
import math
import time
from collections.abc import Callable, Iterator
from typing import Any

import camera_take as take
import numpy as np
import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import CameraInfo, CompressedImage, Image
from teo_sign_msgs.msg import Keypoint3D, Skeleton3D, SkeletonArray
from teo_sign_msgs.srv import LockSigner
from visualization_msgs.msg import MarkerArray

from teo_skeleton_retriever.body_25 import BODY_25
from teo_skeleton_retriever.detectors import make_detector
from teo_skeleton_retriever.errors import DetectorError, ParameterError
from teo_skeleton_retriever.parameters import PARAMETERS
from teo_skeleton_retriever.person_2d import Person2D
from teo_skeleton_retriever.retriever_node import RetrieverNode

PATIENCE = 20.0  # [s]; a busy machine is slow, not wrong
IMAGES = 400  # of which the detector knows the keypoints


def replay(*people: Person2D, begin: int = 0) -> Any:
    """A detector that sees these people in every image from a number on."""
    stamps = [(take.START + i * take.PERIOD) * 1e-9 for i in range(IMAGES)]
    return make_detector(
        "replay", frames=[(stamp, people if i >= begin else ()) for i, stamp in enumerate(stamps)]
    )


class Bench:
    """The node and a camera driver that hears everything, in one process and a DDS domain of their own."""

    def __init__(
        self, context: Any, detector: Any, *, publishes_compressed: bool = False, **parameters: Any
    ) -> None:
        overrides = [Parameter(name, value=value) for name, value in parameters.items()]
        self.node = RetrieverNode(detector=detector, context=context, parameter_overrides=overrides)
        self.client = rclpy.create_node("client", context=context)
        self.executor = SingleThreadedExecutor(context=context)
        self.executor.add_node(self.node)
        self.executor.add_node(self.client)
        self.arrays: list[SkeletonArray] = []
        self.diagnostics: list[DiagnosticArray] = []
        self.client.create_subscription(SkeletonArray, "skeletons", self.arrays.append, 100)
        self.client.create_subscription(DiagnosticArray, "diagnostics", self.diagnostics.append, 10)
        sensor = QoSProfile(depth=5, reliability=ReliabilityPolicy.RELIABLE)
        base = ("camera/color/image_raw", "camera/aligned_depth_to_color/image_raw")
        kinds = (Image, Image)
        if publishes_compressed or parameters.get("color_transport") == "compressed":
            base, kinds = (f"{base[0]}/compressed", base[1]), (CompressedImage, kinds[1])
        if publishes_compressed or parameters.get("depth_transport") == "compressedDepth":
            base, kinds = (base[0], f"{base[1]}/compressedDepth"), (kinds[0], CompressedImage)
        self.color = self.client.create_publisher(kinds[0], base[0], sensor)
        self.depth = self.client.create_publisher(kinds[1], base[1], sensor)
        self.info = self.client.create_publisher(CameraInfo, "camera/color/camera_info", sensor)
        self.lock = self.client.create_client(LockSigner, "lock_signer")
        self.numbers = itertools.count()
        publishers = (self.color, self.depth, self.info)
        self.until(lambda: all(p.get_subscription_count() for p in publishers))
        self.until(lambda: self.node._skeletons.get_subscription_count())

    def until(self, condition: Callable[[], object], doing: Callable[[], object] = lambda: None) -> None:
        deadline = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < deadline, self.told()
            doing()
            # As many callbacks as one image brings; a camera does not outrun its listeners either.
            for _ in range(8):
                self.executor.spin_once(timeout_sec=0.005)

    def told(self) -> str:
        last = self.diagnostics[-1].status[0] if self.diagnostics else None
        return f"it did not happen in time; the node says: {last}"

    def stamp(self) -> int:
        return take.START + next(self.numbers) * take.PERIOD

    def send(
        self,
        color: Callable[..., Any] = take.color_message,
        depth: Callable[..., Any] = take.depth_message,
        info: Callable[..., Any] | None = take.camera_info,
    ) -> None:
        """Publish what a camera sees at one time."""
        stamp = self.stamp()
        if info is not None:
            self.info.publish(info(stamp))
        self.color.publish(color(stamp))
        self.depth.publish(depth(stamp))

    def send_until(self, condition: Callable[[], object], **images: Any) -> None:
        self.until(condition, doing=lambda: self.send(**images))

    def said(self, key: str) -> str:
        values = self.diagnostics[-1].status[0].values if self.diagnostics else []
        return {pair.key: pair.value for pair in values}.get(key, "0")

    @property
    def summary(self) -> str:
        return str(self.diagnostics[-1].status[0].message) if self.diagnostics else ""

    def followed(self) -> bool:
        return bool(self.arrays and self.arrays[-1].skeletons)

    def recovers(self) -> bool:
        """Good images are followed again, whatever there was before."""
        self.arrays.clear()
        self.send_until(self.followed)
        return True

    def close(self) -> None:
        self.executor.shutdown()
        self.client.destroy_node()
        self.node.destroy_node()


@pytest.fixture
def context(domain_id: int) -> Iterator[Any]:
    context = rclpy.Context()
    rclpy.init(context=context, domain_id=domain_id)
    yield context
    rclpy.try_shutdown(context=context)


@pytest.fixture
def start(context: Any) -> Iterator[Callable[..., Bench]]:
    benches: list[Bench] = []

    def run(*people: Person2D, begin: int = 0, **parameters: Any) -> Bench:
        benches.append(Bench(context, replay(*people, begin=begin), **parameters))
        return benches[-1]

    yield run
    for bench in benches:
        bench.close()


def test_a_person_is_published_in_the_cameras_frame_with_the_stamp_of_the_image(start):
    bench = start(take.person())
    bench.send_until(bench.followed)
    message = bench.arrays[-1]
    assert message.header.frame_id == take.FRAME_ID
    nanoseconds = message.header.stamp.sec * 10**9 + message.header.stamp.nanosec - take.START
    assert nanoseconds % take.PERIOD == 0
    (skeleton,) = message.skeletons
    assert skeleton.is_signer
    assert [keypoint.name for keypoint in skeleton.body] == list(BODY_25.keypoints)
    wrist = skeleton.body[BODY_25.index["RWrist"]]
    assert wrist.status != Keypoint3D.STATUS_LOST
    # Where the pixel and the depth put it; the joint lies behind the skin, by less than a decimetre.
    x, y = (130 - take.camera().cx) / take.FOCAL, (155 - take.camera().cy) / take.FOCAL
    assert 0.0 <= wrist.position.z - take.DISTANCE < 0.1
    np.testing.assert_allclose([wrist.position.x, wrist.position.y], [x * 1.5, y * 1.5], atol=0.03)
    np.testing.assert_allclose(wrist.pixel, [130, 155], atol=1e-3)
    assert wrist.confidence == pytest.approx(0.9)
    assert 0.0 < wrist.sigma[2] < 0.2
    ankle = skeleton.body[BODY_25.index["RAnkle"]]
    assert ankle.status == Keypoint3D.STATUS_LOST
    assert math.isnan(ankle.position.x)
    assert skeleton.left_hand == []


def test_an_empty_scene_gives_an_empty_array_for_each_image(start):
    bench = start()
    bench.send_until(lambda: len(bench.arrays) > 3)
    assert all(not message.skeletons for message in bench.arrays)
    bench.until(lambda: bench.said("people") == "0" and int(bench.said("results")) > 3)


def test_ten_people_are_ten_skeletons_with_one_signer(start):
    bench = start(*(take.person(shift) for shift in range(-110, 140, 25)))
    flat = np.full((take.HEIGHT, take.WIDTH), 2000, dtype=np.uint16)
    bench.send_until(
        lambda: bench.arrays and len(bench.arrays[-1].skeletons) == 10,
        depth=lambda s: take.image_message(flat, "16UC1", s),
    )
    people = bench.arrays[-1].skeletons
    assert [person.id for person in people] == sorted({person.id for person in people})
    assert sum(person.is_signer for person in people) == 1


def test_half_a_person_is_followed_as_far_as_it_is_seen(start):
    body = take.person().body.copy()
    body[8:15] = 0.0  # what is below the table
    bench = start(Person2D(body=body))
    bench.send_until(bench.followed)
    (person,) = bench.arrays[-1].skeletons
    assert person.body[BODY_25.index["MidHip"]].status == Keypoint3D.STATUS_LOST
    assert person.body_frame_origin == Skeleton3D.BODY_FRAME_SHOULDERS


def test_who_leaves_and_returns_is_the_same_person(context):
    stamps = [(take.START + i * take.PERIOD) * 1e-9 for i in range(IMAGES)]
    gone = range(20, 60)  # for 1.3 s
    frames = [(s, () if i in gone else (take.person(),)) for i, s in enumerate(stamps)]
    bench = Bench(context, make_detector("replay", frames=frames))
    try:
        bench.send_until(bench.followed)
        before = bench.arrays[-1].skeletons[0].id
        bench.send_until(lambda: not bench.arrays[-1].skeletons)
        assert bench.recovers()
        assert bench.arrays[-1].skeletons[0].id == before
    finally:
        bench.close()


def test_compressed_colour_and_depth_are_followed(start):
    bench = start(take.person(), color_transport="compressed", depth_transport="compressedDepth")
    bench.send_until(bench.followed, color=take.compressed_color, depth=take.compressed_depth)


def test_what_is_published_compressed_alone_is_found_by_itself(start):
    bench = start(take.person(), publishes_compressed=True)
    bench.send_until(bench.followed, color=take.compressed_color, depth=take.compressed_depth)


def test_images_wait_for_camera_info_and_are_followed_once_it_comes(start):
    bench = start(take.person())
    bench.send_until(lambda: bench.summary.startswith("no_camera_info"), info=None)
    assert bench.diagnostics[-1].status[0].level == b"\x01"
    assert "/camera/color/camera_info" in bench.summary
    assert not bench.arrays
    assert bench.recovers()
    bench.send_until(lambda: bench.diagnostics[-1].status[0].level == b"\x00")


@pytest.mark.parametrize(
    ("code", "images"),
    [
        ("camera_info_size", {"info": lambda s: take.camera_info(s, scale=2)}),
        ("no_focal_length", {"info": lambda s: take.camera_info(s, k=[0.0] * 9)}),
        ("depth_size", {"depth": lambda s: take.depth_message(s, scale=2)}),
        ("wrong_encoding", {"color": lambda s: take.color_message(s, encoding="bayer_rggb16")}),
        ("wrong_encoding", {"depth": lambda s: take.depth_message(s, encoding="rgb8")}),
        ("wrong_length", {"color": lambda s: take.color_message(s, data=take.color_message(s).data[:1000])}),
        ("wrong_length", {"depth": lambda s: take.depth_message(s, data=take.depth_message(s).data[:-1])}),
        ("bad_size", {"color": lambda s: take.color_message(s, width=0, height=0)}),
    ],
)
def test_what_cannot_be_used_is_told_and_good_images_are_followed_again(start, code, images):
    bench = start(take.person())
    bench.send_until(lambda: bench.summary.startswith(code), **images)
    assert int(bench.said(f"dropped {code}")) >= 1
    assert bench.diagnostics[-1].status[0].level == b"\x01"
    assert bench.recovers()


def test_depth_without_a_single_value_is_told_and_recovered_from(start):
    bench = start(take.person())
    nothing = np.zeros((take.HEIGHT, take.WIDTH), dtype=np.uint16)
    nan = np.full((take.HEIGHT, take.WIDTH), np.nan, dtype=np.float32)
    for pixels, encoding in ((nothing, "16UC1"), (nan, "32FC1")):
        bench.send_until(
            lambda: bench.summary.startswith("no_depth_measured"),
            depth=lambda s, p=pixels, e=encoding: take.image_message(p, e, s),
        )
        assert bench.arrays
        assert bench.recovers()


def test_the_resolution_may_change_in_mid_stream(context):
    class Scaling:
        """Sees the person at the size of the image, as a real detector does."""

        name = "scaling"
        images_at_once = 1

        def detect(self, image: np.ndarray, stamp: float) -> tuple[Person2D, ...]:
            del stamp
            return (take.person(scale=image.shape[1] / take.WIDTH),)

        def close(self) -> None:
            pass

    bench = Bench(context, Scaling())
    try:
        bench.send_until(bench.followed)
        before = bench.arrays[-1].skeletons[0]
        bench.arrays.clear()
        large = {
            "color": lambda s: take.color_message(s, scale=2),
            "depth": lambda s: take.depth_message(s, scale=2),
            "info": lambda s: take.camera_info(s, scale=2),
        }
        bench.send_until(bench.followed, **large)
        after = bench.arrays[-1].skeletons[0]
        assert after.id == before.id
        assert after.body[4].position.x == pytest.approx(before.body[4].position.x, abs=0.02)
    finally:
        bench.close()


def test_colour_without_depth_of_its_time_is_counted(start):
    bench = start(take.person())

    def late(stamp: int) -> Image:
        return take.depth_message(stamp + take.PERIOD * 100)

    bench.send_until(lambda: int(bench.said("dropped no_depth")) > 3, depth=late)
    assert not bench.arrays


def test_silence_is_told(start):
    bench = start()
    bench.until(lambda: bench.summary.startswith("nothing comes on /camera/color/image_raw"))
    assert bench.diagnostics[-1].status[0].level == b"\x01"


def test_what_it_has_no_time_for_is_dropped_for_the_newest_and_counted(context):
    class Slow:
        name = "slow"
        images_at_once = 1
        seen: list[float]

        def __init__(self) -> None:
            self.seen = []

        def detect(self, image: np.ndarray, stamp: float) -> tuple[Person2D, ...]:
            del image
            self.seen.append(stamp)
            time.sleep(0.3)
            return ()

        def close(self) -> None:
            pass

    detector = Slow()
    bench = Bench(context, detector)
    try:
        sent = []

        def send() -> None:
            if len(sent) < 10:
                sent.append(0)
                bench.send()

        bench.until(lambda: len(detector.seen) >= 2 and len(sent) == 10, doing=send)
        last = (take.START + 9 * take.PERIOD) * 1e-9
        bench.until(lambda: detector.seen[-1] == pytest.approx(last, abs=1e-6))
        bench.until(lambda: int(bench.said("dropped busy")) + len(detector.seen) == 10)
        assert detector.seen == sorted(detector.seen)
    finally:
        bench.close()


def test_a_detector_that_fails_is_told_and_tried_again(context):
    class Failing:
        name = "failing"
        images_at_once = 1
        errors = iter(
            [DetectorError("bad_day", "expected a good day")] * 3 + [ZeroDivisionError("on purpose")] * 3
        )

        def detect(self, image: np.ndarray, stamp: float) -> tuple[Person2D, ...]:
            del image, stamp
            error = next(self.errors, None)
            if error is not None:
                raise error
            return (take.person(),)

        def close(self) -> None:
            pass

    bench = Bench(context, Failing())
    try:
        bench.send_until(bench.followed)
        bench.until(lambda: bench.said("dropped bad_day") == "3" and bench.said("dropped internal") == "3")
    finally:
        bench.close()


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


def test_a_bag_that_begins_again_is_followed_again(start):
    bench = start(take.person())
    bench.send_until(bench.followed)
    bench.send_until(lambda: next(bench.numbers) > 60)
    bench.numbers = itertools.count()
    bench.arrays.clear()
    bench.send_until(bench.followed)
    assert bench.arrays[-1].header.stamp.sec * 10**9 < take.START + 60 * take.PERIOD


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
    with pytest.raises(ParameterError) as refused:
        RetrieverNode(context=context, parameter_overrides=[Parameter(name, value=value)])
    assert refused.value.code == code
