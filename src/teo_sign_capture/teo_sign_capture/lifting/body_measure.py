# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How large a person in a picture is: the lengths of the arms, and metres for a unit of the clip."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from teo_common.arrays import Array
from teo_sign_capture.recordings.pose_file import Points
from teo_sign_capture.tracks.skeleton_track import ELBOW, SHOULDER, WRIST

# [m] Lengths of an adult's limbs, between the centres of the joints. After Drillis and Contini, "Body Segment
# Parameters" (1966), a person of 1.65 m has arms of 0.31 and 0.24 and acromia 0.43 m apart; joints of
# shoulders, to which and from which detectors measure, are some 4 cm further in and down.
SHOULDERS, UPPER_ARM, FOREARM = 0.36, 0.28, 0.24

# A person turns, and a limb points at the camera: the length is what few frames exceed.
_SHOULDERS_PERCENTILE, _LIMB_PERCENTILE = 90.0, 95.0
# A limb of this share of what the shoulders let expect lay across the view at some time. Shorter, it was
# always foreshortened; longer, something was found wrong. Rendered adults had 0.85 to 1.25.
_FULL_LENGTH = (0.8, 1.35)
# How far a measured length is believed: also an arm that hangs is some 15 deg out of the view.
_TRUST = 0.7
# Confidence of points that are measured, where there are such.
_SURE = 0.3


@dataclass(frozen=True, kw_only=True)
class BodyMeasure:
    """The size of a person.

    Attributes:
        scale: Metres for a unit of the clip.
        upper_arm: Shoulder to elbow [m].
        forearm: Elbow to wrist [m].
        seen: Whether upper arm and forearm were seen at their full length, or follow from the shoulders.
    """

    scale: float
    upper_arm: float
    forearm: float
    seen: tuple[bool, bool]


def measure_body(body: Points) -> BodyMeasure:
    """Measure a person whose shoulders are seen.

    Args:
        body: BODY_25 in the picture.
    """
    both = [(SHOULDER["left"], SHOULDER["right"])]
    shoulders = float(np.percentile(_lengths(body, both), _SHOULDERS_PERCENTILE))
    limbs, seen = [], []
    for usual, start, end in ((UPPER_ARM, SHOULDER, ELBOW), (FOREARM, ELBOW, WRIST)):
        expected = usual / SHOULDERS * shoulders
        lengths = _lengths(body, [(start[side], end[side]) for side in ("left", "right")])
        longest = float(np.percentile(lengths, _LIMB_PERCENTILE)) if lengths.size else 0.0
        full = _FULL_LENGTH[0] <= longest / expected <= _FULL_LENGTH[1]
        limbs.append(_TRUST * longest + (1.0 - _TRUST) * expected if full else expected)
        seen.append(full)
    # The more of a person was measured the less one odd proportion matters.
    scale = (SHOULDERS + UPPER_ARM + FOREARM) / (shoulders + sum(limbs))
    return BodyMeasure(
        scale=scale, upper_arm=scale * limbs[0], forearm=scale * limbs[1], seen=(seen[0], seen[1])
    )


def _lengths(body: Points, pairs: list[tuple[int, int]]) -> Array:
    """Lengths across the view in all frames in which both ends are sure, or, if there is none, seen."""
    found = []
    for least in (_SURE, 0.0):
        for first, second in pairs:
            sure = (body.confidence[:, [first, second]] > least).all(axis=1)
            away = body.places[sure, first, 1:] - body.places[sure, second, 1:]
            found.append(np.linalg.norm(away, axis=1))
        if any(len(lengths) for lengths in found):
            break
    return np.concatenate(found)
