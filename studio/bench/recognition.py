# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Which sign of the table a demonstration is: written signs performed by people kept apart.

The synthetic signer performs scores with exact keypoints, laid into a picture with a detector's noise and
lifted, and as films whose points MediaPipe has found. Each is cut out as in a capture and sought among all
words and numbers of the table, beside a search by TEO's joints, the plainest thing that could be compared.
Leave-one-out is of takes: each is sought among the lifted takes of the draw's other bodies.

The units of `recognition.appearance` were chosen on other signs and people.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from threadpoolctl import threadpool_limits  # type: ignore[import-untyped]  # ships no types

from report import Figure, percentiles, share
from signs.performed import EARLIER, Draw, performed, pictured
from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_names import LEFT_ARM, LEFT_HAND, RIGHT_ARM, RIGHT_HAND
from teo_sign_authoring.notation.performance import performance
from teo_sign_authoring.notation.score_schema import Score
from teo_sign_capture.recognition import MOMENTS, SignIndex, recording_appearance, sign_appearance
from teo_sign_capture.recordings.recording import lifted_track, open_recording, track_of
from teo_sign_capture.retarget.arm_kinematics import mirrored
from teo_sign_capture.retarget.robot_motion import free_motion
from teo_sign_capture.tracks.segmentation import the_sign
from teo_sign_capture.tracks.signer_motion import measure_person, signer_motion
from teo_sign_capture.tracks.skeleton_track import SkeletonTrack
from teo_sign_capture.tracks.smoothing import smooth_track
from teo_signs.errors import LutError
from teo_signs.likeness import nearest_pairs
from teo_signs.look_up_table import Lut, default_lut_directory
from teo_signs.sign import Sign
from teo_synthetic_signer import Take, TakeOptions
from teo_synthetic_signer.body.body_shapes import BODIES, random_people
from teo_synthetic_signer.errors import SyntheticError
from teo_synthetic_signer.take.take_files import write_film

BODIES |= random_people(3, 61_409, "learner")
# Drawn when the units were chosen. Looked at, it is known, and another is to be drawn.
NEW = Draw(60_331, 12, ("learner_0", "learner_1", "learner_2"), 1.9, EARLIER[:2])
EXACT, LIFTED, FILMED = "exact keypoints", "lifted from a picture", "filmed in colour"
_FILM_RATE = 15.0  # [Hz]
_PRESENT = 2.0  # [rad] by which an arm that takes part differs from one that does not
_LIMBS = {"right": RIGHT_ARM + RIGHT_HAND, "left": LEFT_ARM + LEFT_HAND}


def measure(signs: int = 12, films: int = 8) -> list[Figure]:
    """Right answers, confusion pairs and time."""
    robot = Robot.load()
    with threadpool_limits(1):
        takes = _takes(robot, NEW._replace(signs=signs), films)
    table = _Table(robot)
    return [
        *table.figures(takes),
        *(_leave_one_out(way, takes) for way in (LIFTED, FILMED) if any(t.way == way for t in takes)),
        _time(table.shown, [take.shown for take in takes]),
    ]


