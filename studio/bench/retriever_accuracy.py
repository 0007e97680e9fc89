# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How far the retriever's joints are from the truth, beside the usual way and the original's in the same run.

The truth is the joint's centre, from the skeleton of the rendered person. Body shapes and motions are others
than those that the skin's depth, the detector's bias and sigmas were calibrated on (`accuracy/tuning.py`).
"""

from __future__ import annotations

import argparse
import csv
from collections.abc import Mapping, Sequence
from itertools import product
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.progress import track
from rich.table import Table

from accuracy.errors import Errors, body_errors, face_errors, hand_errors
from accuracy.methods import detected, one_pixel, original, ours, perfect
from accuracy.takes import TakeSettings, default_cache, take
from report import Figure
from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.retriever import KeypointStatus

# (script, start of each of its takes [s]); what the body does there is in none of the takes of calibration.
_MOTIONS = {
    "face": (0.4, 2.0, 3.6, 5.1),
    "crossing": (0.3, 1.4, 2.4, 3.4),
    "fast": (0.5, 1.9, 3.3, 4.5),
    "spelling": (0.6, 2.8, 5.0, 7.2),
    "turning": (0.3, 1.3, 2.3, 3.3),
}
_BODIES = ("man_tall", "woman_small", "woman_old")
_SCENES = ("office", "living_room", "near_wall", "studio")
_DISTANCES = (1.2, 1.4, 1.6, 1.8, 2.0)
_HEIGHTS = (1.0, 1.3, 1.6)  # [m] on a table, at the chest, on a stand

TEST_TAKES: tuple[TakeSettings, ...] = tuple(
    TakeSettings(
        script=script,
        body=_BODIES[(i + k) % 3],
        scene=_SCENES[(i + k) % 4],
        distance=_DISTANCES[(i + k) % 5],
        camera_height=_HEIGHTS[(i + 2 * k) % 3],
        start=start,
        seed=100 + 10 * i + k,
    )
    for i, (script, starts) in enumerate(_MOTIONS.items())
    for k, start in enumerate(starts)
)
_METHODS = {"ours": ours, "one pixel": one_pixel, "original": original}
_DETECTIONS = {"MediaPipe": detected, "perfect": perfect}

_SHARES = ("given", "in 2 sigma")

Results = dict[tuple[str, str, str], Errors]
"""Errors by part, detector and method."""


def evaluate(takes: Sequence[TakeSettings], cache: Path, console: Console | None = None) -> Results:
    """Run every method on every take."""
    found: dict[tuple[str, str, str], list[Errors]] = {}
    for settings in track(takes, "takes", console=console or Console()):
        frames = take(settings, cache)
        for (detector, see), (method, run) in product(_DETECTIONS.items(), _METHODS.items()):
            estimates = run(frames, see)
            for part, errors in (("body", body_errors), ("hands", hand_errors), ("face", face_errors)):
                found.setdefault((part, detector, method), []).append(errors(frames, estimates))
    return {key: errors[0].joined(errors[1:]) for key, errors in found.items()}


def row(errors: Errors) -> dict[str, float]:
    """Summarise errors [mm]; given is the share of keypoints that the method says anything about."""
    known = np.isfinite(errors.distance)
    if not known.any():
        return {}
    values = errors.distance[known] * 1e3
    return {
        "mean": float(values.mean()),
        "median": float(np.median(values)),
        "p95": float(np.percentile(values, 95)),
        "sideways": float(errors.sideways[known].mean() * 1e3),
        "depth": float(np.abs(errors.depth[known]).mean() * 1e3),
        "too far": float(errors.depth[known].mean() * 1e3),
        "given": float(known.mean()),
        "error/sigma": _spread(errors.ratio[known]),
        "in 2 sigma": _covered(errors.ratio[known]),
    }


def _spread(ratio: FloatArray) -> float:
    ratio = ratio[np.isfinite(ratio)]
    return float(np.sqrt(np.mean(ratio**2))) if len(ratio) else float("nan")


def _covered(ratio: FloatArray) -> float:
    """Share of the errors along an axis that are within two sigmas; 95 % if sigma is honest."""
    ratio = ratio[np.isfinite(ratio)]
    return float(np.mean(np.abs(ratio) < 2.0)) if len(ratio) else float("nan")


def rows(results: Results) -> list[tuple[str, str, str, str, dict[str, float]]]:
    """Give every line of the table: part, what of it, detector, method, figures."""
    lines = []
    for (part, detector, method), errors in results.items():
        splits: dict[str, Errors] = {"all": errors}
        if part != "face":
            splits |= {
                "visible": errors.where(errors.visible),
                "hidden": errors.where(~errors.visible),
                "given by one pixel too": errors.where(
                    np.isfinite(results[part, detector, "one pixel"].distance)
                ),
            }
            splits |= {
                status.name.lower(): errors.where(errors.status == status)
                for status in (KeypointStatus.MEASURED, KeypointStatus.OPTIMISED, KeypointStatus.HELD)
            }
            names = (
                ("Shoulder", "Elbow", "Wrist")
                if part == "body"
                else ("Wrist", "CMC", "MCP", "PIP", "DIP", "ThumbIP", "Tip")
            )
            splits |= {name: errors.of(name) for name in names}
        lines += [
            (part, what, detector, method, figures) for what, e in splits.items() if (figures := row(e))
        ]
    return lines


def measure() -> list[Figure]:
    """Give the figures of the table of all benches: shoulders, elbows and wrists, and both hands."""
    figures = []
    for (part, detector, method), errors in evaluate(TEST_TAKES, default_cache()).items():
        summary = row(errors)
        if summary and part != "face":
            text = f"mean {summary['mean']:.1f} mm, p95 {summary['p95']:.1f} mm, given {summary['given']:.0%}"
            figures.append(Figure(f"{part}, 2D of {detector}: {method}", text))
    return figures


def main() -> None:
    """Print the table and write it as CSV."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cache", type=Path, default=default_cache(), help="folder of rendered takes")
    parser.add_argument("--csv", type=Path, default=Path("retriever_accuracy.csv"), help="written: the table")
    parser.add_argument("--takes", type=int, default=len(TEST_TAKES), help="only so many")
    arguments = parser.parse_args()
    console = Console()
    if not console.is_terminal:
        console = Console(width=160)  # a log that is not cut
    results = evaluate(TEST_TAKES[: arguments.takes], arguments.cache, console)
    lines = rows(results)
    print_table(lines, console)
    with arguments.csv.open("w", newline="") as file:
        writer = csv.writer(file)
        columns = list(lines[0][4])
        writer.writerow(["part", "of", "detector", "method", *columns])
        for *labels, figures in lines:
            writer.writerow([*labels, *(f"{figures[column]:.4g}" for column in columns)])
    console.print(f"written: {arguments.csv}")


def print_table(lines: Sequence[tuple[str, str, str, str, Mapping[str, float]]], console: Console) -> None:
    """Print the lines as a table; lengths in millimetres."""
    columns = list(lines[0][4])
    table = Table("part", "of", "2D", "method", *columns, title="errors to the joints' centres [mm]")
    before = None
    for part, what, detector, method, figures in sorted(
        lines, key=lambda line: (line[0], line[2] != "MediaPipe")
    ):
        if before not in (None, (part, detector)):
            table.add_section()
        before = (part, detector)
        values = [f"{figures[c]:.0%}" if c in _SHARES else f"{figures[c]:.1f}" for c in columns]
        table.add_row(part, what, detector, method, *values)
    console.print(table)


if __name__ == "__main__":
    main()
