# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A recorded letter of the manual alphabet as a sign of TEO's right arm and hand."""

from __future__ import annotations

import datetime
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation, Slerp

from teo_common.arrays import Array
from teo_description import RIGHT_ARM, RIGHT_HAND, description_hash, joint_limits
from teo_description.hand_geometry import FINGER_LENGTH, PHALANGES
from teo_description.robot import Robot
from teo_sign_capture.alphabet.demonstration import SPELLING_POSES
from teo_sign_capture.alphabet.face_visibility import shift_off_face
from teo_sign_capture.alphabet.spelling_arm import PALM_FRAME, ArmFit, fit_arm, follow_arm
from teo_sign_capture.alphabet.spelling_arm_and_hand import fit_arm_and_hand
from teo_sign_capture.alphabet.spelling_hand import HandFit, fit_dextra
from teo_sign_capture.alphabet.stroke import Stroke, find_stroke, palm_centres, reaches, tilts
from teo_sign_capture.recordings.letter_clips import LICENCE, PACKAGE, LetterClip, clips_version
from teo_sign_capture.retarget.knot_reduction import reduce_to_knots
from teo_sign_capture.retarget.quality_figures import clearance_mm, limit_margin_deg
from teo_sign_capture.tracks.hand_model import HandPose, SignerHand, fit_hand, measure_signer
from teo_signs.sign import Sign
from teo_signs.sign_schema import Provenance

JOINTS = RIGHT_ARM + RIGHT_HAND

# [rad] Knots follow the recorded motion to this, 7 mm at the finger tips of a hand that turns at its wrist:
# the slight swings in which a movement dies away would cost TEO, at 50 deg/s, more time than the movement.
_TOLERANCE = np.radians(2.0)
# [rad] A palm that is farther than this from the person's is worth giving up place and shape for.
_OUT_OF_REACH = np.radians(20.0)
# N and Ñ are M with a finger less. Their clips differ by 15 deg in the palm, which would lead to other arms.
_SAME_ARM = {"N": "M", "Ñ": "M"}
# Each shift off the face moves the arm, and with it the hand a little back.
_FACE_TRIES = 4

_HANGING = (
    "TEO's wrist cannot bend the hand down: it hangs before the right breast instead of beside the face, its "
    "palm half as far down as the signer's."
)
_MOVES_ONLY = "Differs from {} by its movement from side to side only."
_FIST = "TEO's thumb cannot lie over the fist: it stands beside it, along the index."

# What must be said about single letters beside the numbers.
_NOTES: dict[str, str] = {
    "D": "The thumb meets middle and ring finger; the little finger stays a finger's width away.",
    "E": "A half-closed hand: the knuckles of TEO's fingers cannot stay straight under a claw.",
    "F": "The thumb stays beside the bent index, a finger's width away, instead of crossing it.",
    "G": "Moves from side to side, as recorded.",
    "H": "Two holds, beside the face and before the body, as recorded; the second is seen badly: doubtful.",
    "I": _FIST,
    "J": _FIST,
    "LL": _MOVES_ONLY.format("L"),
    "M": _HANGING,
    "N": f"{_HANGING} Arm as for M.",
    "Ñ": f"{_MOVES_ONLY.format('N')} {_HANGING} Arm as for M.",
    "Q": (
        "The recording's tracker of the hand lost it in 15 of 25 frames, while that of the body saw the arm "
        "stay: shape and palm are those seen before and after. A movement in between would not be seen. The "
        "thumb stays off the fingers."
    ),
    "R": "TEO's fingers cannot cross: index and middle stand side by side, closed, where U's part.",
    "RR": f"{_MOVES_ONLY.format('R')} Index and middle side by side instead of crossed.",
    "U": "TEO's fingers cannot spread: the index bends forwards a little, parting them from the front.",
    "V": f"{_MOVES_ONLY.format('U')} Spread as in U.",
    "W": "Moves from side to side. Spread shown by bending the index a little.",
    "X": "Hooked index; then the hand turns and draws back, as recorded; the index is seen badly then.",
    "Y": f"The little finger bends again and again. {_FIST}",
    "Z": f"The little finger draws the letter. {_FIST}",
}


