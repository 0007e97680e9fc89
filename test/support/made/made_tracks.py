# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A person put together by formula: where the joints are at each time is known exactly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from teo_common.arrays import Array
from teo_sign_capture.tracks.skeleton_track import BODY, FACE, HAND, Keypoints, SkeletonTrack

UPPER, FORE = 0.29, 0.26  # [m]
SHOULDER = {"right": np.array([0.0, -0.18, 0.0]), "left": np.array([0.0, 0.18, 0.0])}
HANGING = {"right": np.array([0.06, -0.22, -0.54]), "left": np.array([0.06, 0.22, -0.54])}
"""Where the wrists rest [m]."""
UP, AHEAD = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])
_PARTS = {
    0: (0.11, 0.0, 0.17),
    1: (0.0, 0.0, 0.0),
    8: (0.0, 0.0, -0.50),
    9: (0.0, -0.10, -0.50),
    12: (0.0, 0.10, -0.50),
    15: (0.09, -0.032, 0.21),
    16: (0.09, 0.032, 0.21),
    17: (0.0, -0.075, 0.19),
    18: (0.0, 0.075, 0.19),
}

Move = tuple[float, float, Sequence[float]]
"""From when to when [s], and where the wrist goes [m]."""


def minimum_jerk(share: Array) -> Array:
    """Flash and Hogan (1985): from 0 to 1."""
    share = np.clip(share, 0.0, 1.0)
    return share**3 * (10.0 - 15.0 * share + 6.0 * share**2)


def path(times: Array, start: Sequence[float] | Array, moves: Sequence[Move]) -> Array:
    """A point that goes from place to place, each time by minimum jerk. Shape (n, 3)."""
    now = np.asarray(start, dtype=float)
    points = np.tile(now, (len(times), 1))
    for begin, end, place in moves:
        goal = np.asarray(place, dtype=float)
        points += minimum_jerk((times - begin) / (end - begin))[:, None] * (goal - now)
        now = goal
    return points


def make_track(
    times: Array,
    right: Array,
    left: Array | None = None,
    *,
    bend: Array | float = 0.0,
    noise: float = 0.0,
    seed: int = 0,
    source: str = "made",
) -> SkeletonTrack:
    """A person whose wrists go along paths, hands upright with the palm ahead when raised.

    Args:
        times: [s]. Shape (n,).
        right: Right wrist [m]. Shape (n, 3).
        left: Left wrist; hangs where None.
        bend: Of the four fingers, 0 to 1, over time.
        noise: Standard deviation of every keypoint, also its sigma [m].
        seed: Of the noise.
        source: Name.
    """
    rng = np.random.default_rng(seed)
    count = len(times)
    wrists = {"right": right, "left": np.tile(HANGING["left"], (count, 1)) if left is None else left}
    body = np.full((count, BODY, 3), np.nan)
    for index, place in _PARTS.items():
        body[:, index] = place
    for side, (shoulder, elbow, wrist) in {"right": (2, 3, 4), "left": (5, 6, 7)}.items():
        body[:, shoulder] = SHOULDER[side]
        body[:, wrist] = wrists[side]
        body[:, elbow] = _elbows(SHOULDER[side], wrists[side], side)
    bends = np.broadcast_to(np.asarray(bend, dtype=float), (count,))
    hands = {
        side: np.array([hand(point, side, bent) for point, bent in zip(points, bends, strict=True)])
        for side, points in wrists.items()
    }

    def keypoints(positions: Array) -> Keypoints:
        known = np.isfinite(positions).all(axis=-1)
        return Keypoints(
            positions=positions + rng.normal(0.0, noise, positions.shape) if noise else positions,
            sigma=np.where(known, noise, np.nan),
            confidence=np.where(known, 1.0, 0.0),
            status=known.astype(np.uint8),
        )

    return SkeletonTrack(
        times=np.asarray(times, dtype=float),
        body=keypoints(body),
        left_hand=keypoints(hands["left"]),
        right_hand=keypoints(hands["right"]),
        face=Keypoints.lost(count, FACE),
        source=source,
        recorded=None,
    )


def lose(track: SkeletonTrack, part: str, start: float, end: float) -> SkeletonTrack:
    """The track without a part between two times, ends included."""
    keypoints: Keypoints = getattr(track, part)
    inside = (track.times >= start) & (track.times <= end)
    positions, status = keypoints.positions.copy(), keypoints.status.copy()
    positions[inside] = np.nan
    status[inside] = 0
    return replace(track, **{part: replace(keypoints, positions=positions, status=status)})


def hand(wrist: Array, side: str, bend: float) -> Array:
    """Twenty-one keypoints: hanging hands point down, raised ones up with the palm ahead. Shape (21, 3)."""
    raised = float(np.clip((wrist[2] + 0.40) / 0.20, 0.0, 1.0))
    angle = np.pi * raised
    fingers = np.array([np.sin(angle), 0.0, -np.cos(angle)])
    out = np.array([0.0, -1.0 if side == "right" else 1.0, 0.0])  # to the little finger, palm ahead
    palm = np.cross(fingers, out) * (1.0 if side == "right" else -1.0)
    points = np.empty((HAND, 3))
    points[0] = wrist
    for joint, (along, aside) in enumerate(
        ((0.02, 0.03), (0.05, 0.05), (0.08, 0.06), (0.10, 0.065)), start=1
    ):
        points[joint] = wrist + along * fingers - aside * out
    for finger, aside in enumerate((-0.03, -0.01, 0.01, 0.03)):
        at = wrist + 0.09 * fingers + aside * out
        points[5 + 4 * finger] = at
        for bone, length in enumerate((0.045, 0.027, 0.02), start=1):
            turned = bend * np.radians(80.0) * bone
            at = at + length * (np.cos(turned) * fingers + np.sin(turned) * palm)
            points[5 + 4 * finger + bone] = at
    return points


def _elbows(shoulder: Array, wrists: Array, side: str) -> Array:
    """Elbows that keep the lengths of the arm, hanging down and out. Shape (n, 3)."""
    line = wrists - shoulder
    length = np.minimum(np.linalg.norm(line, axis=1, keepdims=True), UPPER + FORE - 1e-6)
    along = line / np.linalg.norm(line, axis=1, keepdims=True)
    foot = (length**2 + UPPER**2 - FORE**2) / (2.0 * length)
    height = np.sqrt(np.maximum(UPPER**2 - foot**2, 0.0))
    down = np.array([-0.5, -0.4 if side == "right" else 0.4, -1.0])
    down = down - (along @ down)[:, None] * along
    return shoulder + foot * along + height * down / np.linalg.norm(down, axis=1, keepdims=True)
