# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The whole retriever over DDS: images in, skeletons out, on the cores of this machine."""

from __future__ import annotations

import time
from array import array
from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np
from diagnostic_msgs.msg import DiagnosticArray
from sensor_msgs.msg import CameraInfo, Image
from teo_sign_msgs.msg import SkeletonArray

from nodes.bench_node import BenchNode, bench_graph, cpu_seconds, seconds
from report import Figure, percentiles
from teo_skeleton_retriever.bags.bag_images import BagImages, choose_topics
from teo_skeleton_retriever.bags.bag_reader import Bag
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.camera.rgbd_image import CAMERA_INFO_TOPIC, COLOR_TOPIC, DEPTH_TOPIC, RgbdImage
from teo_skeleton_retriever.detectors import make_detector

TAKE = Path(__file__).parents[2] / "bags" / "signer_d435"
RATE = 30.0  # [Hz] of the camera
WARM_UP = 3.0  # [s] before images count: models load, filters fill
_SLOP = 10**7  # [ns]
_BARE_IMAGES = 70
_BARE_WARM_UP = 10


def measure(watched: float = 20.0) -> list[Figure]:
    """Figures of the node with its default detector on a rendered take.

    Args:
        watched: Images that count, of each size [s].
    """
    images = _take()
    figures = []
    for width, height in ((640, 480), (1280, 720)):
        figures += _live([_resized(image, width, height) for image in images], watched)
    return figures


def _take() -> list[RgbdImage]:
    bag = Bag(TAKE)
    return [found.image for found in BagImages(bag, choose_topics(bag), slop=_SLOP).images()]


def _resized(image: RgbdImage, width: int, height: int) -> RgbdImage:
    """Scale to a width, and cut the middle to a height."""
    factor = width / image.camera.width
    rows = round(image.camera.height * factor)
    top = (rows - height) // 2
    color = cv2.resize(image.color, (width, rows))[top : top + height]
    depth = cv2.resize(image.depth, (width, rows), interpolation=cv2.INTER_NEAREST)[top : top + height]
    camera = CameraModel(
        width=width,
        height=height,
        fx=image.camera.fx * factor,
        fy=image.camera.fy * factor,
        cx=(image.camera.cx + 0.5) * factor - 0.5,
        cy=(image.camera.cy + 0.5) * factor - 0.5 - top,
    )
    return RgbdImage(image.stamp, np.ascontiguousarray(color), np.ascontiguousarray(depth), camera)


def _bare_detector(images: Sequence[RgbdImage]) -> list[float]:
    """Times from an image to its people by the detector alone [s]."""
    detector = make_detector("mediapipe")
    times: list[float] = []
    for i in range(_BARE_IMAGES):
        began = time.perf_counter()
        detector.detect(images[i % len(images)].color, i / RATE)
        times.append(time.perf_counter() - began)
    detector.close()
    return times[_BARE_WARM_UP:]


class _Camera:
    """Publishes images as a driver does, and hears what comes of them."""

    def __init__(self, node: BenchNode, images: Sequence[RgbdImage]) -> None:
        self._node = node
        self._messages = [_messages(image) for image in images]
        self._color = node.create_publisher(Image, COLOR_TOPIC, 5)
        self._depth = node.create_publisher(Image, DEPTH_TOPIC, 5)
        self._info = node.create_publisher(CameraInfo, CAMERA_INFO_TOPIC, 5)
        self.latencies: dict[float, float] = {}
        self.said: dict[str, str] = {}
        node.create_subscription(SkeletonArray, "skeletons", self._on_skeletons, 100)
        node.create_subscription(DiagnosticArray, "diagnostics", self._on_diagnostics, 10)

    @property
    def connected(self) -> bool:
        return all(p.get_subscription_count() for p in (self._color, self._depth, self._info))

    def publish(self, number: int) -> float:
        """Publish one image with the time of now as its stamp [s], which is returned."""
        stamp = self._node.get_clock().now().to_msg()
        color, depth, info = self._messages[number % len(self._messages)]
        for message, publisher in ((info, self._info), (color, self._color), (depth, self._depth)):
            message.header.stamp = stamp
            publisher.publish(message)
        return seconds(stamp)

    def _on_skeletons(self, message: SkeletonArray) -> None:
        stamp = seconds(message.header.stamp)
        self.latencies[stamp] = self._node.get_clock().now().nanoseconds * 1e-9 - stamp

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        self.said = {pair.key: pair.value for pair in message.status[0].values}


def _live(images: Sequence[RgbdImage], watched: float) -> list[Figure]:
    """Show the take at the camera's rate, over and over, to a node in a process of its own."""
    size = f"{images[0].camera.width}x{images[0].camera.height}"
    bare = _bare_detector(images)
    with bench_graph() as (node, graph):
        camera = _Camera(node, images)
        graph.start_nodes(["retriever"])
        node.wait_for("the node to listen", lambda: camera.connected and camera.said)
        process = graph.process_id("retriever")
        sent: list[float] = []
        due = time.monotonic()
        used = 0.0
        for number in range(round((WARM_UP + watched) * RATE)):
            if number == round(WARM_UP * RATE):
                sent.clear()
                used = cpu_seconds(process)
            sent.append(camera.publish(number))
            due += 1.0 / RATE
            while (left := due - time.monotonic()) > 0.0:
                node.spin_once(left)
        used = cpu_seconds(process) - used
        node.spin(1.5)
    latencies = [camera.latencies[stamp] for stamp in sent if stamp in camera.latencies]
    return [
        percentiles(f"{size}: detector alone", bare),
        Figure(
            f"{size} at {RATE:.0f} Hz over DDS",
            f"{len(latencies) / watched:.1f} images per second, {len(sent) - len(latencies)} of {len(sent)} "
            f"dropped; {1e3 * used / max(len(latencies), 1):.1f} ms of processor time an image",
        ),
        percentiles(f"{size}: image to skeletons", latencies or [float("nan")]),
    ]


def _messages(image: RgbdImage) -> tuple[Image, Image, CameraInfo]:
    camera = image.camera
    millimetres = np.nan_to_num(image.depth * 1000.0).astype(np.uint16)
    color = _image("rgb8", image.color)
    depth = _image("16UC1", millimetres)
    info = CameraInfo(
        width=camera.width,
        height=camera.height,
        k=[camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0],
    )
    return color, depth, info


def _image(encoding: str, pixels: np.ndarray) -> Image:
    return Image(
        height=pixels.shape[0],
        width=pixels.shape[1],
        encoding=encoding,
        step=pixels.strides[0],
        data=array("B", pixels.tobytes()),
    )
