# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a translator has done so far."""

from __future__ import annotations

import pytest

from teo_common.diagnostics import Level
from teo_sign_translator.node.diagnostics import Statistics, diagnose


def test_only_the_latest_texts_count_for_the_latency() -> None:
    statistics = Statistics()
    for latency in [9.0] * 10 + [0.001] * 1000:
        statistics.add_done(latency)
    assert statistics.latency(100.0) == pytest.approx(0.001)


def test_a_refused_text_is_a_warning_once() -> None:
    statistics = Statistics()
    levels = []
    for refusals in (0, 2, 0):
        for _ in range(refusals):
            statistics.add_refused("[queue_full] too many")
        levels.append(
            diagnose(statistics, language="ssp", model="m", active=True, waiting=0, signs=None).level
        )
    assert levels == [Level.OK, Level.WARN, Level.OK]
