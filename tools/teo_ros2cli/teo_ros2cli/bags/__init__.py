# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Bags as files: MCAP and `metadata.yaml`, as rosbag2 Jazzy writes them. Needs no ROS running."""
