# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the `ros2` command does on a real graph: playing and recording bags, publishing once, interrupts."""
