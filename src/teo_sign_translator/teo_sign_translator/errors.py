# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The one exception of this package."""

from __future__ import annotations

from teo_common.errors import CodedError


class TranslationError(CodedError):
    """Something that cannot be translated, loaded or trained; the package's README lists the codes."""
