# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The executor: sign tokens in, joint trajectories out, one sentence at a time; commands `lut` and `plan`.

`teo_lut_executor.execution` offers the queue without ROS. Nothing is imported here: a command that only reads
the table starts in half the time without the planner.
"""
