# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the retriever makes of depth as real cameras give it, and of several people.

The takes of `retriever_accuracy.py`, with what the detector saw in them, are made worse:

- missing: two thirds of the depth, half of it pixel by pixel, half in patches;
- background: depth of what lies behind reaches some pixels over every outline, over ears and fingers, as
  after a poor alignment;
- both;
- people: others are pasted in by their depth, one who walks by behind the signer and one who stands aside.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import cv2
import numpy as np
from rich.console import Console
from rich.table import Table

from accuracy.errors import Errors, body_errors, hand_errors
from accuracy.methods import Estimate, estimate_of, nothing, signer_estimate
from accuracy.takes import TakeFrame, default_cache, take
from report import Figure
from retriever_accuracy import TEST_TAKES
from teo_skeleton_retriever.arrays import BoolArray, DepthArray, FloatArray
from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_skeleton_retriever.layouts.person_2d import Person2D
from teo_skeleton_retriever.retriever import DetectionFrame, Retriever, RetrieverParameters, Skeleton

MISSING = 0.66
"""Share of the depth that is lost, as in recordings of the original's authors."""
WILD = 0.15  # [m] a hand's keypoint that is farther off is not on the hand any more
_OVERLAP = 5  # [px] by which background reaches over outlines: a centimetre and a half at 1.5 m
_PATCH = 9.0  # [px] size of holes
_SAME = 5.0  # [px] median distance of keypoints of the same detection
_PERSON = 0.45  # [m] before and behind the trunk within which a person is
_BEHIND = 0.7  # [m] from the signer to who walks by, and from there to who stands aside
_NECK = BODY_25.index["Neck"]

Worsen = Callable[[DepthArray, np.random.Generator], DepthArray]


def missing(depth: DepthArray, random: np.random.Generator) -> DepthArray:
    """Lose two thirds of the depth."""
    share = 1.0 - np.sqrt(1.0 - MISSING)  # of each of the two
    patches = cv2.GaussianBlur(random.standard_normal(depth.shape), (0, 0), _PATCH)
    lost = (patches < np.quantile(patches, share)) | (random.random(depth.shape) < share)
    return np.where(lost, np.float32(np.nan), depth)


def background(depth: DepthArray, random: np.random.Generator) -> DepthArray:
    """Let the farther side of every edge reach over the nearer."""
    del random
    far = cv2.dilate(np.nan_to_num(depth), np.ones((_OVERLAP, _OVERLAP), np.uint8))
    return np.where(np.isfinite(depth) & (far - depth > 0.05), far, depth).astype(np.float32)


def _both(depth: DepthArray, random: np.random.Generator) -> DepthArray:
    return missing(background(depth, random), random)


def _as_it_is(depth: DepthArray, random: np.random.Generator) -> DepthArray:
    del random
    return depth


DEPTHS: dict[str, Worsen] = {
    "as rendered": _as_it_is,
    f"{MISSING:.0%} missing": missing,
    "background over outlines": background,
    "both": _both,
}


def worsened(frames: Sequence[TakeFrame], worsen: Worsen, seed: int) -> list[Estimate]:
    """Follow a take whose depth is made worse."""
    random = np.random.default_rng(seed)
    retriever = Retriever(RetrieverParameters(newcomer_images=1))
    estimates = []
    for frame in frames:
        depth = worsen(frame.depth(), random)
        found = retriever.process(DetectionFrame(frame.stamp, frame.people, depth, frame.camera))
        estimates.append(signer_estimate(found))
    return estimates


class Crowd(NamedTuple):
    """What became of several people."""

    signer: list[Estimate]
    """the one in front"""
    ids: list[dict[int, int]]
    """id by person, of those who were seen in an image"""


def crowd(takes: Sequence[Sequence[TakeFrame]], seed: int) -> Crowd:
    """Follow the person of the first take; that of the second walks by, that of the third stands aside."""
    random = np.random.default_rng(seed)
    retriever = Retriever(RetrieverParameters(newcomer_images=1))
    estimates, ids = [], []
    for i, frame in enumerate(takes[0]):
        depth = frame.depth().copy()
        seen: dict[int, Person2D] = {0: frame.people[0]} if frame.people else {}
        before = np.nan_to_num(depth, nan=np.inf)
        for who, others in enumerate(takes[1:], start=1):
            other = others[i]
            columns = round(-320 + 640 * i / (len(takes[0]) - 1)) if who == 1 else 230
            pasted = _moved(other, columns)
            pasted += frame.truth.body[_NECK, 2] + who * _BEHIND - other.truth.body[_NECK, 2]
            shown = np.isfinite(pasted) & (pasted < before)
            depth[shown] = pasted[shown]
            before = np.nan_to_num(depth, nan=np.inf)
            person = _shifted(other.people[0], columns) if other.people else None
            if person is not None and _in_view(person, shown):
                seen[who] = person
        order = random.permutation(list(seen))
        found = retriever.process(
            DetectionFrame(
                frame.stamp, tuple(seen[who] for who in order), missing(depth, random), frame.camera
            )
        )
        owners = {who: _nearest(found, person) for who, person in seen.items()}
        ids.append({who: skeleton.track_id for who, skeleton in owners.items() if skeleton is not None})
        first = owners.get(0)
        estimates.append(estimate_of(first) if first is not None else nothing())
    return Crowd(estimates, ids)


