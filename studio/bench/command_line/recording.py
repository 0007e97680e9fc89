# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Whether `ros2 bag record` keeps every image of a depth camera, at what cost; and opening a large bag.

`python -m command_line.recording [COMMAND]` in `bench`. A process of its own publishes colour and depth with
the noise of a camera, 30 of each a second, as a driver does: reliable, ten kept.
"""

from __future__ import annotations

import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from command_line.playing import in_domain, own_command
from nodes.driver_rate import cpu_seconds
from report import Figure
from teo_ros2cli.bags.metadata import TopicRecord, read_metadata
from teo_ros2cli.bags.writer import BagWriter
from teo_ros2cli.interfaces import schema_of

_SIZES = ((640, 480), (1280, 720))
_RATE, _SECONDS = 30, 10
_LARGE = 2 * 1000**3  # bytes of the large bag
_WAIT = 30.0  # [s] for the recorder to subscribe
# Publishes images of a size until so many were, once a recorder listens; prints how long that took [s].
_CAMERA = """
import sys, time
import numpy as np, rclpy
from rclpy.serialization import serialize_message
from sensor_msgs.msg import Image

width, height, rate, count = map(int, sys.argv[1:])
rclpy.init()
node = rclpy.create_node("camera")
dice = np.random.default_rng(1)
slope = np.linspace(0, 200, width * height).reshape(height, width)
colours, depths = [], []
for _ in range(8):
    colour = (slope[..., None] + dice.normal(20, 2, (height, width, 3))).clip(0, 255).astype(np.uint8)
    depth = (1000 + slope + dice.normal(0, 3, (height, width))).astype(np.uint16)
    for images, encoding, pixels in ((colours, "rgb8", colour), (depths, "16UC1", depth)):
        image = Image(height=height, width=width, encoding=encoding, step=pixels[0].nbytes)
        image.data.frombytes(pixels.tobytes())
        images.append(serialize_message(image))
topics = [node.create_publisher(Image, name, 10) for name in ("camera/color", "camera/depth")]
while not all(topic.get_subscription_count() for topic in topics):
    time.sleep(0.05)
time.sleep(0.5)
begin = time.monotonic()
for i in range(count):
    time.sleep(max(begin + i / rate - time.monotonic(), 0))
    for topic, images in zip(topics, (colours, depths)):
        topic.publish(images[i % len(images)])
print(time.monotonic() - begin, flush=True)
time.sleep(2)
"""


def measure(command: str = "") -> list[Figure]:
    """Record both sizes in the default layout and in the plain one; then open and list a large bag."""
    program = command or str(own_command())
    figures = []
    with tempfile.TemporaryDirectory() as folder:
        for width, height in _SIZES:
            for preset in ("zstd_fast", "none"):
                bag = Path(folder) / "bag"
                figures.append(_recorded(program, bag, width, height, preset))
                shutil.rmtree(bag)
        figures += _large(program, Path(folder) / "large")
    return figures


def _recorded(program: str, bag: Path, width: int, height: int, preset: str) -> Figure:
    with in_domain():
        count = _RATE * _SECONDS
        recorder = subprocess.Popen(
            [program, "bag", "record", "-a", "-o", str(bag), "--storage-preset-profile", preset],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )
        camera = subprocess.Popen(
            [sys.executable, "-c", _CAMERA, *map(str, (width, height, _RATE, count))],
            stdout=subprocess.PIPE,
            text=True,
        )
        assert camera.stdout is not None
        took = float(camera.stdout.readline())
        used = cpu_seconds(recorder.pid)
        camera.wait()
        recorder.send_signal(signal.SIGINT)
        told = recorder.communicate(timeout=_WAIT)[1]
    counts = {topic.name: number for topic, number in read_metadata(bag).topics}
    kept = [counts.get(name, 0) for name in ("/camera/color", "/camera/depth")]
    written = sum(file.stat().st_size for file in bag.iterdir())
    lost = "" if sum(kept) == 2 * count or "lost" in told else ", and nothing said"
    return Figure(
        f"{width}x{height}, layout {preset}: colour, depth of {count} kept; of one core; to disk",
        f"{kept[0]}, {kept[1]}{lost}; {100 * used / took:.0f} %; {written / took / 1e6:.0f} MB/s",
    )


def _large(program: str, bag: Path) -> list[Figure]:
    """Times to list and to begin to play a bag of 2 GB."""
    writer = BagWriter(bag, preset="none", max_size=_LARGE // 4)
    writer.add_topic(TopicRecord("/image", "sensor_msgs/msg/Image"), schema_of("sensor_msgs/msg/Image"))
    data = np.random.default_rng(1).bytes(1_000_000)
    for i in range(_LARGE // len(data)):
        writer.write("/image", 10**18 + i * 10**7, 10**18 + i * 10**7, data)
    writer.close()
    figures = []
    for what, words in (
        ("list it", ["info", str(bag)]),
        ("open it and play its last tenth of a second", ["play", str(bag), "--start-offset", "19.9"]),
        ("list one of its files", ["info", str(bag / "large_0.mcap")]),
    ):
        begin = time.monotonic()
        subprocess.run([program, "bag", *words], check=True, capture_output=True)
        figures.append(Figure(f"a bag of 2 GB in four files: {what}", f"{time.monotonic() - begin:.1f} s"))
    return figures


if __name__ == "__main__":
    for figure in measure(*sys.argv[1:2]):
        print(f"{figure.what}: {figure.value}")
