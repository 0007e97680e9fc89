# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`retriever_node`: colour, depth and camera_info in, people in space out."""

from __future__ import annotations

import time
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from queue import SimpleQueue
from typing import Any, NamedTuple

import rclpy
from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import CameraInfo, CompressedImage, Image
from std_msgs.msg import Header
from teo_sign_msgs.msg import SkeletonArray
from teo_sign_msgs.srv import LockSigner
from visualization_msgs.msg import MarkerArray

from teo_common.diagnostics import DIAGNOSTICS_PERIOD
from teo_common.node_process import run_node
from teo_common.parameters import declare_parameters
from teo_skeleton_retriever.camera.rgbd_image import (
    CAMERA_INFO_TOPIC,
    COLOR_TOPIC,
    DEPTH_TOPIC,
    image_of,
    stamp_of,
)
from teo_skeleton_retriever.camera.synchroniser import Pair, Synchroniser
from teo_skeleton_retriever.detectors import Detector, make_detector
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.image_retriever import (
    Detection,
    FrameRetriever,
    ImageRetriever,
    Retrieved,
    make_retriever,
)
from teo_skeleton_retriever.node.health import ImageDiagnostics, Problem, Result, StreamStats
from teo_skeleton_retriever.node.latest_frame_pipeline import LatestFramePipeline, tune_interpreter
from teo_skeleton_retriever.node.node_parameters import (
    PARAMETERS,
    check_choices,
    detector_options_from,
    retriever_parameters_from,
)
from teo_skeleton_retriever.output.messages import image_message, marker_array, skeleton_array
from teo_skeleton_retriever.output.overlay import Overlay

_AUTO, _RAW = "auto", "raw"


class ImageSubscription:
    """Subscribes to one form of an image topic.

    With `auto` it is the raw one, until `follow_publishers` finds that only the compressed one is published.
    Not both at once: a camera compresses for nobody else, and every image would come twice.
    """

    def __init__(
        self,
        node: Any,
        *,
        topic: str,
        compressed: str,
        transport: str,
        callback: Callable[[Any], None],
        qos: QoSProfile,
    ) -> None:
        """Subscribe.

        Args:
            node: To subscribe with.
            topic: Of the raw images; remapped, the compressed ones are below its new name (as with
                image_transport).
            compressed: Last name of the compressed form's topic.
            transport: "raw", that name, or "auto".
            callback: Gets each message.
            qos: Of the subscription.
        """
        base = node.resolve_topic_name(topic)
        self._node = node
        self._names = {_RAW: base, compressed: f"{base}/{compressed}"}
        self._automatic = transport == _AUTO
        self._callback = callback
        self._qos = qos
        self._subscription = self._subscribe(_RAW if self._automatic else transport)

    @property
    def topic(self) -> str:
        """Full name of what is subscribed to."""
        return str(self._subscription.topic_name)

    def follow_publishers(self) -> None:
        """Change to the other form where that is published and the present one is not."""
        if not self._automatic or self._node.count_publishers(self.topic):
            return
        for transport, name in self._names.items():
            if self._node.count_publishers(name):
                self._node.destroy_subscription(self._subscription)
                self._subscription = self._subscribe(transport)
                self._node.get_logger().info(f"takes images from {self.topic}")
                return

    def _subscribe(self, transport: str) -> Any:
        kind = Image if transport == _RAW else CompressedImage
        return self._node.create_subscription(kind, self._names[transport], self._callback, self._qos)


# Best effort: a lost image is not worth waiting for. Five, as in rmw's profile for sensors: with
# fewer, a short delay would leave colour and depth of different times.
_SENSOR = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
_LOOK_PERIOD = 0.25  # [s] between looks for who publishes images; of a bag of some seconds little is missed
_SAME_CLOCK = 60.0  # [s] An image that seems older, or younger, was stamped by another clock: in a bag.

# Images whose turn never came: a newer one was there first.
_BUSY = "busy"
_NO_CAMERA_INFO = "no_camera_info"
# Images left out because of the parameter `period`.
_NOT_DUE = "not_due"


class _Job(NamedTuple):
    pair: Pair
    arrived: float


class _Followed(NamedTuple):
    job: _Job
    header: Header
    detected: Detection


