# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A recorded letter of a manual alphabet as a sign of a robot's right arm and hand."""

from __future__ import annotations

import datetime
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.transform import Rotation, Slerp

from teo_common.arrays import Array
from teo_description.hand_geometry import HandGeometry, HandTable, hand_table
from teo_description.robot import Robot
from teo_sign_authoring.alphabet.hand_fit import HandPose, SignerHand, fit_hand, measure_signer
from teo_sign_authoring.alphabet.letter_clips import (
    LICENCE,
    PACKAGE,
    LetterClip,
    Stroke,
    clips_version,
    find_stroke,
    load_letter_clips,
    palm_centres,
    reaches,
    tilts,
)
from teo_sign_authoring.alphabet.letter_movement import quick_movement
from teo_sign_authoring.alphabet.spelling_arm import (
    ArmFit,
    fit_arm,
    fit_arm_and_hand,
    follow_arm,
    is_at_its_place,
    shift_off_face,
)
from teo_sign_authoring.alphabet.spelling_hand import HandFit, HandProblem, fit_robot_hand
from teo_sign_capture.retarget.hand_motion import axis_shares
from teo_sign_capture.retarget.knots import clearance_mm, limit_margin_deg, reduce_to_knots
from teo_sign_capture.signing_space import find_place, finger_rows
from teo_sign_languages import Language, LetterClips
from teo_signs.errors import LutError
from teo_signs.sign import Sign
from teo_signs.sign_schema import Provenance

_FINGERS = ("index", "middle", "ring", "little")

# [rad] Knots follow the motion to this, 2 mm at the finger tips of a hand that turns at its wrist: what
# trembles is gone by then, and the hand's way is to lose no more.
_TOLERANCE = np.radians(0.5)
# [rad] A palm that is farther than this from the person's is worth giving up place and shape for.
_OUT_OF_REACH = np.radians(20.0)
# Each shift off the face moves the arm, and with it the hand a little back.
_FACE_TRIES = 4


@dataclass(frozen=True, kw_only=True)
class RecordedAlphabet:
    """What all letters of one signer share.

    Attributes:
        language: Whose letters they are.
        clips: The recordings, by letter.
        refused: Why other letters have none that can be used.
        signer: Size of the signer's hand.
        centre: Where the signer's palm is on average for the letters that the language names: left, up
            [pixel]. Shape (2,).
        place: Where the robot's palm is when it spells, in ``base_link`` [m]. Shape (3,).
        scale: Metres of the robot's for a pixel of the clips: its fingers over the signer's.
    """

    language: Language
    clips: Mapping[str, LetterClip]
    refused: Mapping[str, LutError]
    signer: SignerHand
    centre: Array
    place: Array
    scale: float


def read_alphabet(robot: Robot, language: Language) -> RecordedAlphabet:
    """Measure the signer of a language's letters and find the place where TEO spells.

    Raises:
        LutError: As `load_letter_clips` of all letters together; the reason of one if none can be used.
    """
    refused: dict[str, LutError] = {}
    clips = load_letter_clips(language, refused=refused.__setitem__)
    if not clips:
        raise next(iter(refused.values()))
    centres = []
    for letter in [letter for letter in _recordings(language).place if letter in clips] or clips:
        stroke = find_stroke(clips[letter])
        centres.append(np.median(palm_centres(clips[letter].hand)[stroke.first : stroke.last + 1], axis=0))
    signer = measure_signer(clip.hand for clip in clips.values())
    return RecordedAlphabet(
        language=language,
        clips=clips,
        refused=refused,
        signer=signer,
        centre=np.mean(centres, axis=0),
        place=find_place(robot.humanoid, "spelling").point,
        scale=HandGeometry(robot).finger_length / signer.finger_length,
    )


def _recordings(language: Language) -> LetterClips:
    recordings = language.alphabet.clips
    assert recordings is not None, "load_letter_clips has refused it"
    return recordings


