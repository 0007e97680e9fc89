# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The package's one exception."""

from __future__ import annotations

from teo_common.errors import CodedError


class Ros2CliError(CodedError):
    """A command cannot do what was asked of it.

    Its text is printed on the error stream as it is, and the command exits with status 1.
    """
