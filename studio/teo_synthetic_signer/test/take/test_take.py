# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import itertools
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_synthetic_signer import Companion, SyntheticFrame, Take, TakeOptions, render_take
from teo_synthetic_signer.body.surface import RayCaster
from teo_synthetic_signer.errors import SyntheticError
from teo_synthetic_signer.take.furniture import furnish

SMALL = {"width": 320, "height": 240}
SKIN = {  # least and greatest depth of a joint's centre behind what the camera sees of the person [m]
    "Shoulder": (0.02, 0.13),
    "Elbow": (0.015, 0.09),
    "Wrist": (0.005, 0.055),
    "Hip": (0.04, 0.2),
    "Eye": (-0.01, 0.012),
}


def perfect(**options: Any) -> Take:
    return Take(TakeOptions(scene="studio", perfect_depth=True, **{**SMALL, **options}))


@pytest.fixture(scope="module")
def take() -> Take:
    return perfect(script="signing")


@pytest.fixture(scope="module")
def still() -> Take:
    return perfect(script="still")


@pytest.fixture(scope="module")
def frames(take: Take) -> list[SyntheticFrame]:
    return [take.frame(i) for i in range(5, len(take), 40)]


def behind(frame: SyntheticFrame, points: np.ndarray) -> np.ndarray:
    """How far points are behind the surface in the depth image [m]; NaN outside it."""
    pixels = np.rint(frame.camera.project(points)).astype(int)
    result = np.full(len(points), np.nan)
    height, width = frame.depth.shape
    for i, (x, y) in enumerate(pixels):
        if 0 <= x < width and 0 <= y < height:
            result[i] = points[i, 2] - frame.depth[y, x]
    return result


def parts(frame: SyntheticFrame) -> list[tuple[np.ndarray, np.ndarray]]:
    truth = frame.truth
    return [
        (truth.body, truth.body_visible),
        (truth.left_hand, truth.left_hand_visible),
        (truth.right_hand, truth.right_hand_visible),
        (truth.face, truth.face_visible),
    ]


def test_visible_keypoints_lie_on_the_person_in_the_picture(frames: list[SyntheticFrame]) -> None:
    total = inside = 0
    for frame, (points, seen) in itertools.chain.from_iterable(((f, p) for p in parts(f)) for f in frames):
        depth = behind(frame, points[seen])
        total += seen.sum()
        inside += (depth > -0.6).sum()  # not on the wall, which is 1.5 m behind
        assert np.isfinite(points).all()
    ankles = [BODY_25.index["RAnkle"], BODY_25.index["LAnkle"]]  # outside the picture: known, not visible
    assert not frames[0].truth.body_visible[ankles].any()
    assert (frames[0].camera.project(frames[0].truth.body[ankles])[:, 1] > 240).all()
    assert total > 60 * len(frames)
    assert inside > 0.98 * total  # a fingertip may be within a pixel of the outline


@pytest.mark.parametrize("name", SKIN)
def test_joints_lie_behind_the_skin_by_as_much_as_in_people(frames: list[SyntheticFrame], name: str) -> None:
    rows = [BODY_25.index[side + name] for side in "RL"]
    measured = [
        value
        for frame in frames
        for row, value in zip(rows, behind(frame, frame.truth.body[rows]), strict=True)
        if frame.truth.body_visible[row]
    ]
    assert len(measured) > len(frames) / 2
    low, high = SKIN[name]
    assert np.median(measured) > low
    assert np.median(measured) < high


def test_visible_finger_joints_lie_a_few_millimetres_below_the_skin(frames: list[SyntheticFrame]) -> None:
    depths = np.concatenate([behind(f, points)[seen] for f in frames for points, seen in parts(f)[1:3]])
    assert len(depths) > 50
    assert 0.004 < np.median(depths[np.abs(depths) < 0.1]) < 0.02


def test_pupils_are_dark_and_the_whites_beside_them_are_not() -> None:
    frame = perfect(
        width=640, height=480, distance=0.8, camera_height=1.6, camera_pitch=0.0, script="still"
    ).frame(20)
    for pupil, corner in ((68, 36), (69, 45)):
        places = frame.truth.face[[pupil, corner]]
        white = places.mean(axis=0)
        x, y = np.rint(frame.camera.project(np.array([places[0], white]))).astype(int).T
        assert frame.color[y[0], x[0]].mean() + 40 < frame.color[y[1], x[1]].mean()


def test_what_a_hand_or_an_arm_covers_is_hidden_and_seen_again_after() -> None:
    take = perfect(script="face", body="man_average")
    nose = BODY_25.index["Nose"]
    seen = [take.truth(i).truth.body_visible[nose] for i in range(0, len(take), 8)]
    assert seen[0] and seen[-1] and not all(seen)
    take = perfect(script="crossing", body="man_average")
    covered = 0.0
    for i in range(0, len(take), 8):
        truth = take.truth(i).truth
        covered = max(covered, 1.0 - truth.right_hand_visible.mean())
    assert covered > 0.6


