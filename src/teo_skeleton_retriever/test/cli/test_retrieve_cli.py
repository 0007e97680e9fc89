# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import math
from pathlib import Path

import av
import bag_take
import camera_take as take
import cv2
import numpy as np
import pytest
from mcap_ros2.reader import read_ros2_messages
from rosbags.highlevel import AnyReader
from typer.testing import CliRunner

from teo_skeleton_retriever.cli.retrieve_cli import _app
from teo_skeleton_retriever.layouts.layout import BODY_25

IMAGES = 10
WRIST = BODY_25.index["RWrist"]


@pytest.fixture
def seen(keypoints: Path) -> list[str]:
    """Options that replay keypoints instead of looking for them."""
    return ["--detector", "replay", "--detector-option", f"folder={keypoints}"]


def run(*words: object) -> tuple[int, str, str]:
    result = CliRunner().invoke(_app, [str(word) for word in words])
    return result.exit_code, result.stdout, result.stderr


def test_a_bag_becomes_a_bag_of_skeletons_that_others_can_read(bag, seen, tmp_path):
    out = tmp_path / "out.mcap"
    code, stdout, _ = run(bag, "--out", out, *seen)
    assert code == 0
    assert "images" in stdout
    messages = [one.ros_msg for one in read_ros2_messages(out)]
    stamps = [m.header.stamp.sec * 10**9 + m.header.stamp.nanosec for m in messages]
    assert stamps == [take.START + i * take.PERIOD for i in range(IMAGES)]
    (person,) = messages[-1].skeletons
    assert person.is_signer
    assert person.body[WRIST].name == "RWrist"
    assert 0.0 <= person.body[WRIST].position.z - take.DISTANCE < 0.1
    assert math.isnan(person.body[BODY_25.index["RAnkle"]].position.x)
    with AnyReader([out]) as reader:  # checks the hash of the type as well
        assert [(c.topic, c.msgtype) for c in reader.connections] == [
            ("/skeletons", "teo_sign_msgs/msg/SkeletonArray")
        ]


def test_the_film_shows_every_image_at_its_time(bag, seen, tmp_path):
    film = tmp_path / "out.mp4"
    assert run(bag, "--video", film, *seen)[0] == 0
    with av.open(str(film)) as container:
        frames = list(container.decode(video=0))
    assert len(frames) == IMAGES
    np.testing.assert_allclose([frame.time for frame in frames], np.arange(IMAGES) / take.RATE, atol=2e-3)
    shown = frames[-1].to_ndarray(format="rgb24").astype(int)
    assert np.abs(shown - take.color()).max() > 100  # the skeleton


def test_json_is_a_line_for_each_image_and_nothing_else_on_the_output(bag, seen):
    code, stdout, _ = run(bag, "--json", *seen)
    lines = [json.loads(line) for line in stdout.splitlines()]
    assert (code, len(lines)) == (0, IMAGES)
    wrist = lines[-1]["skeletons"][0]["body"]["RWrist"]
    assert wrist["status"] in ("measured", "optimised")
    np.testing.assert_allclose(wrist["pixel"], [130, 155], atol=1e-3)


def test_one_image_is_enough(seen, tmp_path):
    color, depth, info = (tmp_path / name for name in ("a.png", "b.png", "c.json"))
    cv2.imwrite(str(color), take.color()[:, :, ::-1])
    cv2.imwrite(str(depth), (take.depth() * 1000).astype(np.uint16))
    k = [300, 0, 159.5, 0, 300, 119.5, 0, 0, 1]
    info.write_text(json.dumps({"width": take.WIDTH, "height": take.HEIGHT, "k": k, "d": []}))
    files = ["--color", color, "--depth", depth, "--camera-info", info]
    code, stdout, _ = run(*files, "--json", *seen)
    (person,) = json.loads(stdout)["skeletons"]
    assert code == 0
    x, y, z = person["body"]["RWrist"]["position"]
    assert 0.0 <= z - take.DISTANCE < 0.1
    np.testing.assert_allclose([x / z, y / z], [(130 - 159.5) / 300, (155 - 119.5) / 300], atol=0.03)
    assert "RWrist" in run(*files, *seen)[1]
    info.write_text("{}")
    code, _, stderr = run(*files, *seen)
    assert (code, "bad_camera_info" in stderr) == (1, True)


@pytest.mark.parametrize(
    "words",
    [
        [],
        ["BAG", "--color", "a.png"],
        ["--color", "a.png", "--depth", "b.png"],
        ["BAG", "--compat", "other"],
        ["BAG", "-p", "nonsense"],
        ["BAG", "-p", "unknown=1"],
        ["BAG", "-p", "max_depth=far"],
        ["BAG", "-p", "max_depth=-1"],
        ["BAG", "--detector-option", "folder"],
        ["--color", "a", "--depth", "b", "--camera-info", "c", "--out", "x.mcap"],
    ],
)
def test_wrong_options_are_refused(bag, words):
    code, _, _ = run(*(bag if word == "BAG" else word for word in words))
    assert code == 2