@dataclass(frozen=True, kw_only=True)
class Alphabet:
    """What all letters of one signer share.

    Attributes:
        clips: The recordings, by letter.
        signer: Size of the signer's hand.
        centre: Where the signer's palm is on average for T, E and O: left, up [pixel]. Shape (2,).
        place: Where TEO's palm is on average in its own T, E and O, in ``base_link`` [m]. Shape (3,).
    """

    clips: Mapping[str, LetterClip]
    signer: SignerHand
    centre: Array
    place: Array

    @property
    def scale(self) -> float:
        """Metres of TEO's for a pixel of the clips: TEO's fingers over the signer's."""
        return FINGER_LENGTH / self.signer.finger_length


def read_alphabet(robot: Robot, clips: Mapping[str, LetterClip]) -> Alphabet:
    """Measure the signer and find the place where TEO spells."""
    centres = []
    for letter in SPELLING_POSES:
        stroke = find_stroke(clips[letter])
        centres.append(np.median(palm_centres(clips[letter].hand)[stroke.first : stroke.last + 1], axis=0))
    places = []
    for pose in SPELLING_POSES.values():
        q = robot.configuration(dict(zip(RIGHT_ARM, np.radians(pose), strict=True)))
        places.append(robot.placement(q, PALM_FRAME)[:3, 3])
    return Alphabet(
        clips=clips,
        signer=measure_signer(clip.hand for clip in clips.values()),
        centre=np.mean(centres, axis=0),
        place=np.mean(places, axis=0),
    )


def capture_letter(robot: Robot, alphabet: Alphabet, letter: str) -> Sign:
    """Make one letter TEO's.

    Args:
        robot: The robot.
        alphabet: The clips and what they share.
        letter: Which of them.
    """
    clip = alphabet.clips[letter]
    stroke = find_stroke(clip)
    poses = _held_poses(clip, stroke, alphabet.signer)
    places = _places(clip, alphabet, stroke)
    shared = _shared_pose(alphabet, letter)
    shift = np.zeros(3)
    for _ in range(_FACE_TRIES):
        arms, hands = _retarget(robot, clip, stroke, poses, places + shift, shared)
        hand_path = _hand_path(clip, stroke, hands)
        positions = np.hstack([np.array([arm.positions for arm in arms]), hand_path])
        more = shift_off_face(robot, positions)
        if not more.any():
            break
        shift = shift + more
    times = (stroke.frames - stroke.first) / clip.rate
    kept = reduce_to_knots(times, positions, _TOLERANCE)
    knots = positions[kept]
    return Sign(
        gloss=letter,
        language="lse",
        kind="letter",
        handedness="right",
        joints=JOINTS,
        times=np.round(times[kept], 6),
        knots=knots,
        provenance=_provenance(clip, letter),
        quality=_quality(robot, knots, arms, hands, poses, stroke, places, alphabet.scale),
    )


def _held_poses(clip: LetterClip, stroke: Stroke, signer: SignerHand) -> list[HandPose]:
    """The hand of each hold."""
    poses = []
    for start, end in stroke.holds:
        hand = clip.hand[start : end + 1]
        poses.append(fit_hand(np.median(hand - hand.mean(axis=1, keepdims=True), axis=0), signer))
    return poses


def _shared_pose(alphabet: Alphabet, letter: str) -> HandPose | None:
    """The hand of the letter whose arm this one takes over where its own palm is out of reach."""
    other = _SAME_ARM.get(letter)
    if other is None:
        return None
    clip = alphabet.clips[other]
    return _held_poses(clip, find_stroke(clip), alphabet.signer)[0]