def capture_letter(robot: Robot, alphabet: RecordedAlphabet, letter: str) -> Sign:
    """Make one letter a robot's.

    Raises:
        LutError: The reason in `RecordedAlphabet.refused`, of this letter or one that it is made after.
    """
    humanoid, clip = robot.humanoid, _clip(alphabet, letter)
    stroke = find_stroke(clip)
    poses = _held_poses(clip, stroke, alphabet.signer)
    first = _letter_in(_recordings(alphabet.language).begins_as, alphabet, letter)
    if first is not None:
        stroke = replace(stroke, holds=((stroke.first, stroke.first + 1), *stroke.holds), wagging=())
        poses = [first, *poses]
    places = _places(clip, alphabet, stroke)
    shared = _letter_in(_recordings(alphabet.language).same_palm, alphabet, letter)
    beside = _letter_in(_recordings(alphabet.language).same_thumb, alphabet, letter)
    shift = np.zeros(3)
    for _ in range(_FACE_TRIES):
        arms, hands = _retarget(robot, clip, stroke, poses, places + shift, shared)
        if beside is not None:
            hands = _with_thumb_of(robot, beside, poses, hands, arms[0].palm)
        hand_path = _hand_path(robot, clip, stroke, hands)
        for finger, bend in (
            alphabet.language.alphabet.flexions.get(humanoid.name, {}).get(letter, {}).items()
        ):
            hand_path[:, 2 + _FINGERS.index(finger)] = np.radians(bend)
        positions = np.hstack([np.array([arm.positions for arm in arms]), hand_path])
        more = shift_off_face(robot, positions)
        if not more.any():
            break
        shift = shift + more
    times = (stroke.frames - stroke.first) / clip.rate
    quick = quick_movement(robot, np.array([arm.positions for arm in arms]))
    positions = np.hstack([quick, hand_path])
    kept = reduce_to_knots(times, positions, _TOLERANCE)
    knots = positions[kept]
    return Sign(
        gloss=letter,
        language=alphabet.language.code,
        kind="letter",
        handedness="right",
        robot=humanoid.name,
        joints=humanoid.arm("right") + humanoid.hand("right"),
        times=np.round(times[kept], 6),
        knots=knots,
        provenance=_provenance(robot, alphabet.language, clip),
        quality=_quality(robot, knots, arms, hands, poses, stroke, places, alphabet.scale),
    )


def _clip(alphabet: RecordedAlphabet, letter: str) -> LetterClip:
    if letter in alphabet.refused:
        raise alphabet.refused[letter]
    return alphabet.clips[letter]


def letter_bends(alphabet: RecordedAlphabet, letter: str) -> Array:
    """How much the person's fingers are bent in all, in each hold of a letter [rad]. Shape (holds, 4)."""
    clip = _clip(alphabet, letter)
    poses = _held_poses(clip, find_stroke(clip), alphabet.signer)
    return np.array([pose.bends.sum(axis=1) for pose in poses])


def _held_poses(clip: LetterClip, stroke: Stroke, signer: SignerHand) -> list[HandPose]:
    """The hand of each hold."""
    poses = []
    for start, end in stroke.holds:
        hand = clip.hand[start : end + 1]
        poses.append(fit_hand(np.median(hand - hand.mean(axis=1, keepdims=True), axis=0), signer))
    return poses


