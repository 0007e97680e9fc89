# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path

import bag_take
import camera_take as take
import numpy as np
import pytest
from mcap.reader import make_reader
from refusals import refused
from rosbags.rosbag2 import StoragePlugin

from teo_skeleton_retriever.bags.bag_images import BagImages, choose_topics
from teo_skeleton_retriever.bags.bag_reader import Bag
from teo_skeleton_retriever.camera.rgbd_image import stamp_of
from teo_skeleton_retriever.errors import RetrieverError

IMAGES = 10
SLOP = 10**7


def write(folder: Path, kind: str, *, compressed: bool = False) -> Path:
    stored = list(bag_take.messages(IMAGES, compressed=compressed))
    match kind:
        case "ros1":
            return bag_take.write_ros1(folder / "take.bag", stored)
        case "ros1 packed":
            return bag_take.write_ros1(folder / "take.bag", stored, packed=True)
        case "sqlite":
            return bag_take.write_ros2(folder / "take", stored, StoragePlugin.SQLITE3)
    return bag_take.write_ros2(folder / "take", stored)


def images_of(path: Path) -> list[int]:
    bag = Bag(path)
    return [found.stamp for found in BagImages(bag, choose_topics(bag), slop=SLOP).images()]


@pytest.mark.parametrize(
    ("kind", "compressed"),
    [("ros1", False), ("ros1 packed", True), ("sqlite", False), ("mcap", False), ("mcap", True)],
)
def test_every_kind_of_bag_gives_its_images_depths_and_cameras(tmp_path, kind, compressed):
    bag = Bag(write(tmp_path, kind, compressed=compressed))
    found = list(BagImages(bag, choose_topics(bag), slop=SLOP).images())
    assert [one.stamp for one in found] == [take.START + i * take.PERIOD for i in range(IMAGES)]
    np.testing.assert_array_equal(found[3].image.color, take.color())
    np.testing.assert_allclose(found[3].image.depth, take.depth(), atol=1e-6)
    assert (found[3].image.camera.fx, found[3].frame_id) == (take.FOCAL, take.FRAME_ID)
    assert bag.problem == ""


def test_a_single_file_of_a_bag_is_a_bag(tmp_path):
    folder = write(tmp_path, "mcap")
    assert len(images_of(folder / "take.mcap")) == IMAGES
    (folder / "metadata.yaml").unlink()
    assert len(images_of(folder)) == IMAGES


@pytest.mark.parametrize("kind", ["ros1", "ros1 packed", "sqlite", "mcap"])
def test_a_bag_that_was_cut_off_anywhere_gives_what_is_there_and_says_so(tmp_path, kind):
    path = write(tmp_path, kind)
    file = path if path.is_file() else next(f for f in path.iterdir() if f.suffix in (".db3", ".mcap"))
    for share in (0.9, 0.6, *np.random.default_rng(0).random(4)):
        try:
            bag = Bag(bag_take.cut(file, share))
        except RetrieverError as refused_bag:
            assert (refused_bag.code, share < 0.6) == ("unreadable_bag", True)
            continue
        assert bag.problem.startswith("cut off")
        found = [stamp_of(one.message) for one in bag.messages([bag_take.COLOR])]
        assert found == [take.START + i * take.PERIOD for i in range(len(found))]
        # Of MCAP and packed files, whole chunks of a megabyte, here of two to four images.
        assert len(found) >= (min(share > 0.5, 1) if "packed" in kind else IMAGES * share - 4)


def test_damaged_chunks_of_a_bag_that_was_cut_off_are_told(tmp_path):
    whole = write(tmp_path, "mcap") / "take.mcap"
    with whole.open("rb") as stream:
        second_chunk = make_reader(stream).get_summary().chunk_indexes[1].chunk_start_offset
    file = bag_take.cut(whole, 0.9)
    before = Bag(file)
    assert "damaged chunks" not in before.problem
    data = bytearray(file.read_bytes())
    checksum = second_chunk + 33  # after opcode, length, both times and the size
    data[checksum : checksum + 4] = b"\x01\x02\x03\x04"
    file.write_bytes(data)
    bag = Bag(file)
    assert 0 < bag.counts[bag_take.COLOR] < before.counts[bag_take.COLOR]
    assert bag.problem.startswith("cut off")
    assert bag.problem.endswith("; 1 damaged chunks are left out")


