# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import io
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pose_format import Pose
from pose_format.numpy import NumPyPoseBody
from pose_format.pose_header import PoseHeader, PoseHeaderComponent, PoseHeaderDimensions
from pose_format.utils.openpose import OpenPose_Components
from scipy.spatial.transform import Rotation

from teo_common.arrays import Array
from teo_sign_capture.recordings import pose_file
from teo_sign_capture.recordings.pose_file import read_pose_file
from teo_sign_capture.recordings.skeleton_bag import read_skeletons
from teo_signs.errors import LutError
from teo_skeleton_retriever.lifting.clip import PoseClip

SHIPPED = Path(__file__).resolve().parents[4] / "bags" / "signer_d435"
# MediaPipe's names, as its documentation gives them.
ARM = ("SHOULDER", "ELBOW", "WRIST", "PINKY", "INDEX", "THUMB")
LEG = ("HIP", "KNEE", "ANKLE", "HEEL", "FOOT_INDEX")
POSE = (
    "NOSE",
    *(f"{side}_EYE{part}" for side in ("LEFT", "RIGHT") for part in ("_INNER", "", "_OUTER")),
    *("LEFT_EAR", "RIGHT_EAR", "MOUTH_LEFT", "MOUTH_RIGHT"),
    *(f"{side}_{name}" for name in (*ARM, *LEG) for side in ("LEFT", "RIGHT")),
)
FINGERS = ("INDEX_FINGER", "MIDDLE_FINGER", "RING_FINGER", "PINKY")
HAND = (
    "WRIST",
    *(f"THUMB_{name}" for name in ("CMC", "MCP", "IP", "TIP")),
    *(f"{finger}_{joint}" for finger in FINGERS for joint in ("MCP", "PIP", "DIP", "TIP")),
)
HANDS = {"LEFT_HAND_LANDMARKS": HAND, "RIGHT_HAND_LANDMARKS": HAND}
HOLISTIC = {"POSE_LANDMARKS": POSE, "FACE_LANDMARKS": tuple(map(str, range(478))), **HANDS}
SPREAD = {"LEFT": 1.0, "RIGHT": -1.0}


def place(component: str, name: str) -> tuple[float, float]:
    """Where a point of a person in the middle of a picture of 640 by 480 is [pixel]."""
    side = next((sign for word, sign in SPREAD.items() if word in f"{component}_{name}"), 0.0)
    heights = {"SHOULDER": 200, "ELBOW": 330, "WRIST": 250, "HIP": 420, "NOSE": 100, "EYE": 90, "EAR": 95}
    height = next((y for word, y in heights.items() if word in name), 300)
    if component.endswith("HAND_LANDMARKS"):
        finger, joint = divmod(HAND.index(name), 4)
        return 320.0 + side * 120.0 + 6.0 * finger, 250.0 - 12.0 * joint
    return 320.0 + side * 80.0, float(height)


def points(components: dict[str, Sequence[str]]) -> Array:
    """Shape (K, 3)."""
    found = [(*place(component, name), 0.1) for component, names in components.items() for name in names]
    return np.array(found)


def person(frames: int = 8) -> Array:
    """Shape (T, 1, K, 3)."""
    return np.tile(points(HOLISTIC), (frames, 1, 1, 1))


HOLED = person()
HOLED[2, 0, 5, 1] = np.nan


def write(
    path: Path,
    components: dict[str, Sequence[str]] | list[PoseHeaderComponent] = HOLISTIC,
    data: Array | None = None,
    confidence: Array | None = None,
    *,
    rate: float = 25.0,
    size: tuple[int, int] = (640, 480),
) -> Path:
    if isinstance(components, dict):
        if data is None:
            data = np.tile(points(components), (8, 1, 1, 1))
            data += 1e-3 * np.arange(8)[:, None, None, None]
        components = [
            PoseHeaderComponent(name, list(names), [], [], "XYZC") for name, names in components.items()
        ]
    assert data is not None
    if confidence is None:
        confidence = np.ones(data.shape[:3])
    header = PoseHeader(0.2, PoseHeaderDimensions(*size), components)
    buffer = io.BytesIO()
    Pose(header, NumPyPoseBody(rate, data.astype(np.float32), confidence.astype(np.float32))).write(buffer)
    path.write_bytes(buffer.getvalue())
    return path


def code_of(path: Path, **options: Any) -> str:
    with pytest.raises(LutError) as error:
        read_pose_file(path, **options)
    assert path.name in str(error.value)
    assert "expected" in str(error.value)
    return error.value.code


def test_places_are_forward_left_and_up(tmp_path: Path) -> None:
    clip = read_pose_file(write(tmp_path / "a.pose"))
    assert clip.rate == 25.0
    left, right = clip.body.places[0, 5], clip.body.places[0, 2]
    # Depths of the body are a tenth of the picture's width.
    np.testing.assert_allclose(left, [-0.1 * 640, 400.0, -200.0], atol=1e-4)
    np.testing.assert_allclose(right, [-0.1 * 640, 240.0, -200.0], atol=1e-4)
    np.testing.assert_allclose(clip.right_hand.places[0, 8, 1:], [200.0 + 12.0, -250.0], atol=12.0 * 4)
    assert not clip.body.seen[:, 10].any()  # legs are not read
    assert clip.hand("left").seen.all()