@pytest.mark.parametrize(
    ("code", "words"),
    [
        ("missing_bag", ["none.mcap"]),
        ("unknown_detector", ["BAG", "--detector", "guess"]),
        ("unknown_topic", ["BAG", "--color-topic", "/none"]),
        ("bad_name", ["BAG", "--out", "x.bag"]),
        ("missing_folder", ["BAG", "--video", "none/x.mp4"]),
        ("unreadable_file", ["--color", "a", "--depth", "b", "--camera-info", "c"]),
    ],
)
def test_what_cannot_be_read_or_written_is_told_with_its_reason(bag, seen, code, words):
    options = [] if "--detector" in words else seen
    status, _, stderr = run(*(bag if word == "BAG" else word for word in words), *options)
    assert (status, code in stderr) == (1, True)


def changed(tmp_path, change, topic=bag_take.DEPTH, images=IMAGES):
    """A bag whose messages of a topic are others."""
    stored = [
        (name, kind, time, change(time) if name == topic else message)
        for name, kind, time, message in bag_take.messages(images)
    ]
    return bag_take.write_ros2(tmp_path / "changed", stored)


def test_a_film_without_an_image_is_not_said_to_be_written(seen, tmp_path):
    bag = changed(tmp_path, lambda time: take.color_message(time, encoding="odd"), bag_take.COLOR, 2)
    out, film = tmp_path / "x.mcap", tmp_path / "x.mp4"
    code, stdout, _ = run(bag, "--color-topic", bag_take.COLOR, "--out", out, "--video", film, *seen)
    assert (code, film.exists()) == (1, False)
    assert f"wrote {out}" in stdout
    assert f"wrote {film}" not in stdout


def centimetres(metres):
    """Of the person; the wall is too far off for the camera."""
    return np.where(metres < take.WALL, 100 * metres, 0).astype(np.uint16)


@pytest.mark.parametrize(
    ("cause", "pixels", "encoding"),
    [
        ("no pixel of the depth image has a depth", lambda metres: 0 * metres.astype(np.uint16), "16UC1"),
        ("units? 32FC1 is to be in metres", lambda metres: 1000 * metres, "32FC1"),
        ("units? 16UC1 is to be in millimetres", lambda metres: metres.astype(np.uint16), "16UC1"),
        ("units? 16UC1 is to be in millimetres", centimetres, "16UC1"),
        ("between min_depth and max_depth", lambda metres: 6 + metres, "32FC1"),
    ],
)
def test_people_whom_no_depth_places_are_told_with_the_likely_cause(tmp_path, seen, cause, pixels, encoding):
    bag = changed(tmp_path, lambda time: take.image_message(pixels(take.depth()), encoding, time))
    code, _, stderr = run(bag, "--json", *seen)
    assert code == 1
    assert f"1 person in colour, nobody in space, in {IMAGES} images" in stderr
    assert cause in stderr


def test_who_begins_a_recording_counts_at_once_and_who_enters_after_a_trial_that_can_be_set(
    bag, keypoints, tmp_path, seen
):
    def people(*options):
        _, stdout, _ = run(bag, "--json", *options, *seen)
        return [len(json.loads(line)["skeletons"]) for line in stdout.splitlines()]

    assert people("-p", "newcomer_images=5") == [1] * IMAGES
    first = min(keypoints.glob("*.json"))
    first.write_text(json.dumps({"version": 1.3, "people": []}))
    assert people("-p", "newcomer_images=5") == [0] * 5 + [1] * (IMAGES - 5)
    short = bag_take.write_ros2(tmp_path / "short", list(bag_take.messages(2)))
    code, _, stderr = run(short, *seen)
    assert (code, "-p newcomer_images=1" in stderr) == (1, True)
    assert run(short, "-p", "newcomer_images=1", *seen)[0] == 0


def test_stamps_too_far_apart_are_told_with_the_bound_that_pairs_them(tmp_path, seen):
    bag = changed(tmp_path, lambda time: take.depth_message(time + take.PERIOD // 2 + 8_000_000))
    code, _, stderr = run(bag, "--slop", "0.005", *seen)
    assert code == 1
    assert "got the nearest 0.0" in stderr
    proposed = stderr.partition("--slop ")[2].split()[0]
    assert run(bag, "--slop", proposed, *seen)[0] == 0


@pytest.mark.parametrize("seconds", [-5, 5])
def test_stamps_of_different_clocks_are_told_and_no_slop_is_proposed(tmp_path, seen, seconds):
    bag = changed(tmp_path, lambda time: take.depth_message(time + seconds * 10**9))
    code, _, stderr = run(bag, *seen)
    assert code == 1
    assert "different clocks" in stderr
    assert "--slop" not in stderr
    assert f"no image of {bag_take.COLOR} could be used: {IMAGES} left out, no_depth" in stderr


def test_a_raw_mosaic_is_explained(tmp_path, seen):
    mosaic = take.color()[..., 0]
    bag = changed(tmp_path, lambda time: take.image_message(mosaic, "bayer_rggb8", time), bag_take.COLOR, 2)
    for options in ([], ["--color-topic", bag_take.COLOR]):
        code, _, stderr = run(bag, *options, *seen)
        assert (code, "debayer" in stderr) == (1, True)
        assert "name it" not in stderr  # the name is not what is wrong
