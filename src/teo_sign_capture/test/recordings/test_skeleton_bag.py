# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from ament_index_python.packages import get_package_share_directory
from builtin_interfaces.msg import Time
from made_bags import messages, signing, write_bag
from made_tracks import HANGING, lose, make_track
from mcap.reader import make_reader
from rclpy.serialization import serialize_message
from refusals import refused
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from std_msgs.msg import Header
from teo_sign_msgs.msg import SkeletonArray

from teo_sign_capture.recordings.skeleton_bag import read_skeletons
from teo_signs.errors import LutError

SHIPPED = Path(__file__).resolve().parents[4] / "bags" / "signer_d435"
TYPE = "teo_sign_msgs/msg/SkeletonArray"


@pytest.fixture(scope="module")
def store():
    folder = Path(get_package_share_directory("teo_sign_msgs")) / "msg"
    store = get_typestore(Stores.ROS2_JAZZY)
    for name in ("Keypoint3D", "Skeleton3D", "SkeletonArray"):
        text = (folder / f"{name}.msg").read_text(encoding="utf-8")
        store.register(get_types_from_msg(text, f"teo_sign_msgs/msg/{name}"))
    return store


def skeleton(number, *, signer=True, keypoints=25, lost_hand=False):
    """A person before the camera whose hands hang."""
    still = make_track(np.zeros(1), np.array([HANGING["right"]]))
    (message,) = messages(lose(still, "right_hand", 0.0, 0.0) if lost_hand else still, person=number)
    (person,) = message.skeletons
    person.is_signer = signer
    person.body = person.body[:keypoints]
    for keypoint in () if lost_hand else person.right_hand:
        keypoint.sigma, keypoint.confidence = np.array([0.01, 0.02, 0.03], np.float32), 0.9
    return person


