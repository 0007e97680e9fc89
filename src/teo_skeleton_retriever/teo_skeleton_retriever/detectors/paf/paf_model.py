"""What the channels of OpenPose's networks mean. Source: `poseParameters.cpp` of OpenPose 1.7."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from teo_skeleton_retriever.layouts.body_25 import BODY_25
from teo_skeleton_retriever.layouts.coco_18 import COCO_18
from teo_skeleton_retriever.layouts.layout import Layout

IntArray = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class PafModel:
    """A network's output: a confidence map for each part and one of the background, then limb fields.

    Attributes:
        layout: the parts, in the order of their maps.
        limbs: the two parts that each limb's field leads from and to. Shape (limbs, 2).
        fields: for each limb the channels of its field's x and y, counted among the fields. Shape (limbs, 2).
    """

    layout: Layout
    limbs: IntArray
    fields: IntArray

    @property
    def map_channels(self) -> int:
        """Number of confidence maps, that of the background included."""
        return len(self.layout) + 1

    @property
    def field_channels(self) -> int:
        """Number of channels of all fields."""
        return 2 * len(self.limbs)


def _pairs(text: str) -> IntArray:
    array = np.array(text.replace("-", " ").split(), dtype=np.intp).reshape(-1, 2)
    array.flags.writeable = False
    return array


BODY_25_MODEL = PafModel(
    BODY_25,
    _pairs(
        "1-8 1-2 1-5 2-3 3-4 5-6 6-7 8-9 9-10 10-11 8-12 12-13 13-14 1-0 0-15 15-17 0-16 16-18 2-17 5-18 "
        "14-19 19-20 14-21 11-22 22-23 11-24"
    ),
    _pairs(
        "0-1 14-15 22-23 16-17 18-19 24-25 26-27 6-7 2-3 4-5 8-9 10-11 12-13 30-31 32-33 36-37 34-35 38-39 "
        "20-21 28-29 40-41 42-43 44-45 46-47 48-49 50-51"
    ),
)
COCO_18_MODEL = PafModel(
    COCO_18,
    _pairs("1-2 1-5 2-3 3-4 5-6 6-7 1-8 8-9 9-10 1-11 11-12 12-13 1-0 0-14 14-16 0-15 15-17 2-16 5-17"),
    _pairs(
        "12-13 20-21 14-15 16-17 22-23 24-25 0-1 2-3 4-5 6-7 8-9 10-11 28-29 30-31 34-35 32-33 36-37 "
        "18-19 26-27"
    ),
)
PAF_MODELS = (BODY_25_MODEL, COCO_18_MODEL)