@pytest.mark.parametrize(
    "components",
    [
        {"POSE_LANDMARKS": POSE, **HANDS},
        {"POSE_LANDMARKS": POSE, **HANDS, "POSE_WORLD_LANDMARKS": POSE},
        {"POSE_LANDMARKS": POSE, "FACE_LANDMARKS": tuple(map(str, range(128))), **HANDS},
        {"POSE_LANDMARKS": POSE[11:17] + POSE[23:25], **HANDS},  # as pose-format reduces it
        {"RIGHT_HAND_LANDMARKS": HAND, "POSE_LANDMARKS": POSE},
    ],
    ids=["no face", "with world", "face of 128", "reduced body", "one hand, other order"],
)
def test_every_variant_of_the_components_is_read_alike(
    tmp_path: Path, components: dict[str, Sequence[str]]
) -> None:
    whole = read_pose_file(write(tmp_path / "whole.pose"))
    part = read_pose_file(write(tmp_path / "part.pose", components))
    for row in (2, 3, 4, 5, 6, 7):
        np.testing.assert_allclose(part.body.places[:, row], whole.body.places[:, row], atol=1e-4)
    np.testing.assert_allclose(part.right_hand.places, whole.right_hand.places, atol=1e-4)


def openpose(frames: int = 5) -> tuple[list[PoseHeaderComponent], Array]:
    def place(component: str, index: int, name: str) -> tuple[float, float]:
        if component != "pose_keypoints_2d":
            return 200.0 + index, 250.0 - index
        height = {"Shoulder": 200.0, "Elbow": 330.0, "Wrist": 250.0}.get(name[1:], 100.0)
        return 320.0 + 80.0 * {"R": -1.0, "L": 1.0}.get(name[0], 0.0), height

    rows = [place(one.name, *point) for one in OpenPose_Components for point in enumerate(one.points)]
    return list(OpenPose_Components), np.tile(np.array(rows), (frames, 1, 1, 1))


def test_openpose_is_read_and_has_no_depth(tmp_path: Path) -> None:
    clip = read_pose_file(write(tmp_path / "o.pose", *openpose()))
    np.testing.assert_allclose(clip.body.places[0, 2, 1:], [240.0, -200.0])
    np.testing.assert_allclose(clip.right_hand.places[0, 20, 1:], [220.0, -230.0])
    assert np.isnan(clip.right_hand.places[..., 0]).all()


def test_fractions_of_the_picture_become_pixels(tmp_path: Path) -> None:
    pixels = read_pose_file(write(tmp_path / "pixels.pose"))
    data = person() / [640.0, 480.0, 1.0]
    fractions = read_pose_file(write(tmp_path / "fractions.pose", HOLISTIC, data))
    np.testing.assert_allclose(fractions.body.places[0, :8, 1:], pixels.body.places[0, :8, 1:], atol=1e-3)


def test_a_clip_scaled_to_its_shoulders_keeps_its_units(tmp_path: Path) -> None:
    data = (person() - [320.0, 200.0, 0.0]) / [160.0, 160.0, 1.0]
    clip = read_pose_file(write(tmp_path / "scaled.pose", HOLISTIC, data))
    across = clip.body.places[0, 5] - clip.body.places[0, 2]
    np.testing.assert_allclose(across[1:], [1.0, 0.0], atol=1e-6)


def test_points_of_confidence_zero_are_lost(tmp_path: Path) -> None:
    confidence = np.ones((8, 1, points(HOLISTIC).shape[0]))
    confidence[3, 0, -21:] = 0.0
    data = person()
    data[3, 0, -21:] = np.nan  # whatever is there
    clip = read_pose_file(write(tmp_path / "holes.pose", HOLISTIC, data, confidence))
    assert np.isnan(clip.right_hand.places[3]).all()
    assert clip.right_hand.seen[[0, 1, 2, 4, 5, 6, 7]].all()


def test_of_several_people_one_must_be_named_and_an_empty_place_is_nobody(tmp_path: Path) -> None:
    data = np.concatenate([person(), person() + np.array([50.0, 0.0, 0.0])], axis=1)
    confidence = np.ones(data.shape[:3])
    path = write(tmp_path / "two.pose", HOLISTIC, data, confidence)
    assert code_of(path) == "several_people"
    assert read_pose_file(path, person=1).body.places[0, 5, 1] == pytest.approx(450.0)
    assert code_of(path, person=2) == "no_person"
    assert code_of(path, person=-1) == "no_person"
    confidence[:, 1] = 0.0
    assert read_pose_file(write(tmp_path / "one.pose", HOLISTIC, data, confidence)).rate == 25.0
    confidence[:] = 0.0
    assert code_of(write(tmp_path / "none.pose", HOLISTIC, data, confidence)) == "no_person"


