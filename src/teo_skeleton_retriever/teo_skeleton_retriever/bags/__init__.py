# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Recordings of ROS 1 and ROS 2, whole or cut off.

Which topics they hold, and their images with depth and camera.
"""
