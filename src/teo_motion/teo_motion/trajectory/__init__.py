# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Joints between waypoints: limits, Ruckig segments, timing, splicing, stopping."""
