# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a depth camera, the detector and the retargeting do to a sign on its way to the robot.

A sign's score is brought onto TEO at once (`capture_scores`) and, the long way, as a demonstration is:
performed by the synthetic signer before a RealSense D435 at 1.5 m, found in the images, cut out, retargeted.
What differs is the error of the camera path. Done once more with the true keypoints in place of those found
in the images, it is the error of performing and retargeting alone; what differs between those two is the
detector's.
"""

from __future__ import annotations

import argparse
import hashlib
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.progress import track as progress
from rich.table import Table

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

FEW = ("ADIÓS", "BIEN", "GRACIAS")
# One and two hands; at the head, the chest, in the air and on the other hand; arcs, circles, wiggles.
MANY = (
    *(
        "ADIÓS",
        "AGUA",
        "AMIGO",
        "AMOR",
        "AYUDAR",
        "BIEN",
        "CALLE",
        "CASA",
        "COMER",
        "CREER",
        "CUANDO",
        "DORMIR",
    ),
    *(
        "ENTENDER",
        "ESCUELA",
        "GRACIAS",
        "HABLAR",
        "HACER",
        "IR",
        "LIBRO",
        "MADRE",
        "MÚSICA",
        "PENSAR",
        "TRABAJAR",
    ),
    *("TREN", "TÚ", "YO"),
)
_RATE = 15.0  # [Hz] of the images
_STEP = 0.02  # [s] between samples of the score's own motion
_PARTS = ("wrist's place (mm)", "palm (deg)", "fingers (deg)", "flexion (deg)")
_WAYS = {
    "camera": "camera path against the score itself",
    "truth": "true keypoints against the score itself",
    "detector": "camera path against true keypoints",
}
_PALM = 0.09  # [m] from the middle of TEO's palm back to its wrist
_FINGERS = ("Index", "Middle", "Ring", "Pinky")


@dataclass(frozen=True, kw_only=True)
class Result:
    """One sign; each way's differences are medians over its time, of the worse hand. Shape (4,), by `_PARTS`.

    Attributes:
        gloss: Its name.
        camera: The camera path against the score itself.
        truth: True keypoints against the score itself.
        detector: The camera path against true keypoints.
        failed: Why some of these are not there (NaN); empty if all are.
    """

    gloss: str
    camera: Array
    truth: Array
    detector: Array
    failed: str = ""


def evaluate(glosses: Sequence[str], folder: Path, *, body: str = "woman_average") -> list[Result]:
    """Bring signs onto TEO in three ways and compare them.

    Args:
        glosses: Names of scores.
        folder: Keeps recordings and what was found in them between runs.
        body: Who performs.
    """
    robot, scores = Robot.load(), default_scores_directory()
    return [_result(robot, read_score(scores / f"{gloss}.yaml"), folder, body) for gloss in glosses]


def _result(robot: Robot, score: Score, folder: Path, body: str) -> Result:
    handedness: Handedness = "right" if score.hands == "right" else "both"
    motions: dict[str, RobotMotion] = {}
    failed = ""
    try:
        motions["direct"] = _sampled(score_sign(robot, score))
        recording = open_recording(_performed(score, folder, body))
        for name, topic in (("true", "/truth/skeletons"), ("seen", None)):
            person, _ = track_of(recording, cache=folder, topic=topic)
            motions[name] = capture_take(robot, person, handedness=handedness).motion
    except LutError as error:
        failed = str(error)

    def differences(first: str, second: str) -> Array:
        if first in motions and second in motions:
            return _differences(robot, motions[first], motions[second])
        return np.full(len(_PARTS), np.nan)

    return Result(
        gloss=score.gloss,
        camera=differences("direct", "seen"),
        truth=differences("direct", "true"),
        detector=differences("true", "seen"),
        failed=failed,
    )


def _performed(score: Score, folder: Path, body: str) -> Path:
    """The recording of a score's performance, from disk if it is there."""
    text = performance(score).text
    digest = hashlib.sha256(f"{body} {_RATE} {text}".encode()).hexdigest()[:12]
    bag = folder / f"{score.gloss}-{digest}"
    if not bag.exists():
        script = bag.with_suffix(".yaml")
        folder.mkdir(parents=True, exist_ok=True)
        script.write_text(text, "utf-8")
        take = Take(TakeOptions(script=str(script), body=body, sensor="d435", distance=1.5, rate=_RATE))
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


def default_cache() -> Path:
    """Give the folder that performances are kept in unless another is named."""
    return kept_folder("camera_path", "teo_synthetic_signer", "teo_skeleton_retriever")


def measure() -> list[Figure]:
    """Compare a few signs: the first run takes a minute, later ones find the performances on disk."""
    return figures(evaluate(FEW, default_cache()))


def figures(results: Sequence[Result]) -> list[Figure]:
    """Put medians and the worst sign of each way into words."""
    given = []
    for way, about in _WAYS.items():
        made = [result for result in results if np.isfinite(getattr(result, way)).all()]
        errors = np.array([getattr(result, way) for result in made]).reshape(-1, len(_PARTS))
        for part, column in zip(_PARTS, errors.T, strict=True):
            if made:
                worst = made[int(np.argmax(column))].gloss
                value = f"median {np.median(column):.0f}, worst {column.max():.0f} ({worst})"
                given.append(Figure(f"{about}, {part}, {len(made)} signs", value))
    given += [Figure(f"{result.gloss}: not captured", result.failed) for result in results if result.failed]
    return given


def main() -> None:
    """Print a table of the signs, then the figures."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--only", action="append", help="a gloss; may be given again")
    parser.add_argument("--all", action="store_true", help="every sign that has a score: an hour")
    parser.add_argument("--body", default="woman_average", help="who performs")
    parser.add_argument("--cache", type=Path, default=default_cache(), help="keeps recordings between runs")
    options = parser.parse_args()
    every = sorted(path.stem for path in default_scores_directory().glob("*.yaml"))
    glosses = options.only or (every if options.all else MANY)
    console = Console()
    results = []
    for gloss in progress(glosses, "signs", console=Console(stderr=True)):
        results += evaluate([gloss], options.cache, body=options.body)
    about = ", ".join(_PARTS)
    table = Table("sign", *_WAYS.values(), title=f"Median over the sign of {about}")
    for result in results:
        cells = (" ".join(f"{value:4.0f}" for value in getattr(result, way)) for way in _WAYS)
        table.add_row(result.gloss, *cells)
    console.print(table)
    for figure in figures(results):
        console.print(f"{figure.what}: {figure.value}", highlight=False, soft_wrap=True, markup=False)


if __name__ == "__main__":
    main()
