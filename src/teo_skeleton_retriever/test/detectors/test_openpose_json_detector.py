# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from openpose_writer import format_frame, frame_path, write_frame
from refusals import refused

from teo_skeleton_retriever.detectors.openpose_files import People
from teo_skeleton_retriever.detectors.openpose_json_detector import (
    KeypointScale,
    OpenPoseJsonDetector,
    ReplayDetector,
)
from teo_skeleton_retriever.layouts.person_2d import Person2D

WIDTH, HEIGHT = 640, 480
IMAGE = np.zeros((HEIGHT, WIDTH, 3), np.uint8)


def frame(mark: int, people: int = 1) -> People:
    """People whose nose is at x = mark, so that one sees which file was read."""
    body = np.zeros((25, 3))
    body[0] = mark, 7.0, 0.5
    return (Person2D(body=body),) * people


def write(folder: Path, number: int, *, name: str = "{:012d}", people: int = 1) -> None:
    write_frame(frame_path(folder, name.format(number)), frame(number, people))


def mark_of(people: tuple[Person2D, ...]) -> int | None:
    return int(people[0].body[0, 0]) if people else None


def test_each_image_gets_the_next_file_in_the_order_of_numbers(tmp_path: Path) -> None:
    for number in (9, 10, 11):
        write(tmp_path, number, name="video_{}")
    detector = OpenPoseJsonDetector(folder=tmp_path)
    assert [mark_of(detector.detect(IMAGE, 0.1 * i)) for i in range(3)] == [9, 10, 11]


def test_a_frame_left_out_has_no_people_and_shifts_nothing(tmp_path: Path) -> None:
    for number in (0, 1, 3):
        write(tmp_path, number)
    detector = OpenPoseJsonDetector(folder=tmp_path)
    assert [mark_of(detector.detect(IMAGE, 0.1 * i)) for i in range(4)] == [0, 1, None, 3]
    assert detector.missing == 1


