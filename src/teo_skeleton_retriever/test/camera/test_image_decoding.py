# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import struct
import zlib

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from refusals import refused

from teo_skeleton_retriever.camera.image_decoding import (
    COLOR_ENCODINGS,
    decode_color,
    decode_compressed_color,
    decode_compressed_depth,
    decode_depth,
    decode_rvl,
)
from teo_skeleton_retriever.errors import RetrieverError

RGB = np.random.default_rng(0).integers(0, 256, (6, 8, 3), dtype=np.uint8)
GREY = np.ascontiguousarray(RGB[:, :, 0])


def decoded(data: bytes, encoding: str, step: int = 0) -> np.ndarray:
    return decode_color(data, width=8, height=6, encoding=encoding, step=step)


@pytest.mark.parametrize(
    ("encoding", "pixels", "expected"),
    [
        ("rgb8", RGB, RGB),
        ("bgr8", RGB[:, :, ::-1], RGB),
        ("8UC3", RGB[:, :, ::-1], RGB),
        ("rgba8", np.dstack([RGB, GREY]), RGB),
        ("bgra8", np.dstack([RGB[:, :, ::-1], GREY]), RGB),
        ("8UC4", np.dstack([RGB[:, :, ::-1], GREY]), RGB),
        ("mono8", GREY, np.dstack([GREY] * 3)),
        ("8UC1", GREY, np.dstack([GREY] * 3)),
    ],
)
def test_every_order_of_channels_becomes_rgb(encoding, pixels, expected):
    np.testing.assert_array_equal(decoded(pixels.tobytes(), encoding), expected)


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
    channels = {"rgb8": 3, "bgr8": 3, "8UC3": 3, "rgba8": 4, "bgra8": 4, "8UC4": 4, "mono8": 1, "8UC1": 1}
    width = 8 * channels.get(encoding, 2)
    rows = np.random.default_rng(1).integers(0, 256, (6, width), dtype=np.uint8)
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
    with refused(code, "expected"):
        decode_color(**(good | fields))


MILLIMETRES, METRES = [[0, 1, 1500], [1500, 65535, 2]], [[1.25, math.inf, 0.0], [-1.0, math.nan, 2.0]]


@pytest.mark.parametrize(
    ("encoding", "kind", "values", "expected"),
    [
        ("16UC1", "u2", MILLIMETRES, [[math.nan, 0.001, 1.5], [1.5, 65.535, 0.002]]),
        ("32FC1", "f4", METRES, [[1.25, math.nan, math.nan], [math.nan, math.nan, 2.0]]),
    ],
)
@pytest.mark.parametrize(("order", "padding"), [("<", b""), (">", b"\xff" * 4)])
def test_depths_of_any_byte_order_and_padding_become_metres_and_what_is_none_unknown(
    encoding, kind, values, expected, order, padding
):
    rows = np.array(values, dtype=order + kind)
    data, step = b"".join(row.tobytes() + padding for row in rows), rows.strides[0] + len(padding)
    depth = decode_depth(data, width=3, height=2, encoding=encoding, step=step, big_endian=order == ">")
    np.testing.assert_allclose(depth, expected, rtol=1e-6)
    assert depth.dtype == np.float32


@pytest.mark.parametrize(
    ("fields", "code"),
    [
        ({"encoding": "rgb8"}, "wrong_encoding"),
        ({"width": 0}, "bad_size"),
        ({"height": 3}, "wrong_length"),
        ({"encoding": "32FC1"}, "wrong_length"),
        ({"step": 2}, "wrong_length"),
        ({"step": 100}, "wrong_length"),
    ],
)
def test_sizes_of_depth_that_do_not_fit_are_refused(fields, code):
    with refused(code):
        decode_depth(bytes(8), **({"width": 2, "height": 2, "encoding": "16UC1"} | fields))


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


def gigantic() -> bytes:
    """The head of a picture of a million by a million."""
    chunk = b"IHDR" + struct.pack(">IIBBBBB", 1 << 20, 1 << 20, 8, 2, 0, 0, 0)
    head = b"\x89PNG\r\n\x1a\n" + struct.pack(">I", 13) + chunk
    return head + struct.pack(">I", zlib.crc32(chunk)) + bytes(50)


@pytest.mark.parametrize("data", [b"", b"\x00" * 100, png(SCENE)[:40], gigantic()])
def test_what_is_no_picture_is_refused(data):
    with refused("not_an_image"):
        decode_compressed_color(data)


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
    with refused(code):
        decode_compressed_depth(data, message_format)
