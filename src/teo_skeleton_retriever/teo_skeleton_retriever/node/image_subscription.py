# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A subscription to images in the form in which somebody publishes them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.qos import QoSProfile
from sensor_msgs.msg import CompressedImage, Image

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
