# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Handshapes of letters: a person's is who spells in the recordings, TEO's what the table spells with."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from teo_description.robot import Robot
from teo_sign_authoring.alphabet.letters import RecordedAlphabet, letter_bends, read_alphabet
from teo_sign_capture.retarget import handshapes
from teo_sign_languages import DEFAULT_LANGUAGE, load_language
from teo_signs.look_up_table import Lut

PERSONS = Path(handshapes.__file__).with_name("person_handshapes.tsv")
LETTERS = [name for name in handshapes.SHOWN if name.startswith("letter_")]


@pytest.fixture(scope="module")
def alphabet(robot: Robot) -> RecordedAlphabet:
    return read_alphabet(robot, load_language(DEFAULT_LANGUAGE))


@pytest.mark.parametrize("name", LETTERS)
def test_a_letters_hand_is_the_recordings_and_the_tables(
    robot: Robot, shipped: Lut, alphabet: RecordedAlphabet, name: str
) -> None:
    letter = name.removeprefix("letter_").upper()
    (row,) = [line.split("\t") for line in PERSONS.read_text().splitlines() if line.startswith(f"{name}\t")]
    bends = np.array(row[2:14], dtype=float).reshape(4, 3).sum(axis=1)
    assert bends == pytest.approx(np.degrees(letter_bends(alphabet, letter)[0]), abs=2.0)
    sign = shipped[letter]
    hand = [sign.joints.index(joint) for joint in robot.humanoid.hand("right")]
    assert np.degrees(handshapes.written_shape(name)) == pytest.approx(
        np.degrees(sign.knots[0, hand]), abs=1.0
    )
