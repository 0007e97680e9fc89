# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Messages as plain values and text: their classes, filling from YAML, printing. Needs no ROS running."""
