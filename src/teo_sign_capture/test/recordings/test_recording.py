# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import shutil
from multiprocessing import active_children
from pathlib import Path
from types import SimpleNamespace

import pytest
from made_bags import messages, signing, write_bag
from mcap.writer import Writer
from refusals import refused
from rosbags.rosbag2 import Reader

from teo_sign_capture.recordings import keypoint_search
from teo_sign_capture.recordings.keypoint_search import find_skeletons
from teo_sign_capture.recordings.recording import open_recording, track_of
from teo_sign_capture.recordings.skeleton_bag import write_skeletons
from teo_synthetic_signer.take.take_files import START

SHIPPED = Path(__file__).resolve().parents[4] / "bags" / "signer_d435"


@pytest.fixture
def bag(tmp_path: Path) -> Path:
    return write_bag(tmp_path / "HOLA.mcap", signing(rate=15.0))


def test_a_bag_of_skeletons_is_read_as_it_is(bag: Path, tmp_path: Path) -> None:
    recording = open_recording(bag)
    assert recording.has_skeletons
    assert not recording.rendered
    track, warnings = track_of(recording, cache=tmp_path / "cache")
    assert len(track.times) == 48
    assert track.source == "HOLA.mcap"
    assert track.recorded == "2024-03-09"
    assert warnings == ()
    assert not (tmp_path / "cache").exists()


def test_a_rendered_bag_says_so_and_was_recorded_on_no_day(tmp_path: Path) -> None:
    recording = open_recording(SHIPPED)
    assert recording.rendered
    assert not recording.has_skeletons
    track, _ = track_of(recording, cache=tmp_path, topic="/truth/skeletons")
    assert track.recorded is None


def test_skeletons_found_in_a_rendered_bag_were_recorded_on_no_day_either(tmp_path: Path) -> None:
    file = tmp_path / "found.mcap"
    write_skeletons(file, messages(signing(rate=15.0), begins=START * 1e-9 + 0.1))
    recording = open_recording(file)
    assert recording.has_skeletons
    assert recording.rendered
    track, _ = track_of(recording, cache=tmp_path / "cache")
    assert track.recorded is None


def test_the_digest_is_of_the_messages_not_of_name_or_place(bag: Path, tmp_path: Path) -> None:
    copy = tmp_path / "other.mcap"
    shutil.copy(bag, copy)
    new = write_bag(tmp_path / "new.mcap", signing(rate=15.0, seed=1))
    same, other = (open_recording(path).digest == open_recording(bag).digest for path in (copy, new))
    assert same and not other


def test_what_is_no_bag_is_refused(tmp_path: Path) -> None:
    (tmp_path / "text.txt").write_text("no bag")
    for path in (tmp_path / "text.txt", tmp_path / "nowhere", tmp_path):
        with refused("no_bag", "expected the folder of a bag"):
            open_recording(path)


@pytest.mark.slow
def test_of_images_that_were_cut_off_those_before_the_cut_are_used_and_that_is_said(tmp_path: Path) -> None:
    (whole,) = SHIPPED.glob("*.mcap")
    cut = tmp_path / "cut.mcap"
    content = whole.read_bytes()
    cut.write_bytes(content[: len(content) // 2])  # within the second of its chunks
    recording = open_recording(cut)
    assert not recording.has_skeletons and recording.rendered
    track, warnings = track_of(recording, cache=tmp_path / "cache")
    assert len(track.times) > 5
    assert any("cut off" in warning for warning in warnings)


def test_a_bag_without_images_or_skeletons_says_what_it_holds(tmp_path: Path) -> None:
    path = tmp_path / "sound.mcap"
    with path.open("wb") as stream:
        writer = Writer(stream)
        writer.start(profile="ros2", library="test")
        schema = writer.register_schema("std_msgs/msg/String", "ros2msg", b"string data")
        channel = writer.register_channel("/sound", "cdr", schema)
        writer.add_message(channel, 1, b"\x00\x01\x00\x00\x02\x00\x00\x00a\x00", 1)
        writer.finish()
    with refused("no_skeletons", "/sound"):
        open_recording(path)


@pytest.fixture
def colour_only(tmp_path: Path) -> Path:
    """The first images of the shipped bag, without their depth."""
    path = tmp_path / "colour_only.mcap"
    with Reader(SHIPPED) as reader, path.open("wb") as stream:
        writer = Writer(stream)
        writer.start(profile="ros2", library="test")
        channels = {}
        for connection in reader.connections:
            if "depth" in connection.topic or "truth" in connection.topic:
                continue
            definition = connection.msgdef.data.encode()
            schema = writer.register_schema(connection.msgtype, "ros2msg", definition)
            channels[connection.id] = writer.register_channel(connection.topic, "cdr", schema)
        for index, (connection, time, data) in enumerate(reader.messages()):
            if connection.id in channels and index < 60:
                writer.add_message(channels[connection.id], time, bytes(data), time)
        writer.finish()
    return path


def test_a_bag_without_depth_is_refused_in_the_retrievers_words(colour_only: Path, tmp_path: Path) -> None:
    with refused("no_depth", "run `retrieve --depth-topic NAME` first"):
        track_of(open_recording(colour_only), cache=tmp_path / "cache")
    assert not list((tmp_path / "cache").glob("*.mcap"))


def test_a_worker_that_may_start_no_process_retrieves_by_itself(
    colour_only: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(keypoint_search, "current_process", lambda: SimpleNamespace(daemon=True))
    monkeypatch.setattr(keypoint_search, "get_context", lambda method: pytest.fail(f"a process by {method}"))
    with refused("no_depth", "depth"):
        find_skeletons(colour_only, tmp_path / "out.mcap")


@pytest.mark.slow
def test_a_retriever_that_dies_is_told_and_leaves_nothing(tmp_path: Path) -> None:
    def kill(*_: int) -> None:
        for process in active_children():
            process.kill()

    with refused("not_retrieved", "exit status -9"):
        track_of(open_recording(SHIPPED), cache=tmp_path, on_progress=kill)
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_whoever_watches_can_stop_the_retriever(tmp_path: Path) -> None:
    class StoppedError(Exception):
        pass

    def stop(done: int, total: int) -> None:
        assert (done, total) == (1, 315)
        raise StoppedError

    with pytest.raises(StoppedError):
        track_of(open_recording(SHIPPED), cache=tmp_path, on_progress=stop)
    assert not active_children()
    assert not list(tmp_path.iterdir())
