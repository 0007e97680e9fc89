# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The node beside a camera driver, for tests."""

from __future__ import annotations

import itertools
import time
from collections.abc import Callable
from typing import Any

import camera_take as take
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import CameraInfo, CompressedImage, Image
from teo_sign_msgs.msg import SkeletonArray
from teo_sign_msgs.srv import LockSigner

from teo_skeleton_retriever.detectors import make_detector
from teo_skeleton_retriever.layouts.person_2d import Person2D
from teo_skeleton_retriever.node.retriever_node import RetrieverNode

PATIENCE = 20.0  # [s]; a busy machine is slow, not wrong
IMAGES = 400  # of which the detector knows the keypoints


def replay(*people: Person2D, begin: int = 0) -> Any:
    """A detector that sees these people in every image from a number on."""
    stamps = [(take.START + i * take.PERIOD) * 1e-9 for i in range(IMAGES)]
    return make_detector(
        "replay", frames=[(stamp, people if i >= begin else ()) for i, stamp in enumerate(stamps)]
    )


class NodeBench:
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
