# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From keypoints in an image and its depth to joints in space.

What lies around a keypoint, the skin before a joint, the lengths of limbs, the shape of a hand.
"""