class RetrieverNode(Node):
    """Follows people before a depth camera. Owns no image processing: see `ImageRetriever`."""

    def __init__(self, *, detector: Detector | None = None, **node_arguments: Any) -> None:
        """Make the detector and listen.

        Args:
            detector: In place of the one that the parameters name; closed with the node.
            node_arguments: Of `rclpy.node.Node`, after its name.

        Raises:
            RetrieverError: The parameters do not go together, or the detector cannot be made.
        """
        super().__init__("skeleton_retriever", **node_arguments)
        declare_parameters(self, PARAMETERS)
        values = self._values()
        check_choices(values)
        if detector is None:
            options = detector_options_from(self._value("detector_options"))
            detector = make_detector(str(values["detector"]), **options)
        self._detector_name = detector.name
        self._retriever = ImageRetriever(detector, self._make_retriever(values))
        self._synchroniser = Synchroniser(
            slop=round(float(values["slop"]) * 1e9), capacity=int(values["queue_size"])
        )
        self._stats = StreamStats(("color", "depth", "camera_info"), time.monotonic())
        self._overlay = Overlay()
        self._camera_info: CameraInfo | None = None
        self._last_stamp: int | None = None
        # What is asked of the retriever, which the second stage alone may touch.
        self._orders: SimpleQueue[Callable[[ImageRetriever], None]] = SimpleQueue()

        self._skeletons = self.create_publisher(SkeletonArray, "skeletons", 10)
        self._markers = self.create_publisher(MarkerArray, "skeleton_markers", 10)
        self._pictures = self.create_publisher(Image, "overlay/image", 1)
        self._pipeline = LatestFramePipeline(self._detect, self._follow, at_once=detector.images_at_once)
        images = partial(ImageSubscription, self, qos=_SENSOR)
        color, depth = values["color_transport"], values["depth_transport"]
        self._images = {
            "color": images(
                topic=COLOR_TOPIC, compressed="compressed", transport=color, callback=self._on_color
            ),
            "depth": images(
                topic=DEPTH_TOPIC, compressed="compressedDepth", transport=depth, callback=self._on_depth
            ),
        }
        info = self.create_subscription(CameraInfo, CAMERA_INFO_TOPIC, self._on_camera_info, _SENSOR)
        self._topics = {name: stream.topic for name, stream in self._images.items()}
        self._topics["camera_info"] = info.topic_name
        self._diagnostics = ImageDiagnostics(self, self._stats, self._topics)
        self.create_service(LockSigner, "lock_signer", self._on_lock_signer)
        self.create_timer(DIAGNOSTICS_PERIOD, self._on_diagnostics)
        self.create_timer(_LOOK_PERIOD, self._follow_publishers)
        self.add_on_set_parameters_callback(self._check_parameters)
        self.add_post_set_parameters_callback(self._apply_parameters)
        self.get_logger().info(f"{detector.name} waits for {', '.join(self._topics.values())}")

    def destroy_node(self) -> None:
        """End the threads before the publishers that they use."""
        self._pipeline.close()
        self._retriever.close()
        super().destroy_node()

    def _follow_publishers(self) -> None:
        for stream, subscription in self._images.items():
            subscription.follow_publishers()
            self._topics[stream] = subscription.topic

    def _on_color(self, message: Image | CompressedImage) -> None:
        self._stats.arrived("color", time.monotonic())
        self._offer(self._synchroniser.add_color(stamp_of(message), message))

    def _on_depth(self, message: Image | CompressedImage) -> None:
        self._stats.arrived("depth", time.monotonic())
        self._offer(self._synchroniser.add_depth(stamp_of(message), message))

    def _on_camera_info(self, message: CameraInfo) -> None:
        self._stats.arrived("camera_info", time.monotonic())
        self._camera_info = message

    def _offer(self, pairs: Sequence[Pair]) -> None:
        for pair in pairs:
            if not self._is_due(pair.stamp):
                self._stats.drop(_NOT_DUE)
                continue
            self._last_stamp = pair.stamp
            if self._pipeline.submit(_Job(pair, time.monotonic())) is not None:
                self._stats.drop(_BUSY)

    def _is_due(self, stamp: int) -> bool:
        last = self._last_stamp
        return last is None or stamp < last or stamp - last >= self._value("period") * 1e9

    # In threads of the pipeline.
    def _detect(self, job: _Job) -> _Followed | None:
        with self._problems():
            info = self._camera_info
            if info is None:
                raise RetrieverError(
                    _NO_CAMERA_INFO, f"expected it on {self._topics['camera_info']}, got none so far"
                )
            pair = job.pair
            image = image_of(pair.color, pair.depth, info, rectified=self._value("rectified"))
            frame_id = pair.color.header.frame_id or info.header.frame_id
            header = Header(stamp=pair.color.header.stamp, frame_id=frame_id)
            return _Followed(job, header, self._retriever.detect(image))
        return None

    def _follow(self, followed: _Followed) -> None:
        with self._problems():
            while not self._orders.empty():
                self._orders.get_nowait()(self._retriever)
            result, header = self._retriever.follow(followed.detected), followed.header
            self._skeletons.publish(skeleton_array(result.skeletons, header))
            self._count(followed.job, result)
            if self._markers.get_subscription_count():
                self._markers.publish(marker_array(result.skeletons, header))
            if self._pictures.get_subscription_count():
                picture = self._overlay.draw(followed.detected.image, result)
                self._pictures.publish(image_message(picture, header))

    @contextmanager
    def _problems(self) -> Iterator[None]:
        """Leave an image out, whatever is wrong with it; the next one gets its chance."""
        try:
            yield
        except Exception as error:
            if not self.context.ok():
                return  # told to end in the middle of it
            problem = Problem.of(error)
            self._stats.drop(problem.code)
            self._diagnostics.report(problem, traceback.format_exc() if problem.code == "internal" else "")

    def _count(self, job: _Job, result: Retrieved) -> None:
        now = time.monotonic()
        age = (self.get_clock().now().nanoseconds - job.pair.stamp) * 1e-9
        self._stats.done(
            Result(
                now=now,
                delay=now - job.arrived,
                age=age if abs(age) < _SAME_CLOCK else float("nan"),
                detector=result.detector_time,
                own=result.own_time,
                people=len(result.skeletons),
                depth_share=result.depth_share,
                depth_median=result.depth_median,
                signer=next((s.track_id for s in result.skeletons if s.is_signer), None),
                people_left_out=result.people_left_out,
            )
        )

    # In the executor's thread again

    def _on_diagnostics(self) -> None:
        dropped = self._synchroniser.dropped
        for reason, count in dropped.items():
            self._stats.drop(reason, count)
        dropped.clear()
        self._diagnostics.publish()

    def _on_lock_signer(
        self, request: LockSigner.Request, response: LockSigner.Response
    ) -> LockSigner.Response:
        wanted = None if request.id == LockSigner.Request.NOBODY else request.id
        known = self._retriever.known_ids
        if wanted is not None and wanted not in known:
            response.code = "unknown_id"
            response.message = f"expected the id of a person in the last image {sorted(known)}, got {wanted}"
            return response
        self._orders.put(lambda retriever: retriever.lock_signer(wanted))
        response.success = True
        return response

    def _check_parameters(self, parameters: Sequence[Parameter]) -> SetParametersResult:
        values = self._values() | {item.name: item.value for item in parameters}
        try:
            check_choices(values)
            self._make_retriever(values)
        except RetrieverError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _apply_parameters(self, parameters: Sequence[Parameter]) -> None:
        if {item.name for item in parameters} == {"period"}:
            return
        retriever = self._make_retriever(self._values())
        self._orders.put(lambda images: images.replace(retriever))

    def _make_retriever(self, values: dict[str, Any]) -> FrameRetriever:
        parameters = retriever_parameters_from(values, self._detector_name)
        return make_retriever(parameters, str(values["compat"]), values["compat_options"])

    def _values(self) -> dict[str, Any]:
        return {row.name: self._value(row.name) for row in PARAMETERS}

    def _value(self, name: str) -> Any:
        return self.get_parameter(name).value


def _tuned_node() -> RetrieverNode:
    node = RetrieverNode()
    tune_interpreter()
    return node


def main(arguments: list[str] | None = None) -> None:
    """Run the node until it is told to end."""
    try:
        run_node(_tuned_node, arguments, PARAMETERS)
    except RetrieverError as error:
        rclpy.logging.get_logger("skeleton_retriever").fatal(str(error))
        raise SystemExit(1) from None


if __name__ == "__main__":
    main()
