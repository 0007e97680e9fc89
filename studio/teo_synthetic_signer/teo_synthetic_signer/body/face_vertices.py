# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which vertices of the mesh are the 70 keypoints of the face, and the ears and heels.

Vertices of MakeHuman's base mesh. Chosen by the definition of the iBUG annotation on the average face, seen
from the front: the corners and thirds of the opening of the eye and of the red of the lips, the arc of the
brow, the ridge and the base of the nose, and the outline of the jaw from the height of the eyes to the chin.
No detector had a part in it.
"""

from __future__ import annotations

# Keypoints 0 to 67; the pupils, 68 and 69, are on the eyeballs.
FACE_VERTICES = (
    *(5741, 5735, 5727, 869, 5241, 893, 917, 5222, 5171, 11832, 7619, 7595, 11850, 7574, 12324, 12332, 12338),
    *(207, 206, 177, 180, 209),
    *(6984, 6956, 6953, 6981, 6982),
    *(169, 135, 164, 5054),
    *(318, 285, 317, 7054, 7080),
    *(21, 0, 54, 6767, 6772, 6776),
    *(13363, 6838, 6784, 6805, 13372, 13368),
    *(425, 5354, 460, 362, 7219, 11956, 7185, 7235, 7241, 492, 486, 480),
    *(430, 514, 520, 7261, 7190, 7242, 523, 487),
)
NOSE_TIP = 5054
# The middle of the outer ear.
EARS = {"R": 5506, "L": 12105}
# Hindmost of the foot.
HEELS = {"R": 5856, "L": 12453}
