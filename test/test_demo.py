# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The main job as the README gives it: one command, and what it leaves."""

from __future__ import annotations

import subprocess
import sys
from collections import Counter
from pathlib import Path

import av
import pytest
from mcap_ros2.reader import read_ros2_messages
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore

ROOT = Path(__file__).parents[1]
pytestmark = [pytest.mark.dds, pytest.mark.slow]
# [s] for a short text: it takes 35 alone and 100 to 150 beside a browser that draws without a graphics card,
# which leaves a third of a core to each process. Who hangs is told from who waits by far more than that.
TIMEOUT = 600.0


def demo(text: str, out: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, str(ROOT / "scripts" / "demo.py"), text, "--out", str(out)]
    return subprocess.run(command, capture_output=True, text=True, timeout=TIMEOUT, check=False)


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> tuple[subprocess.CompletedProcess[str], Path]:
    out = tmp_path_factory.mktemp("demo")
    return demo("Soy Eva. Hola", out), out


def test_it_signs_every_sentence_and_says_when(run: tuple[subprocess.CompletedProcess[str], Path]) -> None:
    result, _ = run
    assert result.returncode == 0, result.stdout + result.stderr
    rows = [line.split("│")[1].strip() for line in result.stdout.splitlines() if line.startswith("│")]
    assert rows == ["YO", "E", "V", "A", "HOLA"]


def test_it_films_the_signing_in_real_time(run: tuple[subprocess.CompletedProcess[str], Path]) -> None:
    _, out = run
    with av.open(str(out / "signing.mp4")) as film:
        stream = film.streams.video[0]
        frames = sum(1 for _ in film.decode(stream))
        assert stream.average_rate is not None
        frame = 1.0 / float(stream.average_rate)
    assert (out / "signing.png").stat().st_size > 0
    planned, recorded = signing_and_recorded_seconds(out / "bag")
    # It begins before the first trajectory and ends at rest after the last, within the recording.
    assert planned - frame <= frames * frame <= recorded + frame


def signing_and_recorded_seconds(bag: Path) -> tuple[float, float]:
    """From the first trajectory's start to the last one's end, and from the first joint state to the last."""
    states, begins, ends = [], [], []
    with AnyReader([bag], default_typestore=get_typestore(Stores.ROS2_JAZZY)) as reader:
        for connection, stamp, data in reader.messages():
            if connection.topic == "/joint_states":
                states.append(stamp * 1e-9)
            elif connection.topic == "/joint_trajectory":
                end = reader.deserialize(data, connection.msgtype).points[-1].time_from_start
                begins.append(stamp * 1e-9)
                ends.append(stamp * 1e-9 + end.sec + end.nanosec * 1e-9)
    return ends[-1] - begins[0], states[-1] - states[0]


def test_two_independent_readers_open_its_bag(run: tuple[subprocess.CompletedProcess[str], Path]) -> None:
    _, out = run
    with AnyReader([out / "bag"], default_typestore=get_typestore(Stores.ROS2_JAZZY)) as reader:
        by_rosbags = Counter()
        for connection, _, data in reader.messages():
            reader.deserialize(data, connection.msgtype)
            by_rosbags[connection.topic] += 1
    (file,) = (out / "bag").glob("*.mcap")
    by_mcap = Counter(message.channel.topic for message in read_ros2_messages(file))
    assert by_rosbags == by_mcap
    assert by_mcap["/text"] == 1
    assert by_mcap["/sign_tokens"] == 2
    assert by_mcap["/joint_trajectory"] >= 2  # a sentence may begin with a motion of its own
    assert by_mcap["/robot_description"] == 1
    assert by_mcap["/executor_status"] >= 2
    assert by_mcap["/joint_states"] > 1000  # 100 a second


def test_it_fails_clearly_when_nothing_can_be_signed(tmp_path: Path) -> None:
    result = demo("Привет", tmp_path)
    assert result.returncode == 1
    assert "unsignable_text" in result.stdout
    assert {left.name for left in tmp_path.iterdir()} == {"bag", "log"}, "a film of a robot that only waited"
