# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a depth camera, the detector and the retargeting do to a sign on its way to the robot.

A sign's score is brought onto TEO at once (`capture_scores`) and, the long way, as a demonstration is:
performed by the synthetic signer before a RealSense D435 at 1.5 m, found in the images, cut out, retargeted.
What differs is the error of the camera path. Done once more with the true keypoints in place of those found
in the images, it is the error of performing and retargeting alone; what differs between those two is the
detector's. Performances are kept between runs.
"""

from __future__ import annotations

import hashlib
import math
from pathlib import Path
from typing import NamedTuple

import numpy as np
from rich.progress import track

from kept import kept_folder
from report import Figure
from teo_common.arrays import Array
from teo_common.dynamic_programming import warp
from teo_description.robot import Robot
from teo_sign_authoring.notation.performance import performance
from teo_sign_authoring.notation.score_file import default_scores_directory, read_score
from teo_sign_authoring.notation.score_retarget import score_sign
from teo_sign_authoring.notation.score_schema import Score
from teo_sign_capture.entries.take import capture_take
from teo_sign_capture.entries.take_combination import features
from teo_sign_capture.recordings.recording import open_recording, track_of
from teo_sign_capture.retarget.robot_motion import RobotMotion
from teo_signs.errors import LutError
from teo_signs.sign import Sign
from teo_signs.sign_schema import Handedness
from teo_synthetic_signer import Take, TakeOptions
from teo_synthetic_signer.take.take_files import write_take

# One and two hands; at the head, the chest, in the air and on the other hand; arcs, circles, wiggles.
SIGNS = (
    "ADIÓS BIEN GRACIAS AGUA AMIGO AMOR AYUDAR CALLE CASA COMER CREER CUANDO DORMIR ENTENDER ESCUELA HABLAR "
    "HACER IR LIBRO MADRE MÚSICA PENSAR TRABAJAR TREN TÚ YO"
)
_RATE = 15.0  # [Hz] of the images
_STEP = 0.02  # [s] between samples of the score's own motion
_PARTS = ("wrist's place (mm)", "palm (deg)", "fingers (deg)", "flexion (deg)")
_BODY = "woman_average"
# What is compared.
_WAYS = {
    "camera path against the score itself": ("direct", "seen"),
    "true keypoints against the score itself": ("direct", "true"),
    "camera path against true keypoints": ("true", "seen"),
}
_PALM = 0.09  # [m] from the middle of TEO's palm back to its wrist
_FINGERS = ("Index", "Middle", "Ring", "Pinky")


class _Motions(NamedTuple):
    """A sign as it came onto TEO: `direct`, by `true` keypoints and as `seen`; and why some are not there."""

    gloss: str
    ways: dict[str, RobotMotion]
    failed: str


def measure(signs: int = 3) -> list[Figure]:
    """Compare the first signs: a minute for each at first, later they are found on disk."""
    robot = Robot.load()
    made = [_motions(robot, gloss) for gloss in track(SIGNS.split()[:signs], "signs")]
    figures = []
    for about, (first, second) in _WAYS.items():
        pairs = [one for one in made if {first, second} <= one.ways.keys()]
        errors = np.array([_differences(robot, one.ways[first], one.ways[second]) for one in pairs])
        for part, column in zip(_PARTS, errors.reshape(-1, len(_PARTS)).T, strict=True):
            if pairs:
                worst = pairs[int(np.argmax(column))].gloss
                value = f"median {np.median(column):.0f}, worst {column.max():.0f} ({worst})"
                figures.append(Figure(f"{about}, {part}, {len(pairs)} signs", value))
    return figures + [Figure(f"{one.gloss}: not captured", one.failed) for one in made if one.failed]


def _motions(robot: Robot, gloss: str) -> _Motions:
    score = read_score(default_scores_directory() / f"{gloss}.yaml")
    handedness: Handedness = "right" if score.hands == "right" else "both"
    found = _Motions(gloss, {}, "")
    try:
        found.ways["direct"] = _sampled(score_sign(robot, score))
        folder = kept_folder("camera_path", "teo_synthetic_signer", "teo_skeleton_retriever")
        recording = open_recording(_performed(score, folder))
        for name, topic in (("true", "/truth/skeletons"), ("seen", None)):
            person, _ = track_of(recording, cache=folder, topic=topic)
            found.ways[name] = capture_take(robot, person, handedness=handedness).motion
    except LutError as error:
        return found._replace(failed=str(error))
    return found


def _performed(score: Score, folder: Path) -> Path:
    """The recording of a score's performance, from disk if it is there."""
    text = performance(score).text
    digest = hashlib.sha256(f"{_BODY} {_RATE} {text}".encode()).hexdigest()[:12]
    bag = folder / f"{score.gloss}-{digest}"
    if not bag.exists():
        script = bag.with_suffix(".yaml")
        folder.mkdir(parents=True, exist_ok=True)
        script.write_text(text, "utf-8")
        take = Take(TakeOptions(script=str(script), body=_BODY, sensor="d435", distance=1.5, rate=_RATE))
        for _ in write_take((take.frame(index) for index in range(len(take))), bag):
            pass
    return bag


