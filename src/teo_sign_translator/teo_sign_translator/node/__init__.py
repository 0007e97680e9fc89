# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The translator as a ROS node: texts in, sign tokens out, in the order in which they come."""
