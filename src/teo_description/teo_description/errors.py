# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The exception of this package."""

from __future__ import annotations

from teo_common.errors import CodedError


class DescriptionError(CodedError):
    """Something about the robot was asked for or given wrongly; a code is for example ``unknown_joint``."""
