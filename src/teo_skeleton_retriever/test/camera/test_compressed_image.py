# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import struct
import zlib

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from teo_skeleton_retriever.camera.image_decoding import (
    decode_compressed_color,
    decode_compressed_depth,
    decode_rvl,
)
from teo_skeleton_retriever.errors import RetrieverError

HEADER = struct.pack("<iff", 0, 0.0, 0.0)
GRADIENT = np.add.outer(np.arange(40), np.arange(60) * 2).astype(np.uint8)
SCENE = np.dstack([GRADIENT, GRADIENT[::-1], GRADIENT[:, ::-1]])


def png(image: np.ndarray) -> bytes:
    return cv2.imencode(".png", image)[1].tobytes()


def rvl(values: np.ndarray) -> bytes:
    """Encode bit by bit, as the paper describes it."""
    nibbles: list[int] = []

    def number(value: int) -> None:
        while True:
            value, low = value >> 3, value & 7
            nibbles.append(low | (8 if value else 0))
            if not value:
                return

    flat, place, previous = values.ravel().tolist(), 0, 0
    while place < len(flat):
        begin = place
        while place < len(flat) and not flat[place]:
            place += 1
        number(place - begin)
        begin = place
        while place < len(flat) and flat[place]:
            place += 1
        number(place - begin)
        for value in flat[begin:place]:
            difference, previous = value - previous, value
            number(2 * difference if difference >= 0 else -2 * difference - 1)
    nibbles += [0] * (-len(nibbles) % 8)
    words = [int("".join(f"{n:x}" for n in nibbles[i : i + 8]), 16) for i in range(0, len(nibbles), 8)]
    return struct.pack(f"<{len(words)}I", *words)


def test_a_png_gives_back_its_colours_and_a_jpeg_nearly():
    np.testing.assert_array_equal(decode_compressed_color(png(SCENE[:, :, ::-1])), SCENE)
    jpeg = cv2.imencode(".jpg", SCENE[:, :, ::-1], [cv2.IMWRITE_JPEG_QUALITY, 95])[1].tobytes()
    assert np.abs(decode_compressed_color(jpeg).astype(int) - SCENE).mean() < 3


@pytest.mark.parametrize("data", [b"", b"\x00" * 100, png(SCENE)[:40], b"\x89PNG\r\n\x1a\n"])
def test_what_is_no_picture_is_refused(data):
    with pytest.raises(RetrieverError) as refused:
        decode_compressed_color(data)
    assert refused.value.code == "not_an_image"


@pytest.mark.parametrize(
    "message_format", ["16UC1; compressedDepth png", "16UC1; compressedDepth", "16UC1;compressedDepth png"]
)
def test_millimetres_as_png_come_back_in_metres(message_format):
    depth = np.array([[0, 1, 500], [1500, 40000, 65535]], dtype=np.uint16)
    got = decode_compressed_depth(HEADER + png(depth), message_format)
    np.testing.assert_allclose(got, [[np.nan, 0.001, 0.5], [1.5, 40.0, 65.535]], rtol=1e-6)


@pytest.mark.parametrize("codec", ["png", "rvl"])
def test_metres_are_quantised_by_their_inverse_and_come_back(codec):
    # As the plugin does it with its defaults: depth_max 10 m, depth_quantization 100.
    a, b = 100.0 * 101.0, 1.0 - 100.0 * 101.0 / 10.0
    depth = np.array([[0.5, 1.0, 1.5], [2.5, 9.9, np.nan]], dtype=np.float32)
    plane = np.where(np.isfinite(depth), np.round(a / depth + b), 0).astype(np.uint16)
    body = png(plane) if codec == "png" else struct.pack("<II", 3, 2) + rvl(plane)
    got = decode_compressed_depth(struct.pack("<iff", 0, a, b) + body, f"32FC1; compressedDepth {codec}")
    np.testing.assert_allclose(got, depth, rtol=0.01)


@settings(deadline=None, max_examples=60)
@given(
    arrays(
        np.uint16,
        st.tuples(st.integers(1, 12), st.integers(1, 20)),
        elements=st.one_of(st.just(0), st.integers(0, 65535)),
    )
)
def test_any_image_comes_back_from_rvl(values):
    np.testing.assert_array_equal(decode_rvl(rvl(values), values.size), values.ravel())
    data = HEADER + struct.pack("<II", values.shape[1], values.shape[0]) + rvl(values)
    got = decode_compressed_depth(data, "16UC1; compressedDepth rvl")
    np.testing.assert_allclose(np.nan_to_num(got), values * 0.001, rtol=1e-6)


@settings(deadline=None, max_examples=100)
@given(st.binary(max_size=80), st.integers(1, 50))
def test_no_bytes_make_rvl_do_more_than_refuse(data, pixels):
    try:
        assert decode_rvl(data, pixels).shape == (pixels,)
    except RetrieverError as refused:
        assert refused.code in ("wrong_length", "wrong_data")


@pytest.mark.parametrize(
    ("code", "data", "message_format"),
    [
        ("wrong_encoding", HEADER + png(GRADIENT.astype(np.uint16)), "jpeg"),
        ("wrong_encoding", HEADER + png(GRADIENT.astype(np.uint16)), ""),
        ("wrong_length", HEADER[:5], "16UC1; compressedDepth png"),
        ("wrong_length", HEADER, "16UC1; compressedDepth png"),
        ("wrong_data", HEADER + png(GRADIENT), "16UC1; compressedDepth png"),
        ("wrong_data", HEADER + png(GRADIENT.astype(np.uint16))[:60], "16UC1; compressedDepth png"),
        ("wrong_length", HEADER + b"abc", "16UC1; compressedDepth rvl"),
        ("bad_size", HEADER + struct.pack("<II", 1 << 31, 1 << 31), "16UC1; compressedDepth rvl"),
        ("wrong_length", HEADER + struct.pack("<II", 4, 4), "16UC1; compressedDepth rvl"),
    ],
)
def test_what_is_no_depth_is_refused_with_a_reason(code, data, message_format):
    with pytest.raises(RetrieverError) as refused:
        decode_compressed_depth(data, message_format)
    assert refused.value.code == code


def test_a_picture_that_claims_to_be_gigantic_is_refused():
    chunk = b"IHDR" + struct.pack(">IIBBBBB", 1 << 20, 1 << 20, 8, 2, 0, 0, 0)
    data = (
        b"\x89PNG\r\n\x1a\n"
        + struct.pack(">I", 13)
        + chunk
        + struct.pack(">I", zlib.crc32(chunk))
        + bytes(50)
    )
    with pytest.raises(RetrieverError):
        decode_compressed_color(data)
