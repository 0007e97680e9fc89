# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Sign scores.

Signs written down by their form, read, brought onto the robot, or performed by the synthetic signer.
"""
