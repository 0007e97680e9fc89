# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What pages may say, and what they are told."""

from __future__ import annotations

import json
import struct
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from teo_console.errors import ConsoleError
from teo_console.protocol import SetSpeed, SignText, decode, decode_pose, encode_pose, schema_text

SCHEMA = Path(__file__).parents[1] / "protocol.schema.json"


def test_the_schema_that_is_committed_is_that_of_the_types() -> None:
    assert SCHEMA.read_text(encoding="utf-8") == schema_text()


def test_a_request_is_read() -> None:
    assert decode('{"type": "sign_text", "id": 3, "text": "¿Qué tal?"}') == SignText(id=3, text="¿Qué tal?")


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


@given(st.text(max_size=200))
def test_any_text_is_either_a_request_or_refused(message: str) -> None:
    try:
        decode(message)
    except ConsoleError as error:
        assert error.code == "malformed"


@given(st.floats(0.1, 1.0))
def test_every_speed_in_the_range_is_taken(factor: float) -> None:
    assert decode(json.dumps({"type": "set_speed", "id": 0, "factor": factor})) == SetSpeed(
        id=0, factor=factor
    )


@given(st.floats(0.0, 4e9), st.lists(st.floats(-7.0, 7.0, width=32), max_size=60))
def test_a_pose_comes_back_as_it_was(stamp: float, positions: list[float]) -> None:
    frame = encode_pose(stamp, positions)
    assert decode_pose(frame) == (stamp, tuple(positions))
    assert len(frame) == 8 + 4 * len(positions)
    assert struct.unpack_from("<d", frame)[0] == stamp  # as the page reads it: getFloat64(0, true)