@pytest.mark.parametrize(
    ("code", "made"),
    [
        *(("bad_rate", {"rate": rate}) for rate in (0.0, -25.0, math.nan, math.inf, 1e6)),
        ("too_short", {"data": person(0)}),
        ("too_short", {"data": person(1)}),
        ("non_finite", {"data": HOLED}),
        ("unknown_layout", {"components": {"BODY_135": ("Nose", "LEye", "REye")}}),
        ("unknown_layout", {"components": {"POSE_LANDMARKS": POSE, "RIGHT_HAND_LANDMARKS": HAND[:15]}}),
        ("no_hand", {"components": {"POSE_LANDMARKS": POSE}}),
        ("no_torso", {"components": {"POSE_LANDMARKS": POSE[13:17], **HANDS}}),
        ("seen_from_behind", {"data": person() * [-1.0, 1.0, 1.0] + [640.0, 0.0, 0.0]}),  # mirrored
    ],
)
def test_a_clip_of_which_no_sign_can_be_made_is_refused(
    tmp_path: Path, code: str, made: dict[str, Any]
) -> None:
    assert code_of(write(tmp_path / "bad.pose", **made)) == code


@pytest.mark.parametrize("seed", range(4))
def test_points_that_are_no_persons_are_called_so(tmp_path: Path, seed: int) -> None:
    """Whichever way round the pairs of them happen to be."""
    places = np.random.default_rng(seed).uniform(0.0, 480.0, person(40).shape)
    assert code_of(write(tmp_path / "junk.pose", HOLISTIC, places)) == "no_body"


def test_shoulders_that_a_detector_confused_are_not_a_person_from_behind(tmp_path: Path) -> None:
    data = person()
    names = HOLISTIC["POSE_LANDMARKS"]
    left, right = names.index("LEFT_SHOULDER"), names.index("RIGHT_SHOULDER")
    data[:, :, [left, right]] = data[:, :, [right, left]]
    assert read_pose_file(write(tmp_path / "confused.pose", HOLISTIC, data)).body.seen.any()


@pytest.fixture(scope="module")
def signer() -> Array:
    """Body and hands of the shipped recording's signer, facing the camera. Shape (T, 67, 3)."""
    truth = read_skeletons(SHIPPED, topic="/truth/skeletons").between(0.0, 2.0)
    return np.concatenate(
        [part.positions for part in (truth.body, truth.left_hand, truth.right_hand)], axis=1
    )


@pytest.mark.parametrize("turn", (0, 50, 130, 180, 230, 310))
def test_who_turns_the_back_to_the_camera_is_refused(tmp_path: Path, signer: Array, turn: float) -> None:
    """Turned on the spot; sideways, from 70 to 110 deg, is left to chance."""
    places = signer
    turned = Rotation.from_euler("z", turn, degrees=True).apply(places.reshape(-1, 3)).reshape(places.shape)
    seen = np.zeros((*places.shape[:2], 4))
    seen[..., 0], seen[..., 1] = 320.0 + 300.0 * turned[..., 1], 240.0 - 300.0 * turned[..., 2]
    seen[..., 3] = np.isfinite(turned).all(axis=2)
    file = tmp_path / "turned.pose"
    file.write_bytes(pose_file.pose_file(15.0, np.nan_to_num(seen), (640, 480)))
    if abs(turn - 180.0) <= 70.0:
        assert code_of(file) == "seen_from_behind"
    else:
        assert read_pose_file(file).body.seen.any()


def test_no_file_no_bytes_and_too_many_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert code_of(tmp_path / "missing.pose") == "unreadable"
    assert code_of(tmp_path) == "unreadable"
    (tmp_path / "empty.pose").touch()
    assert code_of(tmp_path / "empty.pose") == "empty_file"
    path = write(tmp_path / "large.pose")
    monkeypatch.setattr(pose_file, "MAX_FRAMES", 7)
    assert code_of(path) == "too_long"
    monkeypatch.setattr(pose_file, "MAX_FILE_BYTES", path.stat().st_size - 1)
    assert code_of(path) == "too_large"


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(share=st.floats(0.0, 0.999))
def test_a_file_that_was_cut_off_is_refused(tmp_path: Path, share: float) -> None:
    whole = write(tmp_path / "whole.pose", {"POSE_LANDMARKS": POSE, **HANDS}).read_bytes()
    path = tmp_path / "cut.pose"
    path.write_bytes(whole[: int(share * len(whole))])
    assert code_of(path) in ("bad_pose_file", "empty_file")


@settings(max_examples=80, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(changes=st.lists(st.tuples(st.floats(0.0, 0.999), st.integers(0, 255)), min_size=1, max_size=5))
def test_damage_is_refused_or_harmless(tmp_path: Path, changes: list[tuple[float, int]]) -> None:
    content = bytearray(write(tmp_path / "whole.pose", {"POSE_LANDMARKS": POSE, **HANDS}).read_bytes())
    for share, value in changes:
        content[int(share * len(content))] = value
    path = tmp_path / "damaged.pose"
    path.write_bytes(content)
    try:
        assert isinstance(read_pose_file(path), PoseClip)
    except LutError as error:
        assert "expected" in str(error)
