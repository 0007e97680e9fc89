# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The executor as a ROS node: parameters, messages, services, action."""
