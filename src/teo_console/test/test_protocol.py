# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What pages may say, and what they are told."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from teo_console.errors import ConsoleError
from teo_console.protocol import SetSpeed, decode, encode_pose, schema_text

SCHEMA = Path(__file__).parents[1] / "protocol.schema.json"


def test_the_schema_that_is_committed_is_that_of_the_types() -> None:
    assert SCHEMA.read_text(encoding="utf-8") == schema_text()


@pytest.mark.parametrize(
    "message",
    [
        "",
        "null",
        "[]",
        "[" * 100_000,
        '{"type": "sign_text", "id": 1}',
        '{"type": "sign_text", "id": 1, "text": ""}',
        '{"type": "sign_text", "id": 1, "text": "' + "a" * 2001 + '"}',
        '{"type": "sign_text", "id": -1, "text": "hola"}',
        '{"type": "sign_text", "id": 1, "text": "hola", "more": 1}',
        '{"type": "sign_text", "id": "1", "text": "hola"}',
        '{"type": "command", "id": 1, "order": "dance"}',
        '{"type": "set_speed", "id": 1, "factor": 0}',
        '{"type": "set_speed", "id": 1, "factor": 1.01}',
        '{"type": "set_speed", "id": 1, "factor": NaN}',
        '{"type": "sign_glosses", "id": 1, "glosses": []}',
        '{"type": "unheard_of", "id": 1}',
        '{"id": 1, "text": "hola"}',
    ],
)
def test_what_is_no_request_is_refused_with_a_reason(message: str) -> None:
    with pytest.raises(ConsoleError) as refused:
        decode(message)
    assert refused.value.code == "malformed"


@pytest.mark.parametrize("factor", [0.1, 1.0])
def test_both_ends_of_the_speeds_are_taken(factor: float) -> None:
    assert decode(f'{{"type": "set_speed", "id": 0, "factor": {factor}}}') == SetSpeed(id=0, factor=factor)


@pytest.mark.parametrize("joints", [0, 1, 28])
def test_a_pose_is_as_the_page_reads_it(joints: int) -> None:
    positions = np.linspace(-7.0, 7.0, joints)
    frame = encode_pose(1.7e9 + 0.1, positions.tolist())
    # As getFloat64(0, true) and Float32Array(data, 8) do.
    assert np.frombuffer(frame[:8], "<f8") == 1.7e9 + 0.1
    assert np.frombuffer(frame[8:], "<f4").tolist() == positions.astype("<f4").tolist()
