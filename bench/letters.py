# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The manual alphabet: is what TEO plays for a letter most like the recording it was made from?

What the planner plays, speed limits and all, goes through forward kinematics and is compared with the
landmarks of each of the thirty recordings by dynamic time warping over handshape, orientation and movement,
in differences that are just seen: a finger's thickness, 15 deg, half a finger's thickness of movement.
`python bench/letters.py` prints the whole table of confusions.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

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
from teo_motion.sentence.posture_choice import postures_of
from teo_sign_capture.alphabet.letter_features import features, recorded_features
from teo_sign_capture.recordings.letter_clips import load_letter_clips
from teo_sign_capture.time_warp import warp
from teo_sign_capture.tracks.hand_model import measure_signer
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_signs.sign import Sign
from teo_signs.tokens import Kind, Token

# Letters of thirty that must be most like their own recording.
TARGET = 28

_RATE = 25.0  # [Hz], of the recordings; TEO's slower motion is warped onto them
# A second recording within this share of the nearest is one that the hand cannot tell from it.
_LOOK_ALIKE = 1.1
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


def measure() -> list[Figure]:
    """How many letters are most like their own recording, which are not, and which look alike."""
    found = likenesses()
    captured = [one for one in found if one.posture == 0]
    # Letters have as many alternatives as were found for them; without one they are as captured.
    played = list({one.letter: one for one in found}.values())
    alike = dict.fromkeys(f"{one.letter}/{name}" for one in found for name in one.look_alikes)
    return [
        Figure("letters most like their own recording, as captured", _count(captured)),
        Figure("letters most like their own recording, in their last alternative", _count(played)),
        Figure("letters that the hand hardly separates", ", ".join(alike) or "none"),
    ]


def _count(found: list[Likeness]) -> str:
    """How many are right, and which are not."""
    wrong = [f"{one.letter} as {one.ranking[0]}" for one in found if not one.right]
    right = f"{len(found) - len(wrong)} of {len(found)} (target {TARGET})"
    return right + (f"; not: {', '.join(wrong)}" if wrong else "")


def likenesses() -> list[Likeness]:
    """Every letter of the table against every recording."""
    robot, lut, clips = Robot.load(), Lut.open(default_lut_directory()), load_letter_clips()
    scale = FINGER_LENGTH / measure_signer(clip.hand for clip in clips.values()).finger_length
    recorded = {letter: recorded_features(clip, scale) for letter, clip in clips.items()}
    return [
        Likeness(
            letter=letter,
            posture=posture,
            distances={name: warp(played, clip).distance for name, clip in recorded.items()},
        )
        for letter in clips
        for posture, knots in enumerate(postures_of(lut[letter]))
        for played in [_played(robot, replace(lut[letter], knots=knots, alternatives=()))]
    ]


def _played(robot: Robot, sign: Sign) -> Array:
    """What TEO shows while it signs a letter."""
    plan = Planner({sign.gloss: sign}, robot=robot).plan([Token(gloss=sign.gloss, kind=Kind.LETTER)])
    timing = plan.timings[0]
    times = np.linspace(timing.start, timing.start + timing.duration, max(2, round(timing.duration * _RATE)))
    places = np.array(
        [
            robot.placements(robot.configuration(dict(zip(plan.names, row, strict=True))), _FRAMES)
            for row in sample_at(plan.motions, times).positions.tolist()
        ]
    )
    fingers = places[:, 1:13, :3, 3].reshape(len(places), 3, 4, 3)
    return features(places[:, 0, :3, :3], fingers, places[:, 13, :3, 3])


def main() -> None:
    """Print what each letter is taken for, and which the hand cannot separate."""
    console = Console(width=160)  # thirty columns
    found = likenesses()
    letters = list(found[0].distances)
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
        table.add_row(f"[bold]{one.letter}[/]{one.posture or ''}", *cells)
    console.print(table)
    for one in found:
        if not one.right:
            console.print(f"{one.letter} is taken for {one.ranking[0]}: {_differences(one)}")
    for one in found:
        if one.right and one.look_alikes:
            console.print(f"{one.letter} is hardly separated from {_differences(one)}")
    for name, some in (("as captured", 0), ("in their first alternative", 1)):
        console.print(f"{name}: {_count([one for one in found if one.posture == some])}")


def _differences(one: Likeness) -> str:
    """The own recording and its look-alikes, with how different each is."""
    names = [one.letter, *(name for name in one.look_alikes if name != one.letter)]
    return ", ".join(f"{name} {one.distances[name]:.1f}" for name in names)


if __name__ == "__main__":
    main()
