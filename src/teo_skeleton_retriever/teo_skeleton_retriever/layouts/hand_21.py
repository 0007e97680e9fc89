"""The 21 keypoints of a hand; OpenPose and MediaPipe use the same order.

Source: `handParameters.hpp` of OpenPose 1.7.
"""

from __future__ import annotations

from teo_skeleton_retriever.layouts.layout import Layout, bones_of

_KEYPOINTS = (
    "Wrist",  # 0
    *("ThumbCMC", "ThumbMCP", "ThumbIP", "ThumbTip"),  # 1 to 4
    *("IndexMCP", "IndexPIP", "IndexDIP", "IndexTip"),  # 5 to 8
    *("MiddleMCP", "MiddlePIP", "MiddleDIP", "MiddleTip"),  # 9 to 12
    *("RingMCP", "RingPIP", "RingDIP", "RingTip"),  # 13 to 16
    *("PinkyMCP", "PinkyPIP", "PinkyDIP", "PinkyTip"),  # 17 to 20
)
_PAIRS = "0-1-2-3-4 0-5-6-7-8 0-9-10-11-12 0-13-14-15-16 0-17-18-19-20"

HAND_21 = Layout("HAND_21", _KEYPOINTS, bones_of(_KEYPOINTS, _PAIRS))
