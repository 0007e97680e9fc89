# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Keeping the robot clear of itself: distances along a motion, idle limbs, detours."""
