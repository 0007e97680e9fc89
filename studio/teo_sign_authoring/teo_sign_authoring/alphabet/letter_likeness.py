# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Letters as a reader sees them: is what a robot plays most like the recording that it was made from?

What the planner plays, speed limits and all, goes through forward kinematics and is compared with the
landmarks of each recording of the language's alphabet by dynamic time warping over handshape, orientation and
movement, in differences that are just seen: a finger's thickness, 15 deg, half a finger's thickness of
movement. Of fingers that a hand lacks the recordings say nothing either.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from teo_common.arrays import Array
from teo_common.dynamic_programming import warp
from teo_description.hand_geometry import HandGeometry
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_motion.sentence.plan import sample_at
from teo_motion.sentence.posture_choice import postures_of
from teo_sign_authoring.alphabet.letter_clips import LetterClip, find_stroke
from teo_sign_authoring.alphabet.letters import RecordedAlphabet, read_alphabet
from teo_sign_capture.signing_space import finger_rows
from teo_sign_languages import Language
from teo_signs.likeness import SEEN_ANGLE, SEEN_LENGTH
from teo_signs.sign import Sign
from teo_signs.tokens import Kind, Token
from teo_skeleton_retriever.lifting.hand_axes import KNUCKLES, THUMB, palm_axes

# [m] Movement is seen where a difference in place is not. Between half and a third of a finger's thickness
# letters pass for their own recording alike; at a whole one still letters pass for those that differ by
# movement only.
_SEEN_MOVEMENT = SEEN_LENGTH / 2.0


def recordings(robot: Robot, alphabet: RecordedAlphabet) -> dict[str, Array]:
    """`features` of each letter's recording, of the fingers that the robot has, in its size."""
    knuckles = [KNUCKLES[finger] for finger in finger_rows(HandGeometry(robot))]
    return {letter: _recorded(clip, alphabet.scale, knuckles) for letter, clip in alphabet.clips.items()}


def _recorded(clip: LetterClip, scale: float, shown: Sequence[int]) -> Array:
    """What the person shows, from where the hand is in place to where it leaves; a pixel is `scale` [m]."""
    stroke = find_stroke(clip)
    hand = scale * clip.hand[stroke.first : stroke.last + 1]
    ends = np.stack([hand[:, [knuckle + end for knuckle in shown]] for end in (0, 2, 3)], axis=1)
    return features(palm_axes(hand), ends, hand[:, THUMB + 3])


def features(palms: Array, fingers: Array, thumb: Array) -> Array:
    """Handshape, orientation and movement of each frame, in differences that are just seen.

    Args:
        palms: Columns along the hand, to the little finger's side, out of the palm. Shape (n, 3, 3).
        fingers: Knuckles, last joints and tips of the fingers, index first [m]. Shape (n, 3, fingers, 3).
        thumb: Its tip [m]. Shape (n, 3).

    Returns:
        Shape (n, 1, 43 of four fingers): one vector a frame, as `warp` takes them.
    """
    knuckles, tips = fingers[:, 0], np.concatenate([fingers[:, 2], thumb[:, None]], axis=1)
    # Both ends of the last phalanx: a fist and a claw have their tips at like places.
    ends = [fingers[:, 1] - knuckles, fingers[:, 2] - knuckles, (thumb - knuckles[:, 0])[:, None]]
    shape = np.einsum("tij,tki->tkj", palms, np.concatenate(ends, axis=1))
    # Across the view: depth is the unsure part of the recordings.
    movement = (tips - tips.mean(axis=0))[..., 1:]
    parts = (
        shape / (SEEN_LENGTH * np.sqrt(shape.shape[1])),
        palms[:, :, [0, 2]] / (SEEN_ANGLE * np.sqrt(2.0)),
        movement / (_SEEN_MOVEMENT * np.sqrt(movement.shape[1])),
    )
    return np.concatenate([part.reshape(len(part), -1) for part in parts], axis=1)[:, None]


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
    """Letters of a robot against every recording; other signs among its entries are passed over.

    Raises:
        LutError: As `read_alphabet`.
    """
    recorded = recordings(robot, read_alphabet(robot, language))
    return [
        Likeness(
            letter=letter,
            posture=posture,
            distances={name: warp(played, clip).distance for name, clip in recorded.items()},
        )
        for letter in recorded
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