def _sampled(sign: Sign) -> RobotMotion:
    """A sign of the table as a motion, straight between its knots."""
    times = np.linspace(0.0, sign.duration, max(2, math.ceil(sign.duration / _STEP)))
    positions = np.column_stack([np.interp(times, sign.times, column) for column in sign.knots.T])
    unknown = np.full((len(times), 2), np.nan)
    return RobotMotion(
        times=times,
        joints=sign.joints,
        positions=positions,
        place_error=unknown,
        seen_place_error=unknown,
        contact=unknown,
        same_zone=unknown,
        same_zone_of_middle=unknown,
        wrong_place=unknown,
        palm_error=unknown,
        finger_error=unknown,
        flexion_error=unknown,
        head_error=unknown[:, 0],
        trunk_error=unknown[:, 0],
        clearance=unknown[:, 0],
        handshapes={},
    )


def _differences(robot: Robot, first: RobotMotion, second: RobotMotion) -> Array:
    """Medians over time, once aligned, of the worse hand. Shape (4,)."""
    pairs = warp(features(robot, first), features(robot, second)).pairs
    found = []
    for side in ("right", "left"):
        if f"{side.capitalize()}IndexFinger" not in first.joints:
            continue
        one, other = (_hand(robot, motion, side)[pairs[:, way]] for way, motion in enumerate((first, second)))
        found.append(
            [
                1000.0 * np.median(np.linalg.norm(one[:, :3] - other[:, :3], axis=1)),
                np.degrees(np.median(_angles(one[:, 3:6], other[:, 3:6]))),
                np.degrees(np.median(_angles(one[:, 6:9], other[:, 6:9]))),
                np.degrees(np.median(np.abs(one[:, 9:] - other[:, 9:]).mean(axis=1))),
            ]
        )
    worse: Array = np.max(found, axis=0)
    return worse


def _hand(robot: Robot, motion: RobotMotion, side: str) -> Array:
    """Place of the wrist, ways of palm and fingers, bends of four fingers. Shape (n, 13)."""
    bends = [motion.joints.index(f"{side.capitalize()}{finger}Finger") for finger in _FINGERS]
    rows = []
    for pose in motion.positions:
        placed = robot.placement(
            robot.configuration(dict(zip(motion.joints, pose.tolist(), strict=True))), f"{side}_palm"
        )
        wrist = placed[:3, 3] - _PALM * placed[:3, 0]
        rows.append(np.concatenate([wrist, placed[:3, 2], placed[:3, 0], pose[bends]]))
    return np.array(rows)


def _angles(first: Array, second: Array) -> Array:
    cosines = (first * second).sum(axis=1)
    angles: Array = np.arccos(np.clip(cosines, -1.0, 1.0))
    return angles