def test_the_same_options_give_the_same_frame_in_any_order_and_another_seed_other_noise() -> None:
    options = TakeOptions(scene="studio", sensor="d435", seed=3, **SMALL)
    first, again, other = Take(options), Take(options), Take(replace(options, seed=4))
    again.frame(7)
    a, b, c = first.frame(20), again.frame(20), other.frame(20)
    np.testing.assert_array_equal(a.color, b.color)
    np.testing.assert_array_equal(a.depth, b.depth)
    np.testing.assert_array_equal(a.truth.body, b.truth.body)
    assert (a.depth != c.depth).mean() > 0.3
    np.testing.assert_array_equal(a.truth.face, c.truth.face)


def test_the_person_drawn_over_the_room_is_what_one_cast_of_both_gives(take: Take) -> None:
    frame = take.frame(60)
    signer, pose = take._actors[0].signer, take.motion.pose(frame.stamp)
    person = take._seen(signer.vertices(pose, signer.poser.transforms(pose)))
    walls, room = furnish("studio")
    corners = np.concatenate([person[signer.dress.surface.triangles], take._seen(walls)[room.triangles]])
    rows, columns = np.indices(frame.depth.shape)
    pixels = np.column_stack([columns.ravel(), rows.ravel()]).astype(np.float64)
    hits = RayCaster(corners).cast(frame.camera.rays(pixels).astype(np.float32))
    expected = np.where(np.isfinite(hits.distance), hits.distance, np.nan).reshape(frame.depth.shape)
    np.testing.assert_allclose(frame.depth, expected, rtol=1e-5)


def test_a_camera_that_is_rolled_turns_the_image_about_its_middle(still: Take) -> None:
    level, rolled = still.truth(0), perfect(script="still", camera_roll=0.3).truth(0)
    middle = np.array([level.camera.cx, level.camera.cy])
    a, b = (truth.camera.project(truth.truth.body) - middle for truth in (level, rolled))
    turned = np.arctan2(b[:, 1], b[:, 0]) - np.arctan2(a[:, 1], a[:, 0])
    np.testing.assert_allclose((turned + np.pi) % (2.0 * np.pi) - np.pi, -0.3, atol=1e-6)
    np.testing.assert_allclose(np.linalg.norm(a, axis=1), np.linalg.norm(b, axis=1))


def test_another_light_changes_the_colours_and_nothing_else(still: Take) -> None:
    room, evening = still.frame(0), perfect(script="still", light="evening").frame(0)
    np.testing.assert_array_equal(room.depth, evening.depth)
    assert evening.color.mean() < 0.8 * room.color.mean()
    red, _, blue = (evening.color.astype(float) / room.color).mean(axis=(0, 1))
    assert red > 1.1 * blue


def test_a_companion_before_the_signer_hides_the_signer_and_has_a_truth_too(still: Take) -> None:
    alone = still.truth(0)
    both = perfect(script="still", companions=(Companion(body="man_tall", behind=-0.4, aside=0.0),)).frame(0)
    np.testing.assert_allclose(both.truth.body, alone.truth.body)
    assert alone.truth.body_visible[BODY_25.index["Neck"]]
    assert not both.truth.body_visible[BODY_25.index["Neck"]]
    (other,) = both.others
    neck = BODY_25.index["Neck"]
    assert other.body_visible[neck]
    column, row = np.rint(both.camera.project(other.body[[neck]])[0]).astype(int)
    assert other.body[neck, 2] - 0.17 < both.depth[row, column] < other.body[neck, 2]
    assert other.body[neck, 2] < alone.truth.body[neck, 2] - 0.3


@pytest.mark.parametrize(
    ("options", "code"),
    [
        ({"distance": 0.0}, "bad_distance"),
        ({"distance": float("nan")}, "bad_distance"),
        ({"rate": 0.0}, "bad_rate"),
        ({"rate": float("inf")}, "bad_rate"),
        ({"camera_height": -1.0}, "bad_camera_height"),
        ({"camera_pitch": 2.0}, "bad_camera_pitch"),
        ({"camera_roll": 4.0}, "bad_camera_roll"),
        ({"light": "neon"}, "unknown_light"),
        ({"companions": (Companion(body="nobody"),)}, "unknown_body"),
        ({"width": 0}, "bad_size"),
        ({"height": 100_000}, "bad_size"),
        ({"sensor": "d999"}, "unknown_sensor"),
        ({"scene": "moon"}, "unknown_scene"),
        ({"script": "dance"}, "unknown_script"),
        ({"body": "nobody"}, "unknown_body"),
    ],
)
def test_a_bad_option_is_refused_with_its_reason(options: dict[str, Any], code: str) -> None:
    with pytest.raises(SyntheticError, match=code):
        next(iter(render_take(**options)))
