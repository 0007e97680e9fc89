# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which keypoints people have, in which order.

Bodies, hands and faces; a person in an image (`Person2D`), a person in space (`Skeleton`), and the
frame of a body.
"""
