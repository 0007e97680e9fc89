# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from typer.testing import CliRunner

from teo_skeleton_retriever.camera.rgbd_image import camera_of, color_of, depth_of
from teo_synthetic_signer import SyntheticFrame, render_take
from teo_synthetic_signer.cli.synthesize_cli import _app
from teo_synthetic_signer.errors import SyntheticError
from teo_synthetic_signer.take.take_files import START, write_take

MESSAGES = Path(__file__).parents[4] / "src" / "teo_sign_msgs" / "msg"
COLOR, DEPTH = "/camera/color/image_raw", "/camera/aligned_depth_to_color/image_raw"
SMALL = {"width": 160, "height": 120, "scene": "studio", "rate": 10.0}


@pytest.fixture(scope="module")
def frames() -> list[SyntheticFrame]:
    return list(render_take(frames=range(3), **SMALL))


def read(bag: Path) -> dict[str, list[tuple[int, object]]]:
    """All messages of a bag by topic, read by software that is not ours."""
    store = get_typestore(Stores.ROS2_JAZZY)
    for name in ("Keypoint3D", "Skeleton3D", "SkeletonArray"):
        text = (MESSAGES / f"{name}.msg").read_text()
        store.register(get_types_from_msg(text, f"teo_sign_msgs/msg/{name}"))
    found: dict[str, list[tuple[int, object]]] = {}
    with AnyReader([bag], default_typestore=store) as reader:
        for connection, time, data in reader.messages():
            message = reader.deserialize(data, connection.msgtype)
            found.setdefault(connection.topic, []).append((time, message))
    return found


@pytest.mark.parametrize("raw", [False, True])
def test_images_camera_and_truth_come_back(tmp_path: Path, frames: list[SyntheticFrame], raw: bool) -> None:
    bag = tmp_path / "take"
    assert list(write_take(frames, bag, raw=raw)) == [1, 2, 3]
    found = read(bag)
    color = COLOR if raw else f"{COLOR}/compressed"
    depth = DEPTH if raw else f"{DEPTH}/compressedDepth"
    assert set(found) == {color, depth, "/camera/color/camera_info", "/truth/skeletons"}
    for i, frame in enumerate(frames):
        time, image = found[color][i]
        assert time == START + i * 100_000_000
        assert np.abs(color_of(image).astype(int) - frame.color).mean() < (0.01 if raw else 4.0)
        back = depth_of(found[depth][i][1])
        np.testing.assert_array_equal(np.isnan(back), np.isnan(frame.depth))
        np.testing.assert_allclose(back, frame.depth, atol=5.1e-4)
        camera = camera_of(found["/camera/color/camera_info"][i][1])
        assert (camera.fx, camera.fy, camera.cx, camera.cy) == pytest.approx(
            (frame.camera.fx, frame.camera.fy, frame.camera.cx, frame.camera.cy)
        )
        for messages in found.values():
            stamp, header = messages[i][0], messages[i][1].header
            assert header.stamp.sec * 10**9 + header.stamp.nanosec == stamp
            assert header.frame_id == "camera_color_optical_frame"
        skeleton = found["/truth/skeletons"][i][1].skeletons[0]
        points = np.array([[k.position.x, k.position.y, k.position.z] for k in skeleton.body])
        np.testing.assert_allclose(points, frame.truth.body)
        assert [k.name for k in skeleton.right_hand][4] == "ThumbTip"
        assert [k.status == 1 for k in skeleton.face] == frame.truth.face_visible.tolist()
        assert {k.status for k in skeleton.body} <= {1, 2}
        assert skeleton.is_signer


@pytest.mark.parametrize(("folder", "code"), [("take", "output_exists"), ("nowhere/take", "missing_folder")])
def test_a_folder_that_exists_or_has_no_parent_is_refused(
    tmp_path: Path, frames: list[SyntheticFrame], folder: str, code: str
) -> None:
    (tmp_path / "take").mkdir()
    with pytest.raises(SyntheticError, match=code):
        list(write_take(frames, tmp_path / folder))
    assert list(tmp_path.rglob("*")) == [tmp_path / "take"]


