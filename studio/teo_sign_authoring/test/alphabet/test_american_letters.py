# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The letters of American Sign Language on TEO, against charts of the American manual alphabet."""

from __future__ import annotations

import msgspec
import numpy as np
import pytest

from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_sign_authoring.alphabet.letter_clips import load_letter_clips
from teo_sign_languages import Language, LetterClips, load_language
from teo_signs.likeness import nearest_pairs
from teo_signs.look_up_table import Lut, LutError, Sign

# Index, middle, ring, little finger by charts (T. Humphries, C. Padden, Learning American Sign Language):
# e extended, f folded, h half bent or bent over the thumb. M's little finger is half bent on TEO.
FINGERS = {
    "A": "ffff", "B": "eeee", "C": "eeee", "D": "ehhh", "E": "hhhh", "F": "heee", "G": "efff", "H": "eeff",
    "I": "fffe", "J": "fffe", "K": "eeff", "L": "efff", "M": "hhhh", "N": "hhff", "O": "hhhh", "P": "ehff",
    "Q": "hfff", "R": "eeff", "S": "ffff", "T": "ffff", "U": "eeff", "V": "eeff", "W": "eeef", "X": "hfff",
    "Y": "fffe", "Z": "efff",
}  # fmt: skip
FLEXION = {"e": (0.0, 40.0), "h": (15.0, 65.0), "f": (40.0, 85.1)}  # [deg]


@pytest.fixture(scope="module")
def robot() -> Robot:
    return Robot.load()


@pytest.fixture(scope="module")
def letters() -> dict[str, Sign]:
    lut = Lut.open(language="ase")
    return {letter: lut[letter] for letter in lut.language.alphabet.letters}


def path(robot: Robot, sign: Sign, frame: str) -> Array:
    """Where a part of the hand is at even times: to the signer's left, up [m]. Shape (30, 2)."""
    times = np.linspace(0.0, sign.duration, 30)
    rows = np.column_stack([np.interp(times, sign.times, column) for column in sign.knots.T])
    poses = [dict(zip(sign.joints, row.tolist(), strict=True)) for row in rows]
    return np.array([robot.placement(robot.configuration(pose), frame)[1:3, 3] for pose in poses])


def test_fingers_are_extended_bent_and_folded_as_in_the_charts(letters: dict[str, Sign]) -> None:
    for letter, states in FINGERS.items():
        for finger, (state, bend) in enumerate(
            zip(states, np.degrees(letters[letter].knots[0, 8:]), strict=True)
        ):
            lower, upper = FLEXION[state]
            assert lower <= bend <= upper, f"finger {finger} of {letter}: {bend:.0f} deg"


def test_letters_but_those_that_hang_are_made_at_one_place(robot: Robot, letters: dict[str, Sign]) -> None:
    for letter, sign in letters.items():
        if letter not in "PQ":  # whose notes say so
            assert sign.quality["place_error_mm"] <= 120.0, letter
            made = path(robot, sign, "right_palm").mean(axis=0)
            assert np.ptp([made, path(robot, letters["E"], "right_palm")[0]], axis=0).max() < 0.12, letter


def test_j_and_z_alone_move(letters: dict[str, Sign]) -> None:
    assert {letter for letter, sign in letters.items() if np.ptp(sign.knots, axis=0).max() > 0.0} == {
        "J",
        "Z",
    }


def test_the_little_finger_draws_a_j_as_the_signer_sees_it(robot: Robot, letters: dict[str, Sign]) -> None:
    way = path(robot, letters["J"], "RightPinkyFingerTip")
    assert way[0, 1] - way[-1, 1] > 0.10  # down
    assert way[-1, 0] - way[:15, 0].min() > 0.10  # and round to the left


def test_the_index_draws_a_z_as_the_signer_sees_it(robot: Robot, letters: dict[str, Sign]) -> None:
    left, up = path(robot, letters["Z"], "RightIndexFingerTip").T
    bar = int(left[:15].argmin())
    corner = bar + int(left[bar:].argmax())
    assert left[:bar].max() - left[bar] > 0.04  # to the right
    assert left[corner] - left[bar] > 0.04 and up[bar] - up[corner] > 0.08  # down to the left
    assert left[corner] - left[-1] > 0.08 and abs(up[corner] - up[-1]) < 0.06  # to the right


def test_hands_point_up_across_or_down_as_in_the_charts(robot: Robot, letters: dict[str, Sign]) -> None:
    along = {
        letter: robot.placement(robot.configuration(sign.pose(0)), "right_palm")[:3, 0]
        for letter, sign in letters.items()
    }
    for letter in "ABCDEFIKLMNORSTUVWXY":
        assert along[letter][2] > 0.7, letter
    for letter in "GH":
        assert along[letter][2] < 0.6, letter
    for letter in "PQ":
        assert along[letter][2] < 0.3, letter


def test_letters_can_be_told_apart(robot: Robot, letters: dict[str, Sign]) -> None:
    # TEO cannot cross its fingers: R and U are hardly told apart.
    near = {(pair.first, pair.second): pair.seen for pair in nearest_pairs(robot, list(letters.values()))}
    assert min(near.values()) > 1.0  # just seen differences
    assert {pair for pair, seen in near.items() if seen < 1.5} == {("R", "U")}


def edited(language: Language, **changes: object) -> Language:
    """A language whose recordings are named otherwise."""
    return msgspec.structs.replace(language, alphabet=msgspec.structs.replace(language.alphabet, **changes))


def test_the_american_recordings_under_the_french_name_are_refused() -> None:
    french = edited(load_language("ase"), clips=LetterClips(collection="fsl"))
    with pytest.raises(LutError, match="files of ase under its name") as refusal:
        load_letter_clips(french)
    assert refusal.value.code == "other_language"


def test_letters_without_a_recording_are_named() -> None:
    language = load_language("ase")
    more = edited(language, letters=[*language.alphabet.letters, "Ñ"], frequencies={})
    with pytest.raises(LutError, match="none of Ñ") as refusal:
        load_letter_clips(more)
    assert refusal.value.code == "no_clips"