def test_a_half_written_file_is_waited_for(tmp_path: Path) -> None:
    text = format_frame(frame(5))
    path = frame_path(tmp_path, "0")
    path.write_text(text[: len(text) // 2])
    detector = OpenPoseJsonDetector(folder=tmp_path, wait=10.0)
    writer = threading.Timer(0.15, path.write_text, (text,))
    writer.start()
    assert mark_of(detector.detect(IMAGE, 0.0)) == 5
    writer.join()


@pytest.mark.parametrize("text", ["", '{"version":1.3,"peo'])
def test_a_file_that_stays_half_fails_its_own_image_only(tmp_path: Path, text: str) -> None:
    frame_path(tmp_path, "0").write_text(text)
    write(tmp_path, 1, name="{}")
    detector = OpenPoseJsonDetector(folder=tmp_path, wait=0.02)
    with refused("late"):
        detector.detect(IMAGE, 0.0)
    assert mark_of(detector.detect(IMAGE, 0.1)) == 1


def test_what_is_not_openposes_is_told_at_once(tmp_path: Path) -> None:
    frame_path(tmp_path, "0").write_text('{"version":1.3}')
    detector = OpenPoseJsonDetector(folder=tmp_path, wait=60.0)
    began = time.monotonic()
    with refused("bad_file"):
        detector.detect(IMAGE, 0.0)
    assert time.monotonic() - began < 30.0


def test_newest_skips_what_was_there_before_and_what_is_half_written(tmp_path: Path) -> None:
    write(tmp_path, 0)
    detector = OpenPoseJsonDetector(folder=tmp_path, pairing="newest", wait=0.02)
    with refused("late"):
        detector.detect(IMAGE, 0.0)
    for number in (1, 2):
        write(tmp_path, number)
    frame_path(tmp_path, f"{3:012d}").write_text("{")
    assert mark_of(detector.detect(IMAGE, 0.1)) == 2
    write(tmp_path, 3)
    assert mark_of(detector.detect(IMAGE, 0.2)) == 3
    with refused("late"):
        detector.detect(IMAGE, 0.3)


@pytest.mark.parametrize("headline", ["", "frame,stamp\n"])
def test_stamps_pair_images_in_any_order(tmp_path: Path, headline: str) -> None:
    for number in range(3):
        write(tmp_path, number)
    table = tmp_path / "stamps.csv"
    table.write_text(headline + "0,100.0\n2,100.066\n1,100.033\n")
    detector = OpenPoseJsonDetector(folder=tmp_path, stamps=table)
    assert [mark_of(detector.detect(IMAGE, stamp)) for stamp in (100.066, 100.03, 100.001)] == [2, 1, 0]
    assert detector.detect(IMAGE, 101.0) == ()
    assert detector.detect(IMAGE, 99.0) == ()
    assert detector.missing == 2


@pytest.mark.parametrize(
    ("content", "code"),
    [
        (b"1,2,3\n", "bad_stamps"),
        (b"0,soon\n", "bad_stamps"),
        (b"\xff\xfe", "bad_stamps"),
        (b"", "no_stamps"),
    ],
)
def test_a_table_file_that_is_none_is_refused(tmp_path: Path, content: bytes, code: str) -> None:
    table = tmp_path / "stamps.csv"
    table.write_bytes(content)
    with refused(code):
        OpenPoseJsonDetector(folder=tmp_path, stamps=table)


@pytest.mark.parametrize(
    ("code", "options"),
    [
        ("no_folder", {"folder": "none"}),
        ("bad_option", {"pairing": "stamp"}),
        ("bad_option", {"pairing": "order", "stamps": {0: 0.0}}),
        ("bad_option", {"wait": -1.0}),
        ("bad_scale", {"keypoint_scale": 5}),
        ("bad_resolution", {"keypoint_scale": 1}),
        ("bad_resolution", {"resolution": (656, 368)}),
        ("bad_stamps", {"stamps": "none.csv"}),
        ("no_stamps", {"stamps": {}}),
        *(("bad_stamps", {"stamps": stamps}) for stamps in ({"a": 1.0}, {0: float("nan")}, {-1: 0.0})),
    ],
)
def test_folder_and_options_that_do_not_go_together_are_refused(
    tmp_path: Path, code: str, options: dict[str, Any]
) -> None:
    with refused(code):
        OpenPoseJsonDetector(**{"folder": tmp_path, **options})


@pytest.mark.parametrize(("code", "names"), [("two_series", ("a_{}", "b_{}")), ("no_number", ("image",))])
def test_files_of_two_recordings_or_without_number_are_refused(
    tmp_path: Path, code: str, names: tuple[str, ...]
) -> None:
    for name in names:
        write(tmp_path, 0, name=name)
    with refused(code):
        OpenPoseJsonDetector(folder=tmp_path)


# What OpenPose writes for one point of a 640 x 480 image, by hand from its documentation: corners are the
# first and the last pixel; the image is fitted into a resolution with one factor for both axes.
@pytest.mark.parametrize(
    ("scale", "resolution", "written", "pixel"),
    [
        (0, None, (639.0, 479.0), (639.0, 479.0)),
        (3, None, (1.0, 1.0), (639.0, 479.0)),
        (3, None, (0.5, 0.25), (319.5, 119.75)),
        (4, None, (-1.0, -1.0), (0.0, 0.0)),
        (4, None, (1.0, 0.0), (639.0, 239.5)),
        (1, (656, 368), (489.0, 367.0), (638.2316, 479.0)),
        (2, (320, 240), (319.0, 239.0), (639.3347, 479.0)),
    ],
)
def test_every_keypoint_scale_comes_back_to_pixels(
    scale: int,
    resolution: tuple[int, int] | None,
    written: tuple[float, float],
    pixel: tuple[float, float],
) -> None:
    body = np.zeros((25, 3))
    body[3] = *written, 0.9
    given_back = KeypointScale(scale, resolution).to_pixels(Person2D(body=body), WIDTH, HEIGHT).body
    np.testing.assert_allclose(given_back[3], [*pixel, 0.9], atol=2e-3)


def test_replay_gives_the_people_of_the_nearest_time() -> None:
    frames = [(10.0 + i / 30.0, frame(i, people=i)) for i in range(3)]
    detector = ReplayDetector(frames=list(reversed(frames)))
    assert [len(detector.detect(IMAGE, 10.0 + i / 30.0 + 0.01)) for i in (2, 0, 1)] == [2, 0, 1]
    assert detector.detect(IMAGE, 11.0) == ()


@pytest.mark.parametrize("options", [{}, {"frames": [], "folder": "."}, {"frames": [], "stamps": {0: 0.0}}])
def test_replay_needs_either_frames_or_a_folder(options: dict[str, Any]) -> None:
    with refused("bad_option"):
        ReplayDetector(**options)
