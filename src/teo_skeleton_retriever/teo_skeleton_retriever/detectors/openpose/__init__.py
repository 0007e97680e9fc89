# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""OpenPose's files of keypoints: read as it writes them, beside a recording, or all known already."""
