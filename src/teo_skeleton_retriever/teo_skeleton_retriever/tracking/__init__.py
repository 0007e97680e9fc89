# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""People over time: who is who, who signs, how large they are, and keypoints filtered."""
