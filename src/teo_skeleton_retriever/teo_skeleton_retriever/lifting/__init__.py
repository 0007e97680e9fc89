# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""People in space from one camera without depth: by the lengths of limbs and bones, and the shape of a head.

`lifted_person.lift_clip` lifts a whole `clip.PoseClip` at once, as what comes later tells what was before.
"""
