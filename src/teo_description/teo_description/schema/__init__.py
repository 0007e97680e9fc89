# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The fields of ``robot.yaml``, by what they are about. Angles are in degrees there."""
