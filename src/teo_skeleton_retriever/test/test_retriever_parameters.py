# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import pytest
from refusals import refused

from teo_skeleton_retriever.retriever_parameters import RetrieverParameters


@pytest.mark.parametrize(
    ("changes", "code"),
    [
        ({"min_confidence": 1.5}, "out_of_range"),
        ({"hold_time": math.nan}, "out_of_range"),
        ({"max_depth": "far"}, "wrong_type"),
        ({"skin_offset": 1}, "wrong_type"),
        ({"smoothing": True}, "wrong_type"),
        ({"signer_rule": "loudest"}, "unknown_choice"),
        ({"min_depth": 3.0, "max_depth": 2.0}, "bad_range"),
    ],
)
def test_what_is_no_value_of_a_parameter_is_refused(changes: dict[str, object], code: str) -> None:
    with refused(code):
        RetrieverParameters(**changes)  # type: ignore[arg-type]
