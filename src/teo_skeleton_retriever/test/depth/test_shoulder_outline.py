# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.depth.girdle_depth import by_outline
from teo_skeleton_retriever.layouts.layout import BODY_25

FOCAL, JOINT = 600.0, 1.5  # [px], [m]
METRES = JOINT / FOCAL  # of a pixel
LEFT_EDGE, RIGHT_EDGE = 220, 420  # [px] the body's, 0.5 m apart
TRUTH = np.array([[LEFT_EDGE + 0.049 / METRES, 200.0], [RIGHT_EDGE - 0.049 / METRES, 200.0]])
ELBOWS = TRUTH + np.array([0.0, 110.0])
ROWS = [BODY_25.index[name] for name in ("RShoulder", "LShoulder")]


def body(wall: float = 3.0) -> FloatArray:
    depth = np.full((480, 640), wall)
    depth[150:, LEFT_EDGE:RIGHT_EDGE] = JOINT - 0.057
    return depth


def found(
    depth: FloatArray,
    shoulders: FloatArray,
    elbows: FloatArray = ELBOWS,
    at: tuple[float, float] = (JOINT, JOINT),
) -> tuple[FloatArray, list[bool]]:
    """Where the shoulders are put [px], and which by their outline."""
    seen = np.zeros((25, 3))
    seen[ROWS, :2], seen[ROWS, 2] = shoulders, 1.0
    seen[[BODY_25.index["RElbow"], BODY_25.index["LElbow"]]] = np.column_stack([elbows, np.ones(2)])
    told = by_outline(seen, depth.astype(np.float32), at=np.array(at), focal=FOCAL, scale=1.0)
    return told.keypoints[ROWS, :2], told.outlined.tolist()


@pytest.mark.parametrize("wall", [3.0, np.nan])
@pytest.mark.parametrize("off", [-0.03, -0.01, 0.02])
def test_shoulders_seen_too_wide_or_too_narrow_are_put_right(off: float, wall: float) -> None:
    seen = TRUTH + np.array([[-off], [off]]) / METRES * [1.0, 0.0]
    told, outlined = found(body(wall), seen)
    assert all(outlined)
    assert np.abs(told - TRUTH).max() * METRES < 0.3 * abs(off) + 0.003


def test_a_hole_in_the_depth_is_no_outline() -> None:
    depth = body()
    depth[190:210, 240:252] = np.nan
    told, _ = found(depth, TRUTH)
    assert np.abs(told - TRUTH).max() * METRES < 0.003


@pytest.mark.parametrize(
    "case",
    ["a hand is before it", "an arm points outwards", "somebody stands beside", "it is out of the image"],
)
def test_where_the_outline_is_not_the_shoulders_they_stay_as_seen(case: str) -> None:
    depth, seen, elbows = body(), TRUTH + np.array([[8.0, 0.0], [-8.0, 0.0]]), ELBOWS.copy()
    if case == "a hand is before it":
        depth[180:220, 200:235] = depth[180:220, 405:440] = JOINT - 0.35
    elif case == "an arm points outwards":
        elbows = TRUTH + np.array([[-90.0, 0.0], [90.0, 0.0]])
    elif case == "somebody stands beside":
        depth[150:] = JOINT - 0.05
    else:
        depth, seen, elbows = depth[:, 235:405], seen - [235.0, 0.0], elbows - [235.0, 0.0]
    told, outlined = found(depth, seen, elbows)
    assert not any(outlined)
    np.testing.assert_array_equal(told, seen)


def test_of_who_is_turned_nothing_is_said() -> None:
    _, outlined = found(body(), TRUTH, at=(1.4, 1.6))
    assert not any(outlined)
