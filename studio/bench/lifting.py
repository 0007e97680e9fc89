# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How well a clip that one camera took is lifted into space, against people who are known exactly.

The person's size is not in the picture: what is left once it is put right is given beside. Rendered people,
none of whom was shown to the networks, are seen by MediaPipe, and count as large as lifting takes everybody
for.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from kept import kept_folder
from report import Figure, spread
from signs.performed import pictured, script_track
from teo_common.arrays import Array
from teo_sign_authoring.cli.train_lifting import render
from teo_sign_authoring.sight.fitting import true_size
from teo_sign_authoring.sight.rendered_people import RenderedPerson
from teo_sign_capture.recordings.recording import lifted_track
from teo_sign_capture.tracks.skeleton_track import ELBOW, SHOULDER, WRIST, SkeletonTrack
from teo_skeleton_retriever.layouts.person_layout import HANDS
from teo_skeleton_retriever.lifting.arms import ADULT
from teo_skeleton_retriever.lifting.hand_axes import INDEX, KNUCKLES, finger_bends, in_palm, palm_axes
from teo_skeleton_retriever.lifting.lifted_person import SeenPerson, lift_clip

SCRIPTS = ("signing", "face", "crossing", "spelling")
BODIES = ("woman_average", "man_average", "man_tall")
_NEAR = 2.0  # [m] from a camera in whose picture hands are larger than shoulders
_TURN = math.radians(40.0)  # of signers who show a sign from the side
_RAISED = -0.36  # [m] below the shoulders: lower wrists hang


# Networks were shown people from 0 on.
_FIRST = 2_000_000
_FINGER = 80.0  # [mm] from knuckle to tip


def measure(bodies: int = len(BODIES), people: int = 40) -> list[Figure]:
    """Errors of raised arms and of hands: of people rendered; from afar, near, turned, without depths."""
    return [*_rendered(people), *_pictured(bodies)]


def _rendered(people: int) -> list[Figure]:
    """Rendered people, so many, as MediaPipe sees them."""
    kept = kept_folder("lifting", "teo_synthetic_signer", "teo_sign_authoring.sight.rendered_people")
    errors: dict[str, list[Array]] = {}
    for person in render(range(_FIRST, _FIRST + people), kept, jobs=1):
        for name, found in _person_errors(person).items():
            errors.setdefault(name, []).append(found)
    units = {"thumb's tip": "mm", "fingers, bend in all": "deg"}
    return [
        Figure(f"rendered: {name}", spread(np.concatenate(found), units.get(name.split(";")[0], "mm")))
        for name, found in errors.items()
    ]


def _person_errors(person: RenderedPerson) -> dict[str, Array]:
    """Of raised hands: elbows, wrists, thumbs' tips [mm]; bends of fingers [deg], also as they are seen."""
    truth = person.truth - person.truth[:, list(SHOULDER.values())].mean(axis=1, keepdims=True)
    truth *= ADULT / true_size(truth)
    lifted, seen = lift_clip(person.clip).positions, SeenPerson(person.clip)
    found: dict[str, list[Array]] = {}
    for side, mirror in (("right", (1.0, 1.0, 1.0)), ("left", (1.0, -1.0, 1.0))):
        raised = truth[:, WRIST[side], 2] > _RAISED
        for name, row in (("elbows", ELBOW[side]), ("wrists", WRIST[side])):
            away = 1000.0 * np.linalg.norm(lifted[:, row] - truth[:, row], axis=1)
            found.setdefault(name, []).append(away[raised & np.isfinite(away)])
        rows = HANDS[side[0].upper()]
        for words, hand in (("", lifted[:, rows]), ("; without its network", seen.hands[side].points)):
            known = raised & np.isfinite(hand).all(axis=(1, 2))
            shown, true = (_tip_and_bends(points[known] * mirror) for points in (hand, truth[:, rows]))
            tips = _FINGER * np.linalg.norm(shown[0] - true[0], axis=1)
            found.setdefault(f"thumb's tip{words}", []).append(tips)
            bends = np.degrees(np.abs(shown[1] - true[1])).ravel()
            found.setdefault(f"fingers, bend in all{words}", []).append(bends)
    return {name: np.concatenate(parts) for name, parts in found.items()}


def _tip_and_bends(hand: Array) -> tuple[Array, Array]:
    """The thumb's tip from the index's knuckle [lengths of a finger], bends of fingers in all [rad]."""
    local = in_palm(hand)
    bones = [np.linalg.norm(np.diff(local[:, row : row + 4], axis=1), axis=2).sum(axis=1) for row in KNUCKLES]
    length = np.median(bones) if len(local) else 1.0
    return (local[:, 4] - local[:, INDEX]) / length, finger_bends(local).sum(axis=2)


def _pictured(bodies: int) -> list[Figure]:
    """People whose exact keypoints are shown in a picture."""
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
