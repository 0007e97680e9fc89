# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which depth camera for signing: what each measures of wrists and fingertips, and whether it sees enough.

Rendered people before a model of each device, through the detector and the retriever with their defaults.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, NamedTuple

import numpy as np
import typer
from rich.console import Console
from rich.progress import track
from rich.table import Table

from teo_common.atomic_files import atomic_path
from teo_skeleton_retriever.arrays import BoolArray, FloatArray
from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.detectors import make_detector
from teo_skeleton_retriever.layouts.layout import BODY_25, HAND_21
from teo_skeleton_retriever.retriever import DetectionFrame, Retriever, RetrieverParameters
from teo_synthetic_signer.camera.sensors import SENSORS, Sensor
from teo_synthetic_signer.take.take import Take, TakeOptions

# From the camera to the person [m]: arm's length to across a room.
DISTANCES = (0.6, 1.0, 1.5, 2.5)
_WIDTH = 640  # [px] of the images; the height follows from the device's field of view
_RATE = 15.0  # [Hz]
_STARTS = (30, 62)  # frames of the script in which one hand greets, and in which both sign
_WRISTS = [BODY_25.index[name] for name in ("LWrist", "RWrist")]
_TIPS = [i for i, name in enumerate(HAND_21.keypoints) if name.endswith("Tip")]

# Where one signs: from the waist to a hand above the head, as wide as both elbows, from the chest to a
# forearm before it. Source: Klima and Bellugi, "The Signs of Language" (1979), section 2.
_HALF_WIDTH, _ABOVE_NOSE, _ABOVE_HIPS, _BEFORE = 0.45, 0.30, 0.10, 0.50  # [m]

_out = Console()
_app = typer.Typer(add_completion=False, rich_markup_mode=None)


class Study(NamedTuple):
    """What one device gives at one distance."""

    sensor: str
    distance: float
    """[m]"""
    space: float
    """share of the signing space that is in the image and within the range of depth"""
    wrists: float
    """mean distance from the truth of wrists that can be seen [m]; NaN if none was found"""
    wrists_found: float
    """share of those that can be seen"""
    tips: float
    """likewise, of fingertips [m]"""
    tips_found: float
    """likewise"""


def _study(name: str, distance: float, frames: int) -> Study:
    """Measure one device at one distance [m] in so many frames of each of the two parts of the script."""
    sensor = SENSORS[name]
    across, down = (math.tan(angle / 2.0) for angle in sensor.color_view)
    take = Take(
        TakeOptions(
            sensor=name, distance=distance, width=_WIDTH, height=round(_WIDTH * down / across), rate=_RATE
        )
    )
    detector = make_detector("mediapipe")
    errors: dict[str, list[FloatArray]] = {"wrists": [], "tips": []}
    space = math.nan
    try:
        for start in _STARTS:
            retriever = Retriever(RetrieverParameters(newcomer_images=1))
            for index in range(start, start + frames):
                image = take.frame(index)
                space = seen_share(image.camera, sensor, image.truth.body) if math.isnan(space) else space
                people = detector.detect(image.color, image.stamp)
                found = retriever.process(DetectionFrame(image.stamp, people, image.depth, image.camera))
                body, tips = np.full((25, 3), math.nan), np.full((10, 3), math.nan)
                if found:
                    body = found[0].body.points
                    hands = (found[0].left_hand.points, found[0].right_hand.points)
                    tips = np.concatenate([hand[_TIPS] for hand in hands])
                truth = image.truth
                errors["wrists"].append(_off(body[_WRISTS], truth.body[_WRISTS], truth.body_visible[_WRISTS]))
                true_tips = np.concatenate([truth.left_hand[_TIPS], truth.right_hand[_TIPS]])
                seen = np.concatenate([truth.left_hand_visible[_TIPS], truth.right_hand_visible[_TIPS]])
                errors["tips"].append(_off(tips, true_tips, seen))
    finally:
        detector.close()
    wrists, fingertips = (np.concatenate(parts) for parts in errors.values())
    return Study(name, distance, space, *_summary(wrists), *_summary(fingertips))


