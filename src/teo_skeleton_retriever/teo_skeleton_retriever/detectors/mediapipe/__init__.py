# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""MediaPipe Holistic.

Its graph without what is not asked of it, which of its hands are believed, and how far its keypoints
are from the joints.
"""