class _Table:
    """The words and numbers of the shipped table, to be sought in two ways."""

    def __init__(self, robot: Robot) -> None:
        lut = Lut.open(default_lut_directory())
        self._robot = robot
        self._signs: dict[str, Sign] = {g: s for g, s in lut.items() if s.kind != "letter"}
        self.shown: Array = np.array([sign_appearance(robot, sign) for sign in self._signs.values()])
        joints = np.array([_sign_joints(sign) for sign in self._signs.values()])
        self._indices = (SignIndex(self._signs, self.shown), SignIndex(self._signs, joints))

    def figures(self, takes: Sequence[_Take]) -> list[Figure]:
        """How often takes of each way are found, and what was confused."""
        figures = []
        for way in (EXACT, LIFTED, FILMED):
            of_way = [take for take in takes if take.way == way]
            if not of_way:
                continue
            first, five, confused = self._rights(0, of_way)
            plain_first, plain_five, _ = self._rights(1, of_way)
            total = len(of_way)
            what = f"{way} ({total} takes), of {len(self._signs)}"
            figures += [
                Figure(f"{what}: first", f"{share(first, total)}; by joints {share(plain_first, total)}"),
                Figure(f"{what}: among five", f"{share(five, total)}; by joints {share(plain_five, total)}"),
                Figure(f"{what}: confused", ", ".join(sorted(confused)) or "none"),
            ]
        return figures

    def _rights(self, way: int, takes: Sequence[_Take]) -> tuple[int, int, set[str]]:
        """Found first, among five, and what was named first instead."""
        first = five = 0
        confused = set()
        for take in takes:
            shown = (take.shown, take.joints)[way]
            named = [match.gloss for match in self._indices[way].nearest(shown)]
            right = [gloss for gloss in named if gloss == take.gloss or self._is_one_form(gloss, take.gloss)]
            first += named[0] in right
            five += bool(right)
            if named[0] not in right:
                confused.add(f"{take.gloss} for {named[0]}")
        return first, five, confused

    def _is_one_form(self, first: str, second: str) -> bool:
        """Whether two glosses name one form: one answer."""
        return not nearest_pairs(self._robot, [self._signs[first], self._signs[second]])


def _leave_one_out(way: str, takes: Sequence[_Take]) -> Figure:
    sought = [take for take in takes if take.way == way]
    right = 0
    for take in sought:
        others = [other for other in takes if other.way == LIFTED and other.body != take.body]
        index = SignIndex([other.gloss for other in others], np.array([other.shown for other in others]))
        right += index.nearest(take.shown, 1)[0].gloss == take.gloss
    return Figure(
        f"a take, {way}, among the other bodies' lifted takes of {len({take.gloss for take in takes})} signs",
        share(right, len(sought)),
    )


def _time(shown: Array, sought: Sequence[Array]) -> Figure:
    """Time of the processor to find the five nearest of the table."""
    index = SignIndex(map(str, range(len(shown))), shown)
    seconds = []
    for one in sought:
        start = time.process_time()
        index.nearest(one)
        seconds.append(time.process_time() - start)
    return percentiles(f"five nearest of a table of {len(shown)}, processor time", seconds)


@dataclass(frozen=True, kw_only=True)
class _Take:
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


def _takes(robot: Robot, draw: Draw, films: int) -> list[_Take]:
    """Each sign of a draw by each of its bodies, exact and lifted; the first few by one body each as films.

    What is not cut as one sign is said and left out.
    """
    found: list[_Take] = []
    for turn in range(len(draw.bodies)):
        bodies = draw.bodies[turn:] + draw.bodies[:turn]
        for number, one in enumerate(performed(draw._replace(bodies=bodies))):
            clip = pictured(one.track, distance=draw.distance, seed=draw.seed + turn)
            found += _taken(robot, one.score.gloss, one.body, EXACT, one.track)
            found += _taken(robot, one.score.gloss, one.body, LIFTED, lifted_track(clip))
            if turn == 0 and number < films:
                found += _filmed(robot, one.score, one.body, draw.distance)
    return found


def _sign_joints(sign: Sign) -> Array:
    """TEO's joints over a sign of the table. Shape (MOMENTS, 26) [rad]."""
    moments = np.linspace(0.0, sign.duration, MOMENTS)
    limbs: dict[str, Array] = {}
    for side, names in _LIMBS.items():
        if set(names) <= set(sign.joints):
            columns = [sign.knots[:, sign.joints.index(joint)] for joint in names]
            limbs[side] = np.column_stack([np.interp(moments, sign.times, column) for column in columns])
    return _both(limbs)


def _filmed(robot: Robot, score: Score, body: str, distance: float) -> Iterator[_Take]:
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


def _taken(robot: Robot, gloss: str, body: str, way: str, track: SkeletonTrack) -> Iterator[_Take]:
    try:
        shown, joints = recording_appearance(robot, track), _track_joints(robot, track)
    except LutError as error:
        print(f"left out: {gloss} by {body}, {way}: {error}")
        return
    yield _Take(gloss=gloss, body=body, way=way, shown=shown, joints=joints)


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
