# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the console refuses."""

from __future__ import annotations

from teo_common.errors import CodedError


class ConsoleError(CodedError):
    """A request of a page, or a setting, that cannot be served."""
