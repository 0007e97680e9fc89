# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The manual alphabet: is what a robot plays for a letter most like the recording it was made from?

What the planner plays, speed limits and all, goes through forward kinematics and is compared with the
landmarks of each recording of the language's alphabet by dynamic time warping over handshape, orientation and
movement, in differences that are just seen: a finger's thickness, 15 deg, half a finger's thickness of
movement. Of fingers that a hand lacks the recordings say nothing either.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from teo_common.arrays import Array
from teo_common.dynamic_programming import warp
from teo_description.hand_geometry import HandGeometry
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_motion.sentence.plan import sample_at
from teo_motion.sentence.posture_choice import postures_of
from teo_sign_authoring.alphabet.letter_features import features, recorded_features
from teo_sign_authoring.alphabet.letters import read_alphabet
from teo_sign_capture.signing_space import finger_rows
from teo_sign_languages import Language
from teo_signs.sign import Sign
from teo_signs.tokens import Kind, Token

_RATE = 25.0  # [Hz], of the recordings; a robot's slower motion is warped onto them
# A second recording within this share of the nearest is one that the hand cannot tell from it.
_LOOK_ALIKE = 1.1


@dataclass(frozen=True, kw_only=True)
class Likeness:
    """How like a robot's letter is to each recording.

    Attributes:
        letter: The robot's.
        posture: Which of its postures: 0 as captured, then its alternatives.
        distances: To each recording, in differences that are just seen.
    """

    letter: str
    posture: int
    distances: dict[str, float]

    @property
    def ranking(self) -> list[str]:
        """Recordings, the most alike first."""
        return sorted(self.distances, key=lambda name: self.distances[name])

    @property
    def right(self) -> bool:
        """Whether its own recording is the most alike."""
        return self.ranking[0] == self.letter

    @property
    def look_alikes(self) -> list[str]:
        """Other recordings that are about as like as the nearest."""
        nearest = self.distances[self.ranking[0]]
        return [
            name
            for name in self.ranking
            if name != self.letter and self.distances[name] <= _LOOK_ALIKE * nearest
        ]


def letter_likenesses(robot: Robot, language: Language, letters: Mapping[str, Sign]) -> list[Likeness]:
    """Letters of a robot against every recording.

    Args:
        robot: The robot.
        language: Whose letters they are.
        letters: The robot's entries; other signs among them are passed over.

    Raises:
        LutError: As `read_alphabet`.
    """
    alphabet = read_alphabet(robot, language)
    rows = finger_rows(HandGeometry(robot))
    recorded = {
        letter: recorded_features(clip, alphabet.scale, rows) for letter, clip in alphabet.clips.items()
    }
    return [
        Likeness(
            letter=letter,
            posture=posture,
            distances={name: warp(played, clip).distance for name, clip in recorded.items()},
        )
        for letter in alphabet.clips
        if letter in letters
        for posture, knots in enumerate(postures_of(letters[letter]))
        for played in [_played(robot, replace(letters[letter], knots=knots, alternatives=()))]
    ]


def _played(robot: Robot, sign: Sign) -> Array:
    """What the robot shows while it signs a letter."""
    plan = Planner({sign.gloss: sign}, robot=robot).plan([Token(gloss=sign.gloss, kind=Kind.LETTER)])
    timing = plan.timings[0]
    times = np.linspace(timing.start, timing.start + timing.duration, max(2, round(timing.duration * _RATE)))
    hand = robot.humanoid.file.hand
    # Knuckles, last joints and tips.
    ends = [frames[end] for end in (0, 2, 3) for frames in hand.fingers.values()]
    frames = [hand.palm, *ends, hand.thumb[-1]]
    places = np.array(
        [
            robot.placements(robot.configuration(dict(zip(plan.names, row, strict=True))), frames)
            for row in sample_at(plan.motions, times).positions.tolist()
        ]
    )
    fingers = places[:, 1:-1, :3, 3].reshape(len(places), 3, len(hand.fingers), 3)
    return features(places[:, 0, :3, :3], fingers, places[:, -1, :3, 3])
