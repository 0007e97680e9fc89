# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import pytest

from teo_skeleton_retriever.camera.image_decoding import decode_depth
from teo_skeleton_retriever.errors import RetrieverError


def test_whole_millimetres_become_metres_and_zero_unknown() -> None:
    data = np.array([[0, 1], [1500, 65535]], dtype="<u2")
    depth = decode_depth(data.tobytes(), width=2, height=2, encoding="16UC1")
    np.testing.assert_allclose(depth, [[math.nan, 0.001], [1.5, 65.535]], rtol=1e-6)
    assert depth.dtype == np.float32


def test_metres_stay_and_what_is_no_distance_becomes_unknown() -> None:
    data = np.array([[1.25, math.nan, math.inf, -math.inf, 0.0, -1.0]], dtype="<f4")
    depth = decode_depth(data.tobytes(), width=6, height=1, encoding="32FC1")
    np.testing.assert_array_equal(depth, np.array([[1.25] + [math.nan] * 5], dtype=np.float32))


@pytest.mark.parametrize("encoding", ["16UC1", "32FC1"])
def test_byte_order_and_padding_are_heeded(encoding: str) -> None:
    kind = {"16UC1": ">u2", "32FC1": ">f4"}[encoding]
    rows = np.array([[1, 2, 3], [4, 5, 6]], dtype=kind)
    padded = b"".join(row.tobytes() + b"\xff\xff\xff\xff" for row in rows)
    step = 3 * rows.itemsize + 4
    depth = decode_depth(padded, width=3, height=2, encoding=encoding, step=step, big_endian=True)
    scale = 1e-3 if encoding == "16UC1" else 1.0
    np.testing.assert_allclose(depth, rows.astype(float) * scale, rtol=1e-6)


@pytest.mark.parametrize(
    ("width", "height", "encoding", "step", "code"),
    [
        (2, 2, "rgb8", 0, "wrong_encoding"),
        (0, 2, "16UC1", 0, "bad_size"),
        (2, -1, "16UC1", 0, "bad_size"),
        (1 << 20, 1 << 20, "16UC1", 0, "bad_size"),
        (2, 3, "16UC1", 0, "wrong_length"),
        (2, 2, "32FC1", 0, "wrong_length"),
        (2, 2, "16UC1", 2, "wrong_length"),
        (2, 2, "16UC1", 100, "wrong_length"),
    ],
)
def test_sizes_that_do_not_fit_are_refused(
    width: int, height: int, encoding: str, step: int, code: str
) -> None:
    with pytest.raises(RetrieverError) as caught:
        decode_depth(bytes(8), width=width, height=height, encoding=encoding, step=step)
    assert caught.value.code == code
