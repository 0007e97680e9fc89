# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The exceptions of signs: of the table, and of sentences that cannot be signed."""

from __future__ import annotations

from teo_common.errors import CodedError


class LutError(CodedError):
    """A table or an entry that cannot be used; the codes are listed in `LUT.md`."""


class PlanError(CodedError):
    """A sentence that cannot be signed; the codes are listed in the README of `teo_lut_executor`."""
