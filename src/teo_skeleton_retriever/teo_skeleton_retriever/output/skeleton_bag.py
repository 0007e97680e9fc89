"""Skeletons written to an MCAP file, as rosbag2 would record their topic."""

from __future__ import annotations

from io import BufferedWriter
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from ament_index_python.packages import get_package_share_directory
from mcap.writer import CompressionType, Writer
from rclpy.serialization import serialize_message
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from teo_skeleton_retriever.output.output_file import temporary_for

TOPIC = "/skeletons"
_TYPE = "teo_sign_msgs/msg/SkeletonArray"
_PARTS = ("teo_sign_msgs/msg/Keypoint3D", "teo_sign_msgs/msg/Skeleton3D", _TYPE)


class SkeletonBag:
    """Writes messages. A context manager: the file appears when the block ends well."""

    def __init__(self, path: Path) -> None:
        """Write nothing yet.

        Args:
            path: file to write, replaced if it exists; its folder exists.

        Raises:
            OutputError: there is no such folder, or the name does not end in .mcap.
        """
        self._path = path
        self._temporary = temporary_for(path, ".mcap")
        self._stream: BufferedWriter | None = None

    def __enter__(self) -> Self:
        self._stream = self._temporary.open("wb")
        self._writer = Writer(self._stream, compression=CompressionType.ZSTD)
        self._writer.start(profile="ros2", library="teo_skeleton_retriever")
        types = message_types()
        definition, _ = types.generate_msgdef(_TYPE, ros_version=2)
        schema = self._writer.register_schema(_TYPE, "ros2msg", definition.encode())
        metadata = {"topic_type_hash": types.hash_rihs01(_TYPE), "offered_qos_profiles": "[]"}
        self._channel = self._writer.register_channel(TOPIC, "cdr", schema, metadata)
        return self

    def write(self, message: Any, time: int) -> None:
        """Append a SkeletonArray.

        Args:
            message: to append.
            time: at which a recorder would have received it [ns].
        """
        stamp = message.header.stamp
        published = stamp.sec * 1_000_000_000 + stamp.nanosec
        self._writer.add_message(self._channel, time, serialize_message(message), published)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        assert self._stream is not None
        try:
            if kind is None:
                self._writer.finish()  # type: ignore[no-untyped-call]
                self._stream.close()
                self._temporary.replace(self._path)
        finally:
            self._stream.close()
            self._temporary.unlink(missing_ok=True)


def message_types() -> Typestore:
    """Give the types of messages of ROS 2 and that of the skeletons, for bags."""
    folder = Path(get_package_share_directory("teo_sign_msgs")) / "msg"
    store = get_typestore(Stores.ROS2_JAZZY)
    for name in _PARTS:
        text = (folder / f"{name.rpartition('/')[2]}.msg").read_text(encoding="utf-8")
        store.register(get_types_from_msg(text, name))
    return store
