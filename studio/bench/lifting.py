# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How well a clip that one camera took is lifted into space, against people who are known exactly.

The person's size is not in the picture: what is left once it is put right is given beside.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from report import Figure, spread
from signs.performed import pictured, script_track
from teo_common.arrays import Array
from teo_sign_capture.recordings.recording import lifted_track
from teo_sign_capture.tracks.skeleton_track import ELBOW, SHOULDER, WRIST, SkeletonTrack
from teo_skeleton_retriever.lifting.hand_axes import palm_axes

SCRIPTS = ("signing", "face", "crossing", "spelling")
BODIES = ("woman_average", "man_average", "man_tall")
_NEAR = 2.0  # [m] from a camera in whose picture hands are larger than shoulders
_TURN = math.radians(40.0)  # of signers who show a sign from the side
_RAISED = -0.36  # [m] below the shoulders: lower wrists hang


def measure(bodies: int = len(BODIES)) -> list[Figure]:
    """Errors of raised arms and of hands: from afar, from near, turned, with and without depths."""
    tracks = [script_track(script, body) for script in SCRIPTS for body in BODIES[:bodies]]
    figures = []
    near = {"distance": _NEAR}
    cases: dict[str, dict[str, Any]] = {
        "from afar": {},
        f"from {_NEAR:g} m": near,
        "from afar, no depth in the hands": {"depth": False},
        f"from {_NEAR:g} m, depths of the body imagined": {**near, "imagined": True},
        f"from {_NEAR:g} m, turned by 40 deg": {**near, "turn": _TURN},
        f"from {_NEAR:g} m, turned by 40 deg, depths of the body imagined": {
            **near,
            "turn": _TURN,
            "imagined": True,
        },
    }
    for name, seen in cases.items():
        found = [
            _errors(track, lifted_track(pictured(track, seed=number, **seen)))
            for number, track in enumerate(tracks)
        ]
        elbows, wrists, sized, palms = (np.concatenate(errors) for errors in zip(*found, strict=True))
        figures += [
            Figure(f"{name}: raised elbows", spread(1000.0 * elbows, "mm")),
            Figure(f"{name}: raised wrists", spread(1000.0 * wrists, "mm")),
            Figure(f"{name}: raised wrists at the right size", spread(1000.0 * sized, "mm")),
            Figure(f"{name}: palm's direction", spread(np.degrees(palms), "deg")),
        ]
    return figures


def _errors(truth: SkeletonTrack, lifted: SkeletonTrack) -> tuple[Array, Array, Array, Array]:
    """Elbows, wrists, wrists at the right size [m]; palms [rad]: of raised hands."""
    share = _size(truth) / _size(lifted)
    body = replace(lifted.body, positions=share * lifted.body.positions)
    elbows: list[Array] = []
    wrists: list[Array] = []
    sized: list[Array] = []
    palms: list[Array] = []
    for side, mirror in (("right", 1.0), ("left", -1.0)):
        raised = truth.body.positions[:, WRIST[side], 2] > _RAISED
        for errors, track, point in (
            (elbows, lifted.body, ELBOW[side]),
            (wrists, lifted.body, WRIST[side]),
            (sized, body, WRIST[side]),
        ):
            away = track.positions[raised, point] - truth.body.positions[raised, point]
            errors.append(np.linalg.norm(away, axis=1))
        true, found = (
            palm_axes(track.hand(side).positions[raised] * [1.0, mirror, 1.0])[..., 2]
            for track in (truth, lifted)
        )
        palms.append(np.arccos(np.clip((true * found).sum(axis=1), -1.0, 1.0)))
    return np.concatenate(elbows), np.concatenate(wrists), np.concatenate(sized), np.concatenate(palms)


def _size(track: SkeletonTrack) -> float:
    """Breadth of the shoulders and length of an arm together [m]."""
    points = track.body.positions
    chain = (SHOULDER["left"], SHOULDER["right"], ELBOW["right"], WRIST["right"])
    return float(np.linalg.norm(np.diff(points[:, chain], axis=1), axis=2).sum(axis=1).mean())
