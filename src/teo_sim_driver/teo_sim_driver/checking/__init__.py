# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From a message to a trajectory that the robot can execute, or the reason why it cannot."""
