# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""By how much palms and fingers of letters and words may differ and still look the same."""

from __future__ import annotations

import numpy as np

# [rad] A palm turns by this much about any axis: what is just seen (`teo_signs.likeness`), a third of the
# 45 deg between a palm to the front and one half to the side.
TURN = np.radians(15.0)
# [m] The end of a finger or thumb moves less than is just seen, the thickness of a finger: two thirds of it.
BEND = 0.010
# [m], [rad] A finger folded by this much at each joint may open farther: it stays folded, where an extended
# finger that bends is soon a hooked one.
FOLDED_BEND, FOLDED = 0.015, np.radians(60.0)
