# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from teo_skeleton_retriever.camera.image_decoding import COLOR_ENCODINGS, decode_color
from teo_skeleton_retriever.errors import RetrieverError

RGB = np.random.default_rng(0).integers(0, 256, (6, 8, 3), dtype=np.uint8)
GREY = np.ascontiguousarray(RGB[:, :, 0])


def decoded(data: bytes, encoding: str, step: int = 0) -> np.ndarray:
    return decode_color(data, width=8, height=6, encoding=encoding, step=step)


@pytest.mark.parametrize(
    ("encoding", "pixels"),
    [
        ("rgb8", RGB),
        ("bgr8", RGB[:, :, ::-1]),
        ("8UC3", RGB[:, :, ::-1]),
        ("rgba8", np.dstack([RGB, GREY])),
        ("bgra8", np.dstack([RGB[:, :, ::-1], GREY])),
        ("8UC4", np.dstack([RGB[:, :, ::-1], GREY])),
    ],
)
def test_every_order_of_channels_becomes_rgb(encoding, pixels):
    np.testing.assert_array_equal(decoded(pixels.tobytes(), encoding), RGB)


@pytest.mark.parametrize("encoding", ["mono8", "8UC1"])
def test_grey_becomes_three_equal_channels(encoding):
    np.testing.assert_array_equal(decoded(GREY.tobytes(), encoding), np.dstack([GREY] * 3))


@pytest.mark.parametrize(
    ("encoding", "order"), [("yuv422", "UYVY"), ("uyvy", "UYVY"), ("yuv422_yuy2", "YUYV"), ("yuyv", "YUYV")]
)
def test_yuv_422_becomes_the_colour_it_was_made_from(encoding, order):
    red, green, blue = 200, 60, 30
    # ITU-R BT.601 in the range of television, 16 to 235 and 16 to 240.
    luma = 0.299 * red + 0.587 * green + 0.114 * blue
    y = round(16 + luma * 219 / 255)
    u = round(128 + (blue - luma) / 1.772 * 224 / 255)
    v = round(128 + (red - luma) / 1.402 * 224 / 255)
    block = {"UYVY": [u, y, v, y], "YUYV": [y, u, y, v]}[order]
    data = np.tile(np.array(block, dtype=np.uint8), 6 * 4).tobytes()
    np.testing.assert_allclose(
        decoded(data, encoding).astype(int), np.full((6, 8, 3), (red, green, blue)), atol=3
    )


@given(st.integers(0, 9), st.sampled_from(COLOR_ENCODINGS))
def test_padding_of_rows_does_not_matter(padding, encoding):
    channels = {"rgb8": 3, "bgr8": 3, "8UC3": 3, "mono8": 1, "8UC1": 1}.get(
        encoding, 4 if "8" in encoding else 2
    )
    channels = 2 if encoding.startswith(("yuv", "uyvy", "yuyv")) else channels
    rows = np.random.default_rng(1).integers(0, 256, (6, 8 * channels), dtype=np.uint8)
    padded = np.hstack([rows, np.full((6, padding), 7, dtype=np.uint8)])
    # A driver may leave the padding of the last row out.
    data = padded.tobytes()[: padded.size - padding]
    np.testing.assert_array_equal(
        decoded(data, encoding, step=padded.shape[1]), decoded(rows.tobytes(), encoding)
    )


@pytest.mark.parametrize(
    ("code", "fields"),
    [
        ("wrong_encoding", {"encoding": "bayer_rggb8"}),
        ("wrong_encoding", {"encoding": "16UC1"}),
        ("wrong_encoding", {"encoding": ""}),
        ("bad_size", {"width": 0}),
        ("bad_size", {"height": -1}),
        ("bad_size", {"width": 1 << 20, "height": 1 << 20}),
        ("bad_size", {"encoding": "yuyv", "width": 7}),
        ("wrong_length", {"data": b""}),
        ("wrong_length", {"data": bytes(6 * 24 - 1)}),
        ("wrong_length", {"step": 23}),
    ],
)
def test_what_is_no_image_is_refused_with_a_reason(code, fields):
    good = {"data": bytes(6 * 24), "width": 8, "height": 6, "encoding": "rgb8"}
    with pytest.raises(RetrieverError) as refused:
        decode_color(**(good | fields))
    assert refused.value.code == code
    assert "expected" in refused.value.sentence