def switches(ids: Sequence[dict[int, int]]) -> int:
    """How often somebody's id changed."""
    known: dict[int, int] = {}
    changed = 0
    for seen in ids:
        for who, track_id in seen.items():
            changed += known.setdefault(who, track_id) != track_id
            known[who] = track_id
    return changed


def _moved(frame: TakeFrame, columns: int) -> DepthArray:
    """Cut a person out and move them aside; each pixel keeps its depth."""
    depth = frame.depth()
    trunk = float(frame.truth.body[_NECK, 2])
    near = (np.abs(np.nan_to_num(depth) - trunk) < _PERSON).astype(np.uint8)
    _, labels = cv2.connectedComponents(near)
    column, row = np.rint(frame.camera.project(frame.truth.body[_NECK : _NECK + 1])[0]).astype(int)
    person = np.where(labels == labels[row, column], depth, np.float32(np.nan))
    moved = np.full_like(depth, np.nan)
    width = depth.shape[1]
    start, end = max(columns, 0), min(width + columns, width)
    moved[:, start:end] = person[:, start - columns : end - columns]
    return moved


def _shifted(person: Person2D, columns: int) -> Person2D:
    def moved(part: FloatArray) -> FloatArray:
        return part + np.array([columns, 0.0, 0.0]) * (part[:, 2:] > 0.0) if len(part) else part

    return Person2D(
        body=moved(person.body),
        left_hand=moved(person.left_hand),
        right_hand=moved(person.right_hand),
        face=moved(person.face),
        left_hand_world=person.left_hand_world,
        right_hand_world=person.right_hand_world,
    )


def _in_view(person: Person2D, shown: BoolArray) -> bool:
    """Whether two of neck and shoulders can be seen: with less a detector finds nobody."""
    height, width = shown.shape
    places = np.rint(person.body[[_NECK, BODY_25.index["RShoulder"], BODY_25.index["LShoulder"]], :2])
    columns, rows = places.astype(int).T
    inside = (columns >= 0) & (columns < width) & (rows >= 0) & (rows < height)
    return bool(inside.all() and shown[rows, columns].sum() >= 2)


def _nearest(found: Sequence[Skeleton], person: Person2D) -> Skeleton | None:
    """The skeleton that came of a detection: its keypoints are where that had them."""
    off = [
        float(np.nanmedian(np.linalg.norm(skeleton.body.pixels - person.body[:, :2], axis=1)))
        for skeleton in found
    ]
    best = int(np.argmin(np.nan_to_num(off, nan=np.inf))) if off else 0
    return found[best] if off and off[best] < _SAME else None


def summary(errors: Errors) -> dict[str, float]:
    """Mean, 95th percentile [mm], shares that are given, wild, and within two sigmas."""
    known = np.isfinite(errors.distance)
    values = errors.distance[known]
    ratio = np.abs(errors.ratio[known])
    return {
        "mean": float(values.mean() * 1e3),
        "p95": float(np.percentile(values, 95) * 1e3),
        "given": float(known.mean()),
        "wild": float((values > WILD).mean()),
        "in 2 sigma": float((ratio < 2.0).mean()),
    }


def evaluate() -> list[tuple[str, str, dict[str, float]]]:
    """Every case: its name, the part of the body, its figures."""
    takes = [take(settings, default_cache()) for settings in TEST_TAKES]
    cases: dict[str, list[list[Estimate]]] = {
        name: [worsened(frames, worsen, i) for i, frames in enumerate(takes)]
        for name, worsen in DEPTHS.items()
    }
    crowds = [crowd([takes[i], takes[(i + 7) % 20], takes[(i + 13) % 20]], i) for i in range(len(takes))]
    changed = sum(switches(result.ids) for result in crowds)
    seen = sum(len(ids) for result in crowds for ids in result.ids)
    cases[f"three people, 66% missing: {changed} ids changed of {seen}"] = [
        result.signer for result in crowds
    ]
    lines = []
    for name, estimates in cases.items():
        for part, errors_of in (("body", body_errors), ("hands", hand_errors)):
            errors = [errors_of(frames, e) for frames, e in zip(takes, estimates, strict=True)]
            lines.append((name, part, summary(errors[0].joined(errors[1:]))))
    return lines


def measure() -> list[Figure]:
    """Give the figures of the table of all benches."""
    return [
        Figure(
            f"{part}, {name}",
            f"mean {f['mean']:.1f} mm, p95 {f['p95']:.0f} mm, given {f['given']:.0%}, more than 15 cm off "
            f"{f['wild']:.2%}, within 2 sigma {f['in 2 sigma']:.0%}",
        )
        for name, part, f in evaluate()
    ]


def main() -> None:
    """Print the table."""
    table = Table("depth", "part", "mean", "p95", "given", "more than 15 cm off", "within 2 sigma")
    for name, part, f in evaluate():
        table.add_row(
            name,
            part,
            f"{f['mean']:.1f}",
            f"{f['p95']:.0f}",
            f"{f['given']:.0%}",
            f"{f['wild']:.2%}",
            f"{f['in 2 sigma']:.0%}",
        )
    Console(width=130).print(table)


if __name__ == "__main__":
    main()
