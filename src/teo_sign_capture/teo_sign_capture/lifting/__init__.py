# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From points in a picture to keypoints in space, by the lengths of a person's limbs and bones."""
