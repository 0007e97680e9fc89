# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A person's motion as a motion of the robot.

Where hands belong, arms, fingers, head, distances to the body, knots.
"""