def seen_share(camera: CameraModel, sensor: Sensor, body: FloatArray) -> float:
    """Tell the share of a person's signing space that is in the image and within the sensor's range.

    Args:
        camera: That looks at it.
        sensor: Whose range counts.
        body: Keypoints of BODY_25 in the camera's frame [m]. Shape (25, 3).
    """
    nose, hips, right_shoulder, left_shoulder = (
        body[BODY_25.index[name]] for name in ("Nose", "MidHip", "RShoulder", "LShoulder")
    )
    chest = (right_shoulder + left_shoulder) / 2.0
    left = (left_shoulder - right_shoulder) / np.linalg.norm(left_shoulder - right_shoulder)
    up = chest - hips
    up = (up - left * (up @ left)) / np.linalg.norm(up - left * (up @ left))
    ahead = np.cross(left, up)
    top, bottom = float((nose - chest) @ up) + _ABOVE_NOSE, float((hips - chest) @ up) + _ABOVE_HIPS
    x, y, z = np.meshgrid(
        np.linspace(-_HALF_WIDTH, _HALF_WIDTH, 11), np.linspace(bottom, top, 11), np.linspace(0, _BEFORE, 6)
    )
    points = chest + np.outer(x.ravel(), left) + np.outer(y.ravel(), up) + np.outer(z.ravel(), ahead)
    inside = camera.contains(np.nan_to_num(camera.project(points), nan=-1.0))
    ranged = (points[:, 2] >= sensor.nearest) & (points[:, 2] <= sensor.farthest)
    return float((inside & ranged).mean())


def _off(found: FloatArray, truth: FloatArray, seen: BoolArray) -> FloatArray:
    """The distances of those that can be seen [m]; NaN where not found."""
    return np.asarray(np.linalg.norm(found - truth, axis=1)[seen])


def _summary(errors: FloatArray) -> tuple[float, float]:
    known = errors[np.isfinite(errors)]
    if not len(errors):
        return math.nan, math.nan
    return float(known.mean()) if len(known) else math.nan, len(known) / len(errors)


@_app.command()
def _sensor_study(
    out: Annotated[Path, typer.Option(help="CSV file, to be written.")] = Path("sensor_study.csv"),
    frames: Annotated[int, typer.Option(min=1, max=20, help="Of each of two parts of the script.")] = 6,
    sensors: Annotated[str, typer.Option(help="Devices, with commas between.")] = ",".join(SENSORS),
) -> None:
    """Print what each depth camera measures of wrists and fingertips at four distances, and what it sees.

    Exit status: 0 if the table is complete, 2 for a device that is not known.
    """
    names = [name.strip() for name in sensors.split(",")]
    unknown = [name for name in names if name not in SENSORS]
    if unknown:
        raise typer.BadParameter(f"expected devices among {', '.join(SENSORS)}, got {', '.join(unknown)}")
    cases = [(name, distance) for name in names for distance in DISTANCES]
    results = [
        _study(*case, frames)
        for case in track(cases, "devices and distances", console=_out, disable=not _out.is_terminal)
    ]
    _out.print(_table(results))
    write_csv(results, out)
    _out.print(f"written: {out}")


def _table(results: Sequence[Study]) -> Table:
    lines = Table("device", "distance", "signing space seen", "wrists", "found", "fingertips", "found")
    for result in results:
        wrists, tips = (
            f"{e * 1e3:.0f} mm" if math.isfinite(e) else "-" for e in (result.wrists, result.tips)
        )
        shares = [
            f"{share:.0%}" if math.isfinite(share) else "-"
            for share in (result.space, result.wrists_found, result.tips_found)
        ]
        label = SENSORS[result.sensor].label
        lines.add_row(label, f"{result.distance} m", shares[0], wrists, shares[1], tips, shares[2])
    return lines


def write_csv(results: Sequence[Study], path: Path) -> None:
    """Write results, in metres and shares, whole or not at all."""
    with atomic_path(path) as temporary, temporary.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(Study._fields)
        writer.writerows([f"{v:.4g}" if isinstance(v, float) else v for v in result] for result in results)


def main() -> None:
    """Run the command."""
    _app()


if __name__ == "__main__":
    main()
