# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The manual alphabet: is what TEO plays for a letter most like the recording it was made from?

What the planner plays, speed limits and all, goes through forward kinematics and is compared with the
landmarks of each of the thirty recordings by dynamic time warping over handshape, orientation and movement,
in differences that are just seen: a finger's thickness, 15 deg, half a finger's thickness of movement.
`python bench/letters.py` prints the whole table of confusions.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from report import Figure
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table

from teo_common.arrays import Array
from teo_description.hand_geometry import FINGER_LENGTH, FINGERS
from teo_description.robot import Robot
from teo_motion.planner import Planner
from teo_motion.sentence.plan import sample_at
from teo_sign_capture.alphabet.stroke import find_stroke
from teo_sign_capture.entries.take_combination import warp
from teo_sign_capture.recordings.letter_clips import LetterClip, load_letter_clips
from teo_sign_capture.tracks.hand_model import KNUCKLES, THUMB, measure_signer, palm_axes
from teo_signs.likeness import SEEN_ANGLE, SEEN_LENGTH
from teo_signs.look_up_table import Lut
from teo_signs.tokens import Kind, Token

# Letters of thirty that must be most like their own recording.
TARGET = 28

_RATE = 25.0  # [Hz], of the recordings; TEO's slower motion is warped onto them
# A second recording within this share of the nearest is one that the hand cannot tell from it.
_LOOK_ALIKE = 1.1
# [m] Movement is seen where a difference in place is not. Between half and a third of a finger's thickness
# the count is the same (27); at a whole one (23) still letters pass for those that differ by movement only.
_SEEN_MOVEMENT = SEEN_LENGTH / 2.0
_FRAMES = (
    "right_palm",
    *(f"Right{finger}Finger{part}" for part in ("_link", "Distal_link", "Tip") for finger in FINGERS),
    "RightThumbFingerTip",
)


@dataclass(frozen=True, kw_only=True)
class Likeness:
    """How like a letter of TEO's is to each recording.

    Attributes:
        letter: TEO's.
        distances: To each recording, in differences that are just seen.
    """

    letter: str
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


def measure() -> list[Figure]:
    """How many letters are most like their own recording, which are not, and which look alike."""
    found = likenesses()
    right = sum(one.right for one in found)
    wrong = [f"{one.letter} as {one.ranking[0]}" for one in found if not one.right]
    alike = [f"{one.letter}/{name}" for one in found for name in one.look_alikes]
    return [
        Figure(
            "letters whose played motion is most like their own recording",
            f"{right} of {len(found)} (target {TARGET})" + (f"; not: {', '.join(wrong)}" if wrong else ""),
        ),
        Figure("letters that the hand hardly separates", ", ".join(alike) or "none"),
    ]


def likenesses() -> list[Likeness]:
    """Every letter of the table against every recording."""
    robot, lut, clips = Robot.load(), Lut.open(), load_letter_clips()
    planner = Planner(lut, robot=robot)
    scale = FINGER_LENGTH / measure_signer(clip.hand for clip in clips.values()).finger_length
    recorded = {letter: _recorded(clip, scale) for letter, clip in clips.items()}
    return [
        Likeness(
            letter=letter,
            distances={name: warp(played, clip).distance for name, clip in recorded.items()},
        )
        for letter, played in ((letter, _played(robot, planner, letter)) for letter in clips)
    ]


def _played(robot: Robot, planner: Planner, letter: str) -> Array:
    """What TEO shows while it signs a letter."""
    plan = planner.plan([Token(gloss=letter, kind=Kind.LETTER)])
    timing = plan.timings[0]
    times = np.linspace(timing.start, timing.start + timing.duration, max(2, round(timing.duration * _RATE)))
    places = np.array(
        [
            robot.placements(robot.configuration(dict(zip(plan.names, row, strict=True))), _FRAMES)
            for row in sample_at(plan.motions, times).positions.tolist()
        ]
    )
    fingers = places[:, 1:13, :3, 3].reshape(len(places), 3, 4, 3)
    return _features(places[:, 0, :3, :3], fingers, places[:, 13, :3, 3])


def _recorded(clip: LetterClip, scale: float) -> Array:
    """What the person shows, in TEO's size, from where the hand is in place to where it leaves."""
    stroke = find_stroke(clip)
    hand = scale * clip.hand[stroke.first : stroke.last + 1]
    fingers = np.stack([hand[:, [knuckle + end for knuckle in KNUCKLES]] for end in (0, 2, 3)], axis=1)
    return _features(palm_axes(hand), fingers, hand[:, THUMB + 3])


def _features(palms: Array, fingers: Array, thumb: Array) -> Array:
    """Handshape, orientation and movement of each frame, in differences that are just seen.

    Args:
        palms: Columns along the hand, to the little finger's side, out of the palm. Shape (n, 3, 3).
        fingers: Knuckles, last joints and tips of index to little finger [m]. Shape (n, 3, 4, 3).
        thumb: Its tip [m]. Shape (n, 3).

    Returns:
        Shape (n, 1, 43): one vector a frame, as `warp` takes them.
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


def main() -> None:
    """Print what each letter is taken for, and which the hand cannot separate."""
    console = Console(width=160)  # thirty columns
    found = likenesses()
    letters = [one.letter for one in found]
    table = Table("TEO's", *letters, title="difference from each recording", box=SIMPLE_HEAD, padding=0)
    for one in found:
        nearest = one.ranking[0]
        cells = [
            f"[{'bold green' if one.right else 'bold red'}]{one.distances[name]:.1f}[/]"
            if name == nearest
            else f"[bold]{one.distances[name]:.1f}[/]"
            if name == one.letter
            else f"[dim]{one.distances[name]:.0f}[/]"
            for name in letters
        ]
        table.add_row(f"[bold]{one.letter}[/]", *cells)
    console.print(table)
    for one in found:
        if not one.right:
            console.print(f"{one.letter} is taken for {one.ranking[0]}: {_differences(one)}")
    for one in found:
        if one.right and one.look_alikes:
            console.print(f"{one.letter} is hardly separated from {_differences(one)}")
    right = sum(one.right for one in found)
    console.print(f"{right} of {len(found)} are most like their own; target {TARGET}")


def _differences(one: Likeness) -> str:
    """The own recording and its look-alikes, with how different each is."""
    names = [one.letter, *(name for name in one.look_alikes if name != one.letter)]
    return ", ".join(f"{name} {one.distances[name]:.1f}" for name in names)


if __name__ == "__main__":
    main()