def test_a_take_that_is_stopped_leaves_nothing_behind(tmp_path: Path, frames: list[SyntheticFrame]) -> None:
    writing = write_take(frames, tmp_path / "take")
    next(writing)
    writing.close()
    assert list(tmp_path.iterdir()) == []


def run(*words: str) -> tuple[int, str]:
    result = CliRunner().invoke(_app, list(words), env={"COLUMNS": "200", "TERM": "dumb"})
    return result.exit_code, result.output


def test_synthesize_gives_the_same_images_for_the_same_seed_and_their_truth_alone(
    tmp_path: Path, frames: list[SyntheticFrame]
) -> None:
    common = ("--sensor", "D435", "--scene", "studio", "--size", "160x120", "--rate", "10", "--frames", "3")
    code, output = run("--out", str(tmp_path / "take"), *common)
    assert code == 0 and "3 frames" in output, output
    list(write_take(frames, tmp_path / "again"))
    take, again = read(tmp_path / "take"), read(tmp_path / "again")
    for topic in (f"{COLOR}/compressed", f"{DEPTH}/compressedDepth"):
        for (_, first), (_, second) in zip(take[topic], again[topic], strict=True):
            np.testing.assert_array_equal(first.data, second.data)
    assert run("--out", str(tmp_path / "truth"), "--truth-only", *common)[0] == 0
    found = read(tmp_path / "truth")
    assert set(found) == {"/truth/skeletons"}
    for (time, message), frame in zip(found["/truth/skeletons"], frames, strict=True):
        assert time == START + round(frame.stamp * 1e9)
        hand = message.skeletons[0].right_hand
        points = np.array([[k.position.x, k.position.y, k.position.z] for k in hand])
        np.testing.assert_allclose(points, frame.truth.right_hand)
        assert [k.status == 1 for k in hand] == frame.truth.right_hand_visible.tolist()


@pytest.mark.parametrize(
    ("status", "words", "said"),
    [
        (0, ("--list",), "woman_small"),
        (1, ("--out", ".", "--scene", "studio", "--size", "64x48", "--frames", "1"), "output_exists"),
        (2, (), "--out"),
        (2, ("--out", "take", "--script", "x.yaml"), "x.yaml:3: keys.0.left"),
        (2, ("--out", "take", "--body", "nobody"), "woman_average"),
        (2, ("--out", "take", "--distance", "50"), "expected 0.2 to 6.0 m"),
        (2, ("--out", "take", "--size", "640"), "640x480"),
        (2, ("--out", "take", "--size", "-640x480"), "640x480"),
        (2, ("--out", "take", "--seed", "-1"), "seed"),
    ],
)
def test_synthesize_lists_what_there_is_and_refuses_what_it_cannot_do(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, status: int, words: tuple[str, ...], said: str
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("x.yaml").write_text("about: x\nkeys:\n- {right: hanging, left: hangin}\n- {}\n")
    code, output = run(*words)
    assert code == status
    assert said in output
    assert not Path("take").exists()


def test_the_shipped_bag_is_small_and_whole() -> None:
    bag = Path(__file__).parents[4] / "bags" / "signer_d435"
    assert sum(file.stat().st_size for file in bag.iterdir()) < 10_000_000
    found = read(bag)
    assert {topic: len(messages) for topic, messages in found.items()} == dict.fromkeys(
        (
            f"{COLOR}/compressed",
            f"{DEPTH}/compressedDepth",
            "/camera/color/camera_info",
            "/truth/skeletons",
        ),
        105,
    )
    image = color_of(found[f"{COLOR}/compressed"][50][1])
    depth = depth_of(found[f"{DEPTH}/compressedDepth"][50][1])
    assert image.shape == (480, 640, 3)
    skeleton = found["/truth/skeletons"][50][1].skeletons[0]
    nose = skeleton.body[0]
    column, row = np.rint(nose.pixel).astype(int)
    assert depth[row, column] == pytest.approx(nose.position.z, abs=0.05)
