# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The retriever on further takes: held out, faces behind arms, several people.

- held out: other people, lights and cameras (1 to 2.5 m, rolled) than those that anything was calibrated or
  looked at on. Joints are the centres about which limbs turn, fingertips lie in the finger (the README of
  teo_synthetic_signer says where); of the body shoulders, elbows and wrists count.
- known: others of that kind, on which changes were chosen.
- occluded faces: forearms and hands before head and shoulders; these takes were looked at while that was
  built.
- several people: two or three, the signer the nearest; likewise.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from rich.console import Console
from rich.table import Table

from accuracy.errors import Errors, body_errors, hand_errors, head_errors
from accuracy.methods import Estimate, detected, estimate_of, nothing, one_pixel, ours
from accuracy.takes import TakeFrame, TakeSettings, default_cache, take
from accuracy.unseen import HELD_OUT_TAKES, KNOWN_TAKES, OCCLUDED_TAKES, SEVERAL_TAKES
from report import Figure
from teo_skeleton_retriever.arrays import BoolArray
from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_skeleton_retriever.retriever import (
    DetectionFrame,
    KeypointStatus,
    Retriever,
    RetrieverParameters,
    Skeleton,
)

_NECK = BODY_25.index["Neck"]
_SAME = 0.2  # [m] from the neck that is found to the true one of the same person: half a shoulder's breadth
_TRIAL = 2  # images in which a newcomer is on trial, and is not counted as missed


def _told(errors: Errors, chosen: BoolArray | None = None) -> str:
    """Mean, median, 95th percentile [mm], what is given, within two sigmas, and marked measured."""
    if chosen is None:
        chosen = np.ones(errors.distance.shape, dtype=bool)
    known = np.isfinite(errors.distance) & chosen
    distance = errors.distance[known] * 1e3
    measured = (errors.status[known] == KeypointStatus.MEASURED).mean()
    inside = (np.abs(errors.ratio[known]) < 2.0).mean() if np.isfinite(errors.ratio[known]).any() else np.nan
    median, p95 = np.percentile(distance, [50, 95])
    return (
        f"mean {distance.mean():.1f} mm, median {median:.1f}, p95 {p95:.0f}, worst {distance.max():.0f}, "
        f"given {known.sum() / chosen.sum():.0%}, within 2 sigma {inside:.1%}, "
        f"marked measured {measured:.0%}"
    )


def _joined(parts: Sequence[Errors]) -> Errors:
    return parts[0].joined(parts[1:])


def other_people(what: str, takes: Sequence[TakeSettings], cache: Path) -> list[Figure]:
    """Body, its hidden elbows, fingertips and both hands."""
    figures = []
    frames = [take(settings, cache) for settings in takes]
    for name, method in (("ours", ours), ("one pixel", one_pixel)):
        pairs = [(images, method(images, detected)) for images in frames]
        body = _joined([body_errors(*pair) for pair in pairs])
        hands = _joined([hand_errors(*pair) for pair in pairs])
        elbows = body.of("Elbow")
        figures += [
            Figure(f"{what}, body: {name}", _told(body)),
            Figure(f"{what}, elbows that are seen: {name}", _told(elbows, elbows.visible)),
            Figure(f"{what}, elbows that are hidden: {name}", _told(elbows, ~elbows.visible)),
            Figure(f"{what}, fingertips: {name}", _told(hands.of("Tip"))),
            Figure(f"{what}, both hands: {name}", _told(hands)),
        ]
    return figures


def occluded(takes: Sequence[TakeSettings], cache: Path) -> list[Figure]:
    """Heads and arms' joints, those that are seen and those that are hidden."""
    figures = []
    frames = [take(settings, cache) for settings in takes]
    for name, method in (("ours", ours), ("one pixel", one_pixel)):
        pairs = [(images, method(images, detected)) for images in frames]
        for part, errors_of in (("head", head_errors), ("body", body_errors)):
            errors = _joined([errors_of(*pair) for pair in pairs])
            for what, chosen in (("seen", errors.visible), ("hidden", ~errors.visible)):
                figures.append(Figure(f"occluded faces, {part}, {what}: {name}", _told(errors, chosen)))
    return figures


class Crowd(NamedTuple):
    """What became of the people of one take."""

    followed: int
    there: int
    changed: int
    signers: int
    images: int
    signer: list[Estimate]


def crowd(frames: Sequence[TakeFrame]) -> Crowd:
    """Follow everybody, as the node does; who is nearest, the first, is to be the signer."""
    retriever = Retriever(RetrieverParameters())
    followed = there = changed = signers = images = 0
    ids: dict[int, int] = {}
    estimates = []
    for i, frame in enumerate(frames):
        found = retriever.process(DetectionFrame(frame.stamp, frame.people, frame.depth(), frame.camera))
        estimates.append(nothing())
        if i < _TRIAL:
            continue
        images += 1
        for who, truth in enumerate((frame.truth, *frame.others)):
            there += 1
            skeleton = _nearest(found, truth.body[_NECK])
            if skeleton is None:
                continue
            followed += 1
            changed += ids.setdefault(who, skeleton.track_id) != skeleton.track_id
            ids[who] = skeleton.track_id
            if who == 0:
                signers += skeleton.is_signer
                estimates[-1] = estimate_of(skeleton)
    return Crowd(followed, there, changed, signers, images, estimates)


def _nearest(found: Sequence[Skeleton], neck: np.ndarray) -> Skeleton | None:
    off = [float(np.linalg.norm(skeleton.body.points[_NECK] - neck)) for skeleton in found]
    best = int(np.argmin(np.nan_to_num(off, nan=np.inf))) if off else 0
    return found[best] if off and off[best] < _SAME else None


def several(takes: Sequence[TakeSettings], cache: Path) -> list[Figure]:
    """Who of two and three people is followed, and whether the nearest signs."""
    figures = []
    for count in (2, 3):
        frames = [take(settings, cache) for settings in takes if len(settings.companions) == count - 1]
        crowds = [crowd(images) for images in frames]
        followed, there, changed, signers, images = np.sum([c[:5] for c in crowds], axis=0)
        body = _joined([body_errors(f, c.signer) for f, c in zip(frames, crowds, strict=True)])
        figures += [
            Figure(
                f"{count} people",
                f"followed in {followed / there:.0%} of {there} sightings, {changed} ids changed, the "
                f"nearest is the signer in {signers / images:.0%} of {images} images",
            ),
            Figure(f"{count} people, the signer's body", _told(body)),
        ]
    return figures


def measure() -> list[Figure]:
    """Give the figures of the table of all benches."""
    cache = default_cache()
    return [
        *several(SEVERAL_TAKES, cache),
        *occluded(OCCLUDED_TAKES, cache),
        *other_people("known", KNOWN_TAKES, cache),
        *other_people("held out", HELD_OUT_TAKES, cache),
    ]


def main() -> None:
    """Print the table."""
    table = Table("what", "figures")
    for figure in measure():
        table.add_row(figure.what, figure.value)
    Console(width=180).print(table)


if __name__ == "__main__":
    main()
