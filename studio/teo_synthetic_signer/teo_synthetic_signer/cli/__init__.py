# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`synthesize`, and `sensor_study`, which compares depth cameras for signing."""
