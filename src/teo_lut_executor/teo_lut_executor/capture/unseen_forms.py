"""Letters whose clip does not show the hand: written down instead of measured."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from teo_lut_executor.capture.hand_model import HandPose

Array = NDArray[np.float64]


def _palm(along: tuple[float, float, float], out: tuple[float, float, float]) -> Array:
    first = np.array(along) / np.linalg.norm(along)
    third = np.array(out) - (np.array(out) @ first) * first
    third /= np.linalg.norm(third)
    return np.column_stack([first, np.cross(third, first), third])


def _bunched(palm: Array) -> HandPose:
    """All finger tips together with the thumb's, half a finger before the knuckles."""
    tips = np.array([[0.55, 0.20, 0.62], [0.60, 0.28, 0.62], [0.55, 0.36, 0.62], [0.48, 0.44, 0.58]])
    thumb = np.array([[-0.35, 0.05, 0.45], [0.10, 0.15, 0.58], [0.40, 0.28, 0.62]])
    return HandPose(
        rotation=palm,
        bends=np.radians([[45.0, 30.0, 15.0]] * 4),
        spreads=np.zeros(4),
        thumb=thumb,
        tips=tips,
        residual=float("nan"),
    )


# Q: the hand points at the camera, the landmarks jump. Seen before and after: fingers together; in the
# stroke: all landmarks within a quarter of the hand's length, tips upwards a little, and the palm facing up
# and to the signer's left in frames 6 and 12, down and to the left in frames 16 to 20.
_AHEAD = (0.88, 0.20, 0.42)
UNSEEN_FORMS: dict[str, tuple[HandPose, ...]] = {
    "Q": (_bunched(_palm(_AHEAD, (-0.43, 0.68, 0.56))), _bunched(_palm(_AHEAD, (0.17, 0.72, -0.68)))),
}
