# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The whole retriever over DDS: images in, skeletons out, on the cores of this machine."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from array import array
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import cv2
import numpy as np
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from sensor_msgs.msg import CameraInfo, Image
from teo_sign_msgs.msg import SkeletonArray

from report import Figure, percentiles
from teo_common.node_process import run_node
from teo_skeleton_retriever.bags.bag_images import BagImages, choose_topics
from teo_skeleton_retriever.bags.bag_reader import Bag
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.camera.rgbd_image import CAMERA_INFO_TOPIC, COLOR_TOPIC, DEPTH_TOPIC, RgbdImage
from teo_skeleton_retriever.detectors import make_detector
from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_skeleton_retriever.layouts.person_2d import Person2D
from teo_skeleton_retriever.node.latest_frame_pipeline import tune_interpreter
from teo_skeleton_retriever.node.retriever_node import RetrieverNode

TAKE = Path(__file__).parents[2] / "bags" / "signer_d435"
RATE = 30.0  # [Hz] of the camera
WATCHED = 20.0  # [s] of images that count
WARM_UP = 3.0  # [s] before: models load, filters fill
LONG_RUN = 10_000  # images over which memory is watched
SETTLED = 1_000  # images after which it should not grow any more
_TIMEOUT = 60.0  # [s] for the node to start
_SLOP = 10**7  # [ns]
_BARE_IMAGES = 70
_BARE_WARM_UP = 10


def measure() -> list[Figure]:
    """Figures of the node with its default detector on a rendered take, then of its memory without one."""
    os.environ.setdefault("ROS_DOMAIN_ID", "19")
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    images = _take()
    figures = []
    for width, height in ((640, 480), (1280, 720)):
        sized = [_resized(image, width, height) for image in images]
        bare = _bare_detector(sized)
        figures += [*_bare_figures(bare, f"{width}x{height}"), *_live(sized, bare.times)]
    return [*figures, *_memory(_resized(images[0], 320, 240))]


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


class _Bare(NamedTuple):
    """The detector alone, image by image, its first images left out."""

    times: list[float]
    """From an image to its people [s]."""
    processor_time: float
    """Of all threads, for an image [s]."""


def _bare_detector(images: Sequence[RgbdImage]) -> _Bare:
    detector = make_detector("mediapipe")
    times: list[float] = []
    used = 0.0
    for i in range(_BARE_IMAGES):
        if i == _BARE_WARM_UP:
            times.clear()
            used = time.process_time()
        image = images[i % len(images)]
        began = time.perf_counter()
        detector.detect(image.color, i / RATE)
        times.append(time.perf_counter() - began)
    used = time.process_time() - used
    detector.close()
    return _Bare(times, used / len(times))


def _bare_figures(bare: _Bare, size: str) -> list[Figure]:
    return [
        percentiles(f"{size}: detector alone", bare.times),
        Figure(
            f"{size}: processor time of the detector alone", f"{1e3 * bare.processor_time:.1f} ms an image"
        ),
    ]


class _Camera:
    """Publishes images as a driver does, and hears what comes of them."""

    def __init__(self, node: Node, images: Sequence[RgbdImage]) -> None:
        self._node = node
        self._messages = [_messages(image) for image in images]
        self._color = node.create_publisher(Image, COLOR_TOPIC, 5)
        self._depth = node.create_publisher(Image, DEPTH_TOPIC, 5)
        self._info = node.create_publisher(CameraInfo, CAMERA_INFO_TOPIC, 5)
        self.latencies: dict[float, float] = {}
        self.said: dict[str, str] = {}
        self.skeletons = 0
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
        return _seconds(stamp)

    def _on_skeletons(self, message: SkeletonArray) -> None:
        stamp = _seconds(message.header.stamp)
        self.latencies[stamp] = self._node.get_clock().now().nanoseconds * 1e-9 - stamp
        self.skeletons += bool(message.skeletons)

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        self.said = {pair.key: pair.value for pair in message.status[0].values}


def _live(images: Sequence[RgbdImage], bare: Sequence[float]) -> list[Figure]:
    """Show the take at the camera's rate, over and over, to a node in a process of its own."""
    size = f"{images[0].camera.width}x{images[0].camera.height}"
    with _graph(images, []) as (camera, executor, process):
        sent: list[float] = []
        due = time.monotonic()
        used, began = 0.0, 0.0
        for number in range(round((WARM_UP + WATCHED) * RATE)):
            if number == round(WARM_UP * RATE):
                sent.clear()
                used, began = _cpu_seconds(process.pid), time.monotonic()
            sent.append(camera.publish(number))
            due += 1.0 / RATE
            while (left := due - time.monotonic()) > 0.0:
                executor.spin_once(timeout_sec=left)
        took = time.monotonic() - began
        cpu = _cpu_seconds(process.pid) - used
        _spin(executor, 1.5)
        latencies = [camera.latencies[stamp] for stamp in sent if stamp in camera.latencies]
        dropped = len(sent) - len(latencies)
        own = float(camera.said["own time, median [ms]"])
    detector = float(np.median(bare)) * 1e3
    return [
        Figure(
            f"{size} at {RATE:.0f} Hz over DDS",
            f"{len(latencies) / WATCHED:.1f} images per second, {dropped} of {len(sent)} dropped",
        ),
        Figure(
            f"{size}: processor time of the node",
            f"{1e3 * cpu / max(len(latencies), 1):.1f} ms an image, the detector's in it",
        ),
        percentiles(f"{size}: image to skeletons", latencies or [float("nan")]),
        Figure(
            f"{size}: own time",
            f"median {own:.1f} ms, {100.0 * own / detector:.0f} % of the detector alone; "
            f"node {100.0 * cpu / took:.0f} % of one core",
        ),
    ]


