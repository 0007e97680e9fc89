# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A person's keypoints over time [m].

Axes of the body, smoothing, cutting into signs, how the head is held, the signer described once.
"""
