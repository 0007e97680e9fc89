# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np

from teo_description.hand_geometry import TOUCH, hand_table, thumb_gaps
from teo_description.robot import Robot
from teo_names import LEFT_HAND, RIGHT_HAND
from teo_signs.look_up_table import Lut


def test_no_sign_of_the_table_has_its_thumb_in_a_finger(shipped: Lut) -> None:
    table = hand_table(Robot.load())
    deep = {}
    for gloss, sign in shipped.items():
        postures = [sign.knots, *sign.alternatives, *(form.knots for form in sign.forms.values())]
        for hand in (LEFT_HAND, RIGHT_HAND):
            if hand[0] in sign.joints:
                columns = [sign.joints.index(name) for name in hand]
                gap = thumb_gaps(table, np.concatenate(postures)[:, columns]).min()
                if gap < -TOUCH:
                    deep[gloss] = f"{1000.0 * gap:.1f} mm"
    assert deep == {}