def test_a_message_that_is_not_of_its_type_is_left_out_and_told(tmp_path):
    stored = list(bag_take.messages(4))
    topic, _, time, _ = stored[1]
    stored.insert(2, (topic, bag_take.IMAGE, time + 1, take.camera_info(0)))
    bag = Bag(bag_take.write_ros2(tmp_path / "take", stored))
    assert len(list(bag.messages([bag_take.COLOR]))) == 4
    assert bag_take.COLOR in bag.problem


@pytest.mark.parametrize("content", [b"", b"#ROSBAG V1.2\n", b"#ROSBAG V2.0\n", b"\x00" * 5000])
@pytest.mark.parametrize("suffix", [".bag", ".mcap", ".db3"])
def test_what_is_no_bag_is_refused(tmp_path, content, suffix):
    path = tmp_path / f"take{suffix}"
    path.write_bytes(content)
    with refused("unreadable_bag"):
        Bag(path)


@pytest.mark.parametrize(
    ("name", "code"), [("none", "missing_bag"), ("take.txt", "no_bag"), (".", "unreadable_bag")]
)
def test_a_missing_bag_another_file_and_a_folder_without_a_bag_are_refused(tmp_path, name, code):
    (tmp_path / "take.txt").write_text("hello")
    with refused(code):
        Bag(tmp_path / name)


def renamed(stored: list[bag_take.Stored], names: dict[str, str]) -> list[bag_take.Stored]:
    return [(names.get(topic, topic), kind, time, message) for topic, kind, time, message in stored]


def infrared_and_raw_depth() -> list[bag_take.Stored]:
    grey = take.image_message(take.color()[:, :, 0].copy(), "mono8", 1)
    return [
        ("/camera/infra1/image_rect_raw", bag_take.IMAGE, 1, grey),
        ("/camera/depth/image_rect_raw", bag_take.IMAGE, 1, take.depth_message(1)),
        ("/camera/depth/camera_info", bag_take.CAMERA_INFO, 1, take.camera_info(1)),
    ]


@pytest.mark.parametrize(
    ("names", "others"),
    [
        ((bag_take.COLOR, bag_take.DEPTH, bag_take.INFO), True),
        (("/left/color/image", "/left/depth_registered/image", "/left/color/camera_info"), True),
        (("/rgb/image", "/d", "/k"), False),
    ],
)
def test_topics_are_found_by_what_they_hold_aligned_depth_first_and_infrared_last(tmp_path, names, others):
    usual = dict(zip((bag_take.COLOR, bag_take.DEPTH, bag_take.INFO), names, strict=True))
    stored = [*(infrared_and_raw_depth() if others else []), *renamed(list(bag_take.messages(2)), usual)]
    assert choose_topics(Bag(bag_take.write_ros2(tmp_path / "take", stored))) == names


def test_images_that_cannot_be_used_are_counted_with_a_reason(tmp_path):
    stored = list(bag_take.messages(5))
    stored[4] = (*stored[4][:3], take.color_message(stored[4][2], encoding="odd"))
    del stored[8]
    bag = Bag(bag_take.write_ros2(tmp_path / "take", stored))
    reader = BagImages(bag, choose_topics(bag), slop=SLOP)
    assert len(list(reader.images())) == 3
    assert reader.dropped == {"wrong_encoding": 1, "no_depth": 1}
    assert "odd" in reader.reasons["wrong_encoding"]


def test_images_before_the_first_camera_info_are_used(tmp_path):
    stored = list(bag_take.messages(5))
    late = [one for one in stored if one[0] != bag_take.INFO] + [stored[-3]]
    assert len(images_of(bag_take.write_ros2(tmp_path / "take", late))) == 5
