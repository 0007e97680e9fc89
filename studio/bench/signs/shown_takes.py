# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Takes of written signs as recognition gets them: exact, lifted from points in a picture, and filmed.

Beside what is compared (`recognition.py` of capture) each take has the joints of TEO's arms and fingers, the
plainest thing that could be compared instead.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from signs.pictured import pictured
from signs.score_clips import Draw, performed
from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_names import LEFT_ARM, LEFT_HAND, RIGHT_ARM, RIGHT_HAND
from teo_sign_authoring.notation.performance import performance
from teo_sign_authoring.notation.score_schema import Score
from teo_sign_capture.recognition import MOMENTS, recording_appearance
from teo_sign_capture.recordings.recording import lifted_track, open_recording, track_of
from teo_sign_capture.retarget.arm_kinematics import mirrored
from teo_sign_capture.retarget.robot_motion import free_motion
from teo_sign_capture.tracks.segmentation import the_sign
from teo_sign_capture.tracks.signer_motion import measure_person, signer_motion
from teo_sign_capture.tracks.skeleton_track import SkeletonTrack
from teo_sign_capture.tracks.smoothing import smooth_track
from teo_signs.errors import LutError
from teo_signs.sign import Sign
from teo_synthetic_signer import Take, TakeOptions
from teo_synthetic_signer.errors import SyntheticError
from teo_synthetic_signer.take.take_files import write_film

EXACT, LIFTED, FILMED = "exact keypoints", "lifted from a picture", "filmed in colour"
_RATE = 25.0  # [Hz], as `performed`
_FILM_RATE = 15.0  # [Hz]
_PRESENT = 2.0  # [rad] by which an arm that takes part differs from one that does not
_LIMBS = {"right": RIGHT_ARM + RIGHT_HAND, "left": LEFT_ARM + LEFT_HAND}


@dataclass(frozen=True, kw_only=True)
class ShownTake:
    """A sign that a body has made.

    Attributes:
        gloss: The sign.
        body: Who made it.
        way: `EXACT`, `LIFTED` or `FILMED`.
        shown: What is compared. Shape (MOMENTS, d).
        joints: TEO's joints instead [rad]. Shape (MOMENTS, 26).
    """

    gloss: str
    body: str
    way: str
    shown: Array
    joints: Array


def shown_takes(robot: Robot, draw: Draw, films: int) -> list[ShownTake]:
    """Each sign of a draw by each of its bodies, exact and lifted; the first few by one body each as films.

    What is not cut as one sign is said and left out.
    """
    takes: list[ShownTake] = []
    for turn in range(len(draw.bodies)):
        bodies = draw.bodies[turn:] + draw.bodies[:turn]
        for number, one in enumerate(performed(draw._replace(bodies=bodies))):
            clip = pictured(one.track, distance=draw.distance, rate=_RATE, seed=draw.seed + turn)
            takes += _taken(robot, one.score.gloss, one.body, EXACT, one.track)
            takes += _taken(robot, one.score.gloss, one.body, LIFTED, lifted_track(clip))
            if turn == 0 and number < films:
                takes += _filmed(robot, one.score, one.body, draw.distance)
    return takes


def sign_joints(sign: Sign) -> Array:
    """TEO's joints over a sign of the table. Shape (MOMENTS, 26) [rad]."""
    moments = np.linspace(0.0, sign.duration, MOMENTS)
    limbs: dict[str, Array] = {}
    for side, names in _LIMBS.items():
        if set(names) <= set(sign.joints):
            columns = [sign.knots[:, sign.joints.index(joint)] for joint in names]
            limbs[side] = np.column_stack([np.interp(moments, sign.times, column) for column in columns])
    return _both(limbs)


def _filmed(robot: Robot, score: Score, body: str, distance: float) -> Iterator[ShownTake]:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        script, film = folder / "script.yaml", folder / f"{score.gloss}.mp4"
        script.write_text(performance(score).text, "utf-8")
        try:
            options = TakeOptions(script=str(script), body=body, distance=distance, rate=_FILM_RATE)
            take = Take(options)
            for _ in write_film((take.frame(index) for index in range(len(take))), film):
                pass
            track = track_of(open_recording(film), cache=folder)[0]
        except (LutError, SyntheticError) as error:
            print(f"left out: {score.gloss} by {body}, {FILMED}: {error}")
            return
        yield from _taken(robot, score.gloss, body, FILMED, track)


def _taken(robot: Robot, gloss: str, body: str, way: str, track: SkeletonTrack) -> Iterator[ShownTake]:
    try:
        shown, joints = recording_appearance(robot, track), _track_joints(robot, track)
    except LutError as error:
        print(f"left out: {gloss} by {body}, {way}: {error}")
        return
    yield ShownTake(gloss=gloss, body=body, way=way, shown=shown, joints=joints)


def _track_joints(robot: Robot, track: SkeletonTrack) -> Array:
    smooth = smooth_track(track).track
    span = the_sign(smooth)
    stroke = smooth.between(span.start, span.end)
    signer = signer_motion(stroke, handedness=span.handedness, person=measure_person(track))
    free = free_motion(robot, signer)
    moments = np.linspace(0.0, float(stroke.times[-1]), MOMENTS)
    limbs: dict[str, Array] = {}
    for side, hand in free.hands.items():
        arm = free.arm(side, free.arms)
        limb = np.hstack([arm if side == "right" else mirrored(robot.humanoid, arm), hand.axes])
        limbs[side] = np.column_stack([np.interp(moments, stroke.times, column) for column in limb.T])
    return _both(limbs)


def _both(limbs: dict[str, Array]) -> Array:
    """Right arm and left arm, each behind whether it takes part; zeros of one that does not."""
    absent = np.zeros((MOMENTS, 1 + len(_LIMBS["right"])))
    parts = [
        np.hstack([np.full((MOMENTS, 1), _PRESENT), limbs[side]]) if side in limbs else absent
        for side in ("right", "left")
    ]
    return np.hstack(parts)
