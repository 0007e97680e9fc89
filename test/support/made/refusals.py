# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What is refused, by its stable reason."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from teo_common.errors import CodedError


@contextmanager
def refused(code: str, said: str | None = None) -> Iterator[pytest.ExceptionInfo[CodedError]]:
    """Expect a refusal.

    Args:
        code: Its reason.
        said: A pattern that its sentence holds.
    """
    with pytest.raises(CodedError, match=said) as caught:
        yield caught
    assert caught.value.code == code, caught.value
