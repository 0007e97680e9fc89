# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Numbers in ``robot.yaml``."""

from __future__ import annotations

import sys
from typing import Annotated

import msgspec

# NaN is within no bounds, and infinity beyond the greatest number.
_MOST = sys.float_info.max

Finite = Annotated[float, msgspec.Meta(ge=-_MOST, le=_MOST)]
Positive = Annotated[float, msgspec.Meta(gt=0.0, le=_MOST)]
Vector = tuple[Finite, Finite, Finite]
