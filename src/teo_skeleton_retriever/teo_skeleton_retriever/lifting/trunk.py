# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How far the trunk of a person in a clip is turned away from the camera.

The breadth of the shoulders alone does not tell: it hardly changes up to 20 deg, and not by which side comes
forward. A detector that imagines depths knows both.
"""

from __future__ import annotations

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.lifting.clip import SHOULDER, Points
from teo_skeleton_retriever.lifting.depth_smoothing import smooth_depth

# What is true of the depths that MediaPipe gives shoulders: of 42 takes of six rendered people who stood
# turned by up to 45 deg, the tangent of the true turn was 0.38 of theirs; 5.5 deg remained.
_SHARE = 0.38
# [rad] Deviation of a turn that was found. Most signers face the camera: of a turn that is no larger than
# this little is believed, of a larger one nearly all.
_DEVIATION = np.radians(10.0)
# [rad] Deviation from one frame to the next, and the acceleration with which trunks turn [rad/s^2]: a raised
# arm pulls the shoulder that is found along, a signer who turns to somebody takes half a second.
_TREMBLE, _ACCELERATION = np.radians(5.0), 5.0
# [rad] Beyond this one shoulder hides the other.
_MOST = np.radians(60.0)


def trunk_turn(body: Points, *, period: float) -> FloatArray:
    """How far the trunk is turned to the person's own right in each frame [rad]; 0 where nothing tells it.

    Args:
        body: BODY_25 in the picture; depths in its scale, as the detector imagines them.
        period: Between two frames [s].

    Returns:
        Positive where the left shoulder is in front. Shape (T,).
    """
    away = body.places[:, SHOULDER["left"]] - body.places[:, SHOULDER["right"]]
    turn = np.arctan2(_SHARE * away[:, 0], np.abs(away[:, 1]))[:, None]
    smooth = smooth_depth(turn, np.full_like(turn, _TREMBLE), period=period, acceleration=_ACCELERATION)[:, 0]
    found = np.nan_to_num(smooth)
    believed = found**2 / (found**2 + _DEVIATION**2)
    return np.asarray(np.clip(believed * found, -_MOST, _MOST))