def _letter_in(others: Mapping[str, str], alphabet: RecordedAlphabet, letter: str) -> HandPose | None:
    """The hand of the letter that stands for this one in a mapping; None if none does."""
    other = others.get(letter)
    if other is None:
        return None
    clip = _clip(alphabet, other)
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
    if not stroke.turns:
        first = _held_arm(robot, poses[0], shared, middle)
        hand = fit_robot_hand(robot, poses[0], first.palm)
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
    begin = fit_arm(robot, palms[0], places[0])
    arms = follow_arm(robot, palms, places, begin)
    if not is_at_its_place(arms):
        arms = follow_arm(robot, palms, places, begin, firm=True)
    hands = [
        fit_robot_hand(robot, pose, arms[(start + end) // 2 - stroke.first].palm)
        for pose, (start, end) in zip(poses, stroke.holds, strict=True)
    ]
    return arms, hands


def _with_thumb_of(
    robot: Robot, other: HandPose, poses: list[HandPose], hands: list[HandFit], palm: Array
) -> list[HandFit]:
    """Hands with the thumb that another letter's hand has."""
    thumb = fit_robot_hand(robot, other, other.rotation).positions[:2]
    return [
        HandProblem(robot, pose, palm).result(np.concatenate([thumb, hand.positions[2:]]))
        for pose, hand in zip(poses, hands, strict=True)
    ]


def _held_arm(robot: Robot, pose: HandPose, shared: HandPose | None, place: Array) -> ArmFit:
    """The arm that holds a hand still."""
    free = fit_arm(robot, pose.rotation, place)
    arm = free if is_at_its_place([free]) else fit_arm(robot, pose.rotation, place, firm=True)
    if free.angle_error <= _OUT_OF_REACH:
        return arm
    hanging = fit_arm_and_hand(robot, shared or pose, place, free)
    # A palm that looks up is out of reach too, and does not hang.
    return min(arm, hanging, key=lambda fit: fit.angle_error)


def _places(clip: LetterClip, alphabet: RecordedAlphabet, stroke: Stroke) -> Array:
    """Place of the palm wanted in each frame [m]. Shape (n, 3)."""
    centres = palm_centres(clip.hand)[stroke.frames]
    if not stroke.sways:
        centres[:] = np.median(centres, axis=0)
    places = np.repeat(alphabet.place[None], len(centres), axis=0)
    places[:, 1:] += alphabet.scale * (centres - alphabet.centre)
    return places


def _hand_path(robot: Robot, clip: LetterClip, stroke: Stroke, hands: list[HandFit]) -> Array:
    """Axes of the hand in each frame [rad]. Shape (n, axes)."""
    edges = [frame for hold in stroke.holds for frame in hold]
    held = np.array([hand.positions for hand in hands for _ in range(2)])
    path = np.column_stack([np.interp(stroke.frames, edges, held[:, axis]) for axis in range(held.shape[1])])
    reach = reaches(clip.hand)[stroke.frames]
    table = hand_table(robot)
    for row, finger in enumerate(finger_rows(table.hand)):
        if finger in stroke.wagging:
            # A finger that bends again and again: the share of its length that the viewer sees.
            path[:, 2 + row] = _flexion_for(reach[:, finger] / reach[:, finger].max(), table, row)
    return path


def _flexion_for(share: Array, table: HandTable, finger: int) -> Array:
    """Flexion at which a viewer before the palm sees a share of a finger's length [rad]."""
    limits, size = table.hand.limits, axis_shares(table)[finger]
    column = 2 + finger
    flexion = np.linspace(limits.lower[column], min(limits.upper[column], np.radians(60.0) * size), 60)
    seen = np.cos(np.outer(flexion / size, np.arange(1, 4))) @ table.hand.phalanges[finger]
    return np.interp(-share, -seen / seen[0], flexion)


def _provenance(robot: Robot, language: Language, clip: LetterClip) -> Provenance:
    collection = _recordings(language).collection
    return Provenance(
        standing="recorded",
        source=(
            f"{PACKAGE} {clips_version()} (PyPI), fingerspelling lexicon, collection {collection}, "
            f"{clip.file}"
        ),
        method=(
            "MediaPipe landmarks of one signer, depth rescaled; bones of constant length fitted; palm, "
            f"place, path and handshape retargeted to {robot.humanoid.name.upper()}'s right arm and hand "
            "(capture_letters)"
        ),
        recorded=None,
        created=datetime.date.today().isoformat(),
        licence=LICENCE,
        description_hash=robot.humanoid.description_hash,
        notes=language.alphabet.notes.get(robot.humanoid.name, {}).get(clip.letter, ""),
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
    joints = robot.humanoid.arm("right") + robot.humanoid.hand("right")
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
        "clearance_mm": clearance_mm(robot, joints, knots),
        "limit_margin_deg": limit_margin_deg(robot.humanoid, joints, knots),
    }
    if seen:
        figures["landmark_error_mm"] = 1000.0 * scale * max(seen)
    return {name: round(value, 1) + 0.0 for name, value in figures.items()}
