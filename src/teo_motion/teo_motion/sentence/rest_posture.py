# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Postures in which TEO waits: where sentences begin and end, and idle limbs go."""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum
from types import MappingProxyType

import numpy as np

from teo_common.arrays import Array
from teo_description import COMMANDED_JOINTS, HOME, LEFT_ARM, RIGHT_ARM
from teo_signs.mirroring import mirrored_positions


class RestPosture(StrEnum):
    """Names of the postures."""

    HANGING = "hanging"
    """Arms hang; out of the way of every sign."""
    READY = "ready"
    """Forearms level, hands low before the body, as signers wait for their turn."""


# Of the right arm's joints in `READY`, in the order of RIGHT_ARM [deg]; the left arm mirrors it. Of all
# postures with the hands 35 cm or more under the shoulders, 25 cm or more before them and apart, palms
# neither up nor forward and wrists nearly straight, the one from which the slowest joint of an arm needs
# least time to begin the table's words and letters: 1.3 s in the mean, where hanging arms need 2.1 s.
_READY_RIGHT = (-18.0, -10.0, 32.0, -68.0, 12.0, -12.0)


def _positions() -> Mapping[RestPosture, Array]:
    hanging = np.array([HOME[name] for name in COMMANDED_JOINTS])
    ready = hanging.copy()
    right = np.radians(_READY_RIGHT)
    ready[[COMMANDED_JOINTS.index(name) for name in RIGHT_ARM]] = right
    ready[[COMMANDED_JOINTS.index(name) for name in LEFT_ARM]] = mirrored_positions(RIGHT_ARM, right)
    for positions in (hanging, ready):
        positions.setflags(write=False)
    return MappingProxyType({RestPosture.HANGING: hanging, RestPosture.READY: ready})


# Positions of the 28 commanded joints [rad], by posture. Shape (28,) each.
REST_POSITIONS = _positions()

# Out of the way of everything [rad]. Shape (28,).
HANGING = REST_POSITIONS[RestPosture.HANGING]

# Ready, because a sentence takes 1.5 s less than from hanging arms and back, and because that is how signers
# wait when more is to come.
DEFAULT_REST = RestPosture.READY
REST = REST_POSITIONS[DEFAULT_REST]
