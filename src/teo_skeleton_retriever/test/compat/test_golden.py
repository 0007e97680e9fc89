# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Against a recording of the original: 51 s of a person on a RealSense at 320 x 240, published at 10 Hz.

The recording holds what the original published, not what went into it. Three things that went in can be
read off it all the same, because it is over-determined: the focal length (from the projections), the four
calibrated lengths of the arms, and filtered depths of elbows and wrists (searched: `golden_depths.csv`).
Depths of a depth image are whole millimetres, and their median of four is a multiple of half a millimetre:
that the depths found are such multiples, and with lengths that are the same all along give three optimised
depths each to a micrometre, says that they are the ones that went in. Where the search found none, the
skeleton says nothing here.

Not in it and not to be had: the depths of single images. The median of four cannot be undone: images between
the published ones are missing, and pixels of optimised keypoints are medians themselves. The filter has tests
of its own.
"""

from __future__ import annotations

import csv
import gzip
import math
import re
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.compat.original_retriever import IpoptLimbSolver, OriginalTrack
from teo_skeleton_retriever.compat.original_skeleton import (
    SKELETON_STD,
    OriginalParameters,
    OriginalSkeleton,
    body_planes,
)
from teo_skeleton_retriever.depth.limb_solver import LimbChain

INDEX = SKELETON_STD.index
CAMERA = CameraModel.from_field_of_view(
    width=320, height=240, horizontal=2 * math.atan(160 / 309.14516284198226)
)
MICROMETRE = 1e-6
# What the original published on a recording of its own (test/data/README.md).
RECORDING = Path(__file__).parents[1] / "data" / "skeleton_retriever_abduction_left.log.gz"
KEYPOINT = re.compile(r"\(pixel \(([^)]*)\)\) \(position \(([^)]*)\)\) \(status (\w+)\) \(tag (\w+)\)")
PLANE = re.compile(r"\((sagittal|transverse|coronal) \(([^)]*)\)\)")
FOUND = [288, 436]  # of 509 skeletons: left arm, right arm
FOUND_BOTH = 256


class Arm(NamedTuple):
    tags: tuple[str, str, str]
    lengths: tuple[float, float]  # calibrated by the original before the recording starts [m]


ARMS = (
    Arm(("shoulderLeft", "elbowLeft", "handLeft"), (0.25410727, 0.24046019)),
    Arm(("shoulderRight", "elbowRight", "handRight"), (0.21452594, 0.18705758)),
)
ROWS = {arm: [INDEX[tag] for tag in arm.tags] for arm in ARMS}


class Recording(NamedTuple):
    """What the original published, n times."""

    points: np.ndarray  # (n, 17, 3) [m]
    pixels: np.ndarray  # (n, 17, 2) [px]
    updated: np.ndarray  # (n, 17)
    planes: dict[str, np.ndarray]  # (n, 3) each


def numbers(text: str) -> list[float]:
    return [float(word.replace("nan.0", "nan")) for word in text.split()]


@pytest.fixture(scope="module")
def recording() -> Recording:
    lines = gzip.decompress(RECORDING.read_bytes()).decode().splitlines()
    people = [{tag: found for *found, tag in KEYPOINT.findall(line)} for line in lines]
    rows = [[person[tag] for tag in SKELETON_STD.keypoints] for person in people]
    planes = [{name: numbers(text) for name, text in PLANE.findall(line)} for line in lines]
    return Recording(
        points=np.array([[numbers(position) for _, position, _ in row] for row in rows]),
        pixels=np.array([[numbers(pixel) for pixel, _, _ in row] for row in rows]),
        updated=np.array([[status == "updated" for _, _, status in row] for row in rows]),
        planes={name: np.array([plane[name] for plane in planes]) for name in planes[0]},
    )


@pytest.fixture(scope="module")
def depths() -> dict[str, np.ndarray]:
    """Filtered depths of elbows and wrists [m], NaN where not found, by keypoint. Shape (n,) each."""
    with (Path(__file__).parent / "golden_depths.csv").open() as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {tag: np.array([float(row[tag] or "nan") / 2000.0 for row in rows]) for tag in rows[0]}


@pytest.fixture(scope="module")
def chains(recording, depths) -> dict[Arm, dict[int, LimbChain]]:
    """The problems that the original solved, by their place in the recording."""
    found: dict[Arm, dict[int, LimbChain]] = {}
    for arm in ARMS:
        anchors = recording.points[:, INDEX["shoulderCenter"], 2]
        filtered = np.column_stack([anchors, depths[arm.tags[1]], depths[arm.tags[2]]])
        found[arm] = {
            i: LimbChain.original(
                CAMERA.unproject(recording.pixels[i, ROWS[arm]], filtered[i]),
                np.array(arm.lengths),
                anchor_depth=float(anchors[i]),
            )
            for i in np.flatnonzero(np.isfinite(filtered).all(axis=1)).tolist()
        }
    return found


def test_pixels_and_depths_give_the_points(recording) -> None:
    for rows in ROWS.values():
        points = recording.points[:, rows].reshape(-1, 3)
        np.testing.assert_allclose(
            CAMERA.unproject(recording.pixels[:, rows].reshape(-1, 2), points[:, 2]), points, atol=1e-9
        )


def test_planes_are_the_same_to_a_billionth(recording) -> None:
    for i, points in enumerate(recording.points):
        planes = body_planes(
            left_shoulder=points[INDEX["shoulderLeft"]],
            right_shoulder=points[INDEX["shoulderRight"]],
            shoulder_center=points[INDEX["shoulderCenter"]],
            hip_center=points[INDEX["hipCenter"]],
        )
        for name, recorded in recording.planes.items():
            np.testing.assert_allclose(getattr(planes, name), recorded[i], atol=1e-9)


def test_filtered_depths_were_found_for_much_of_the_recording(chains) -> None:
    assert [len(chains[arm]) for arm in ARMS] == FOUND


@pytest.mark.parametrize("arm", ARMS, ids=["left", "right"])
def test_ipopt_gives_the_recorded_depths_to_a_micrometre(recording, chains, arm: Arm) -> None:
    solver, both = IpoptLimbSolver(), chains[ARMS[0]].keys() & chains[ARMS[1]].keys()
    for i, chain in chains[arm].items():
        if i in both:
            continue  # as a part of the whole track, below
        solved = solver.solve(chain)
        assert solved.converged
        np.testing.assert_allclose(solved.depths, recording.points[i, ROWS[arm], 2], atol=MICROMETRE, rtol=0)


def test_the_whole_track_gives_the_recorded_skeletons(recording, depths, chains) -> None:
    """All stages after the median filter, with the state that they keep from image to image."""
    # Order 0: what is fed is already filtered.
    track = OriginalTrack(CAMERA, OriginalParameters(filter_keypoint_order=0))
    for _ in range(41):
        track.step(calibration_pose())
    for arm in ARMS:
        assert [track.length(tag) for tag in arm.tags[1:]] == pytest.approx(arm.lengths, abs=1e-12)
    both = sorted(chains[ARMS[0]].keys() & chains[ARMS[1]].keys())
    assert len(both) == FOUND_BOTH
    for i in both[::2]:
        track.step(filtered_skeleton(recording, depths, i))
        updated = recording.updated[i]
        points, pixels = track.skeleton.points[updated], track.skeleton.pixels[updated]
        np.testing.assert_allclose(points, recording.points[i][updated], atol=MICROMETRE, rtol=0)
        seen = np.isfinite(recording.pixels[i][updated]).all(axis=1)
        np.testing.assert_allclose(pixels[seen], recording.pixels[i][updated][seen], atol=1e-6, rtol=0)
        planes = [recording.planes[name][i] for name in ("sagittal", "transverse", "coronal")]
        # A micrometre between shoulders 27 cm apart.
        np.testing.assert_allclose(track.skeleton.planes, planes, atol=1e-5, rtol=0)


def calibration_pose() -> OriginalSkeleton:
    """Arms hanging down with the lengths that the original had calibrated."""
    skeleton = OriginalSkeleton()
    skeleton.points[INDEX["shoulderCenter"]] = (0.0, 0.2, 2.2)
    for arm in ARMS:
        down = np.array([0.2, 0.2 + arm.lengths[0], 0.2 + sum(arm.lengths)])
        skeleton.points[ROWS[arm]] = np.column_stack([np.full(3, 0.1), down, np.full(3, 2.2)])
    skeleton.updated = np.isfinite(skeleton.points).all(axis=1)
    skeleton.pixels = CAMERA.project(skeleton.points)
    return skeleton


def filtered_skeleton(recording, depths, i: int) -> OriginalSkeleton:
    """What left the original's median filters for the i-th skeleton of the recording."""
    updated = recording.updated[i]
    skeleton = OriginalSkeleton(recording.points[i].copy(), recording.pixels[i].copy(), updated.copy())
    skeleton.points[~updated] = np.nan
    anchor = recording.points[i, INDEX["shoulderCenter"], 2]
    for arm in ARMS:
        z = np.array([anchor, depths[arm.tags[1]][i], depths[arm.tags[2]][i]])
        skeleton.points[ROWS[arm]] = CAMERA.unproject(recording.pixels[i, ROWS[arm]], z)
    return skeleton