def _retarget(
    robot: Robot,
    clip: LetterClip,
    stroke: Stroke,
    poses: list[HandPose],
    places: Array,
    shared: HandPose | None,
) -> tuple[list[ArmFit], list[HandFit]]:
    """Arm in each frame, hand in each hold."""
    frames = stroke.frames
    middle = np.median(places, axis=0)
    first = fit_arm(robot, poses[0].rotation, middle)
    if not stroke.turns:
        if first.angle_error > _OUT_OF_REACH:
            first = fit_arm_and_hand(robot, shared or poses[0], middle)
        hand = fit_dextra(robot, poses[0], first.palm)
        if not stroke.sways:
            return [first] * len(frames), [hand]
        # The palm keeps its orientation and rocks as the viewer sees it: the angle across the view is the
        # sure one.
        tilt = tilts(clip.hand)[frames]
        rocking = Rotation.from_rotvec(np.outer(tilt - np.median(tilt), [1.0, 0.0, 0.0])).as_matrix()
        # About what can be reached, so that the movement is whole where the pose is not.
        arms = follow_arm(robot, rocking @ first.palm, first.place + places - middle, first)
        return arms, [hand]
    edges = [frame for hold in stroke.holds for frame in hold]
    held = Rotation.from_matrix(np.array([pose.rotation for pose in poses for _ in range(2)]))
    palms = Slerp(edges, held)(np.clip(frames, edges[0], edges[-1])).as_matrix()
    arms = follow_arm(robot, palms, places, fit_arm(robot, palms[0], places[0]))
    hands = [
        fit_dextra(robot, pose, arms[(start + end) // 2 - stroke.first].palm)
        for pose, (start, end) in zip(poses, stroke.holds, strict=True)
    ]
    return arms, hands


def _places(clip: LetterClip, alphabet: Alphabet, stroke: Stroke) -> Array:
    """Place of the palm wanted in each frame [m]. Shape (n, 3)."""
    centres = palm_centres(clip.hand)[stroke.frames]
    if not stroke.sways:
        centres[:] = np.median(centres, axis=0)
    places = np.repeat(alphabet.place[None], len(centres), axis=0)
    places[:, 1:] += alphabet.scale * (centres - alphabet.centre)
    return places


def _hand_path(clip: LetterClip, stroke: Stroke, hands: list[HandFit]) -> Array:
    """Axes of the hand in each frame [rad]. Shape (n, 6)."""
    edges = [frame for hold in stroke.holds for frame in hold]
    held = np.array([hand.positions for hand in hands for _ in range(2)])
    path = np.column_stack([np.interp(stroke.frames, edges, held[:, axis]) for axis in range(held.shape[1])])
    reach = reaches(clip.hand)[stroke.frames]
    for finger in stroke.wagging:
        # A finger that bends again and again: the share of its length that the viewer sees.
        path[:, 2 + finger] = _flexion_for(reach[:, finger] / reach[:, finger].max(), RIGHT_HAND[2 + finger])
    return path


def _flexion_for(share: Array, joint: str) -> Array:
    """Flexion at which a viewer before the palm sees a share of a finger's length [rad]."""
    limits = joint_limits((joint,))
    flexion = np.linspace(limits.lower[0], min(limits.upper[0], np.radians(60.0)), 60)
    seen = np.cos(np.outer(flexion, np.arange(1, 4))) @ PHALANGES
    return np.interp(-share, -seen / seen[0], flexion)


def _provenance(clip: LetterClip, letter: str) -> Provenance:
    return Provenance(
        standing="recorded",
        source=f"{PACKAGE} {clips_version()} (PyPI), fingerspelling lexicon, collection ssp, {clip.file}",
        method=(
            "MediaPipe landmarks of one signer, depth rescaled; bones of constant length fitted; palm, "
            "place, path and handshape retargeted to TEO's right arm and hand (capture_letters)"
        ),
        recorded=None,
        created=datetime.date.today().isoformat(),
        licence=LICENCE,
        description_hash=description_hash(),
        notes=_NOTES.get(letter, ""),
    )


def _quality(
    robot: Robot,
    knots: Array,
    arms: list[ArmFit],
    hands: list[HandFit],
    poses: list[HandPose],
    stroke: Stroke,
    places: Array,
    scale: float,
) -> dict[str, float]:
    """Against the person's hand: worst of the letter's holds."""
    held = [arms[(start + end) // 2 - stroke.first] for start, end in stroke.holds]
    turned = [
        Rotation.from_matrix(pose.rotation.T @ arm.palm).magnitude()
        for pose, arm in zip(poses, held, strict=True)
    ]
    reached = np.array([arm.place for arm in arms])
    away = np.linalg.norm(reached - places, axis=1)
    path = np.linalg.norm(reached - reached.mean(axis=0) - (places - places.mean(axis=0)), axis=1)
    seen = [pose.residual for pose in poses if np.isfinite(pose.residual)]
    figures = {
        "palm_angle_error_deg": float(np.degrees(max(turned))),
        "place_error_mm": 1000.0 * float(np.median(away)),
        "path_error_mm": 1000.0 * float(path.max()),
        "fingertip_error_mm": 1000.0 * max(fit.fingertip_error for fit in hands),
        "thumb_error_mm": 1000.0 * max(fit.thumb_error for fit in hands),
        "thumb_clearance_mm": 1000.0 * min(fit.clearance for fit in hands),
        "clearance_mm": clearance_mm(robot, JOINTS, knots),
        "limit_margin_deg": limit_margin_deg(JOINTS, knots),
    }
    if seen:
        figures["landmark_error_mm"] = 1000.0 * scale * max(seen)
    return {name: round(value, 1) + 0.0 for name, value in figures.items()}