def write(store, path, frames, topics=("/skeletons",), start=1_750_000_000):
    """Write a bag; frames are pairs of a stamp [s] and the skeletons then."""
    with Writer(path, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connections = [writer.add_connection(topic, TYPE, typestore=store) for topic in topics]
        for index, (stamp, people) in enumerate(frames):
            time = Time(sec=start + int(stamp), nanosec=round((stamp - int(stamp)) * 1e9))
            message = SkeletonArray(header=Header(stamp=time, frame_id="camera"), skeletons=people)
            for connection in connections:
                data = bytes(serialize_message(message))
                writer.write(connection, 10**9 * start + index * 10**7, data)
    return path


def test_the_shipped_truth_keeps_all_distances_of_its_messages(store):
    track = read_skeletons(SHIPPED, topic="/truth/skeletons")
    with (SHIPPED / "signer_d435_0.mcap").open("rb") as stream:
        read = make_reader(stream).iter_messages(topics=["/truth/skeletons"])
        messages = [store.deserialize_cdr(message.data, TYPE) for _, _, message in read]
    assert len(track.times) == len(messages) == 105
    assert track.times == pytest.approx(np.arange(105) / 15.0, abs=1e-6)
    for frame in (0, 40, 104):
        raw = messages[frame].skeletons[0]
        points = [(p.position.x, p.position.y, p.position.z) for p in (*raw.body, *raw.right_hand)]
        ours = np.concatenate([track.body.positions[frame], track.right_hand.positions[frame]])
        raw_distances = np.linalg.norm(np.array(points)[:, None] - np.array(points), axis=2)
        distances = np.linalg.norm(ours[:, None] - ours, axis=2)
        assert distances == pytest.approx(raw_distances, abs=1e-9)
    # The nose is before and above the shoulders, the person's right is at negative y.
    assert (track.body.positions[:, 0, (0, 2)] > 0.03).all()
    assert (track.body.positions[:, 2, 1] < -0.1).all()
    assert track.source == "signer_d435"
    assert track.recorded is None  # rendered: stamps tell no day


def test_the_signer_is_followed_and_anybody_else_when_asked(store, tmp_path):
    people = [(0.1 * i, [skeleton(3, signer=False), skeleton(8)]) for i in range(3)]
    bag = write(store, tmp_path / "bag", people)
    assert read_skeletons(bag).body.positions.shape == (3, 25, 3)
    assert read_skeletons(bag, signer=3).recorded == "2025-06-15"
    with refused("no_person", "id 7.*3, 8"):
        read_skeletons(bag, signer=7)


def test_fields_of_a_keypoint_are_read(store, tmp_path):
    frames = [(0.0, [skeleton(1)]), (0.1, [skeleton(1, lost_hand=True)]), (0.2, [])]
    track = read_skeletons(write(store, tmp_path / "bag", frames))
    assert track.right_hand.sigma[0] == pytest.approx(np.sqrt((1 + 4 + 9) / 3.0) * 0.01)
    assert track.right_hand.confidence[0] == pytest.approx(0.9)
    assert np.isnan(track.right_hand.positions[1:]).all()
    assert track.right_hand.status[:, 0].tolist() == [1, 0, 0]
    assert np.isnan(track.body.positions[2]).all()


def test_several_topics_are_told_apart_by_name(store, tmp_path):
    frames = [(0.1 * i, [skeleton(1)]) for i in range(3)]
    both = write(store, tmp_path / "both", frames, topics=("/other", "/skeletons"))
    assert len(read_skeletons(both).times) == 3
    unclear = write(store, tmp_path / "unclear", frames, topics=("/one", "/two"))
    with refused("no_skeletons", "/one, /two"):
        read_skeletons(unclear)
    assert len(read_skeletons(unclear, topic="/two").times) == 3


def test_a_bag_without_skeletons_says_how_to_make_them():
    with refused("no_skeletons", "retrieve") as error:
        read_skeletons(SHIPPED)
    assert "/truth/skeletons" in str(error.value)


@pytest.mark.parametrize(
    ("code", "said", "frames"),
    [
        ("no_person", "2 frames, got nobody", [(0.0, []), (0.1, [])]),
        ("no_person", "--person", [(0.0, [{"signer": False}])]),
        ("no_skeletons", "messages", []),
        ("bad_stamps", "later", [(stamp, [{}]) for stamp in (0.0, 0.2, 0.1)]),
        ("unreadable_bag", "25 keypoints of the body", [(0.0, [{"keypoints": 18}])]),
    ],
)
def test_a_bag_without_a_person_to_follow_is_refused(store, tmp_path, code, said, frames):
    made = [(stamp, [skeleton(4, **person) for person in people]) for stamp, people in frames]
    with refused(code, said):
        read_skeletons(write(store, tmp_path / "bag", made))


@pytest.mark.parametrize(("times", "tall"), [(0.1, "0.169 m"), (100.0, "169 m")])
def test_depth_in_another_unit_is_told_by_the_size_of_the_person(tmp_path, times, tall):
    """Depth in centimetres, taken for millimetres or for metres."""
    track = signing(rate=15.0)
    body = replace(track.body, positions=times * track.body.positions)
    bag = write_bag(tmp_path / "bag.mcap", replace(track, body=body))
    with refused("wrong_depth", f"{tall} tall: depth must be in millimetres"):
        read_skeletons(bag)


@pytest.mark.parametrize("kept", [0, 40, 3000])
def test_a_bag_of_which_nothing_is_left_is_refused(store, tmp_path, kept):
    bag = write(store, tmp_path / "bag", [(0.1 * i, [skeleton(1)]) for i in range(20)])
    [file] = bag.glob("*.mcap")
    file.write_bytes(file.read_bytes()[:kept])
    for path in (bag, file):
        with refused("unreadable_bag"):
            read_skeletons(path)


@pytest.mark.parametrize("cut", [20, 1000])
def test_a_bag_without_its_index_is_read_and_said_to_be_cut_off(store, tmp_path, cut):
    bag = write(store, tmp_path / "bag", [(0.1 * i, [skeleton(1)]) for i in range(20)])
    [file] = bag.glob("*.mcap")
    file.write_bytes(file.read_bytes()[:-cut])
    for path in (bag, file):
        track = read_skeletons(path)
        assert len(track.times) == 20
        assert track.damage.startswith("cut off, 20 messages can be read")


def test_scrambled_bytes_within_a_bag_are_refused_or_read_but_never_crash(store, tmp_path):
    bag = write(store, tmp_path / "bag", [(0.1 * i, [skeleton(1)]) for i in range(5)])
    [file] = bag.glob("*.mcap")
    good = bytearray(file.read_bytes())
    random = np.random.default_rng(0)
    for _ in range(10):
        bad = good.copy()
        for place in random.integers(100, len(good) - 10, 20):
            bad[place] ^= 0xFF
        file.write_bytes(bad)
        try:
            read_skeletons(bag)
        except LutError as error:
            assert error.code in ("unreadable_bag", "no_skeletons", "no_person", "no_torso", "bad_stamps")