def _memory(image: RgbdImage) -> list[Figure]:
    """Resident memory while images go through as fast as they are taken."""
    with _graph([image], ["replay"]) as (camera, executor, process):
        sizes = {}
        deadline = time.monotonic() + 600.0
        sent = began = 0.0
        for number in range(LONG_RUN + 1):
            if number == 1:
                began = time.monotonic()
            if number in (SETTLED, LONG_RUN):
                sizes[number] = _resident(process.pid)
            sent = camera.publish(number)
            while sent not in camera.latencies and time.monotonic() < deadline:
                executor.spin_once(timeout_sec=0.2)
        took = time.monotonic() - began
        followed = camera.skeletons
    grown = sizes[LONG_RUN] - sizes[SETTLED]
    return [
        Figure(
            f"memory after {SETTLED} and {LONG_RUN} images, keypoints given",
            f"{sizes[SETTLED]:.1f} MB, {sizes[LONG_RUN]:.1f} MB ({grown:+.1f} MB)",
        ),
        Figure(
            "320x240 with keypoints given, one after the other",
            f"{LONG_RUN / took:.0f} images per second, somebody in {followed} of {LONG_RUN + 1}",
        ),
    ]


@contextmanager
def _graph(
    images: Sequence[RgbdImage], arguments: Sequence[str]
) -> Iterator[tuple[_Camera, SingleThreadedExecutor, subprocess.Popen[bytes]]]:
    """A camera here, and the node in a process of its own."""
    rclpy.init()
    node = Node("bench_camera")
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    camera = _Camera(node, images)
    command = [sys.executable, __file__, "node", *arguments]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        deadline = time.monotonic() + _TIMEOUT
        while not (camera.connected and camera.said):
            if time.monotonic() > deadline or process.poll() is not None:
                raise TimeoutError(f"the node did not listen within {_TIMEOUT} s")
            executor.spin_once(timeout_sec=0.2)
        yield camera, executor, process
    finally:
        process.send_signal(signal.SIGINT)
        process.wait()
        executor.shutdown()
        node.destroy_node()
        rclpy.shutdown()


def _spin(executor: SingleThreadedExecutor, seconds: float) -> None:
    deadline = time.monotonic() + seconds
    while (left := deadline - time.monotonic()) > 0.0:
        executor.spin_once(timeout_sec=left)


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


def _seconds(stamp: Any) -> float:
    return float(stamp.sec) + float(stamp.nanosec) * 1e-9


def _cpu_seconds(pid: int) -> float:
    """Processor time that a process has used [s], user and system."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _resident(pid: int) -> float:
    """Memory of a process that is in use [MB]."""
    pages = int(Path(f"/proc/{pid}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


class _Waving:
    """Keypoints of someone who waves, without looking: all but the detector is measured."""

    name = "waving"
    images_at_once = 1

    def __init__(self) -> None:
        places = {
            "Nose": (160, 50),
            "Neck": (160, 80),
            "MidHip": (160, 170),
            "RHip": (143, 170),
            "LHip": (177, 170),
        }
        places |= {"RShoulder": (130, 80), "RElbow": (120, 120), "RWrist": (130, 155)}
        places |= {"LShoulder": (190, 80), "LElbow": (200, 120), "LWrist": (190, 155)}
        self._body = np.zeros((len(BODY_25), 3))
        for name, place in places.items():
            self._body[BODY_25.index[name]] = (*place, 0.9)
        spread = np.random.default_rng(0).uniform(-15.0, 15.0, (91, 2))
        self._hand = np.column_stack([spread[:21] + np.array([130.0, 165.0]), np.full(21, 0.9)])
        self._face = np.column_stack([spread[21:] + np.array([160.0, 50.0]), np.full(70, 0.9)])

    def detect(self, image: np.ndarray, stamp: float) -> tuple[Person2D, ...]:
        """Give them."""
        del image
        moved = np.array([3.0 * np.sin(stamp), 0.0, 0.0])
        return (
            Person2D(
                body=self._body + moved * (self._body[:, 2:] > 0.0), right_hand=self._hand, face=self._face
            ),
        )

    def close(self) -> None:
        """Nothing to release."""


def _run_node(arguments: Sequence[str]) -> None:
    def tuned_node() -> RetrieverNode:
        node = RetrieverNode(detector=_Waving() if "replay" in arguments else None)
        tune_interpreter()
        return node

    run_node(tuned_node, None)


if __name__ == "__main__":
    if sys.argv[1:2] == ["node"]:
        _run_node(sys.argv[2:])
    else:
        for figure in measure():
            print(f"{figure.what}: {figure.value}")
