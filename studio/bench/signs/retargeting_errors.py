# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""How far TEO is from a person, measured by the robot's own kinematics and the person's true keypoints."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from teo_common.arrays import Array
from teo_description.robot import Robot
from teo_sign_capture.retarget.body_map import body_boxes, on_skin
from teo_sign_capture.signing_space import MIRROR
from teo_sign_capture.tracks.skeleton_track import EAR, MID_HIP, NECK, NOSE, SkeletonTrack
from teo_skeleton_retriever.lifting.hand_axes import finger_bends, in_palm, palm_axes

_TIPS = (4, 8, 12, 16, 20)
_FINGERS = ("Index", "Middle", "Ring", "Pinky")
# [m] A tip whose keypoint is so near to a place of the face is at it.
_TOUCHES = 0.03
# [m] A wrist lower than this below the shoulders hangs: no sign.
_RAISED = -0.35
# So many of the landmarks, the first ones, are places of the face.
_OF_THE_FACE = 4
_STRAIGHT, _FOLDED = np.radians(15.0), np.radians(45.0)


class Errors(NamedTuple):
    """Of the frames in which the hand is raised; of contacts and pointing those in which there are any.

    Attributes:
        palm: Angle between the ways the palms face [deg].
        hand: Angle between the ways from wrist to knuckles [deg].
        pointing: Angle between the ways an index points that is straight beside folded fingers [deg].
        wrist: From what is nearest of face, ears, chest and belly to the wrist: difference of the person's
            way, scaled by the length of the arms, and TEO's [mm].
        contact: Where a finger tip is at a place of the face, the same difference of the ways from the place
            to the tip [mm].
        flexion: Mean over the fingers of the difference of bends, of one joint's share [deg].
        touching: Whether parts of TEO overlap.
    """

    palm: Array
    hand: Array
    pointing: Array
    wrist: Array
    contact: Array
    flexion: Array
    touching: Array


def errors(robot: Robot, track: SkeletonTrack, side: str, joints: tuple[str, ...], motion: Array) -> Errors:
    """Compare a motion of TEO's joints, shape (T, m) [rad], with a person's hand."""
    flip = np.ones(3) if side == "right" else MIRROR
    hand, body = track.hand(side).positions, track.body.positions
    axes, bends = palm_axes(hand * flip), finger_bends(in_palm(hand * flip))
    person, teo = _landmarks(robot, track)
    scale = _arm_of_teo(robot) / _arm_of(track, side)
    found: dict[str, list[float]] = {field: [] for field in Errors._fields}
    name = side.capitalize()
    frames = [f"{side}_palm", f"{side}_sensor_plate"]
    frames += [f"{name}{finger}Finger{end}" for finger in ("Thumb", *_FINGERS) for end in ("_link", "Tip")]
    for frame in np.flatnonzero(body[:, {"right": 4, "left": 7}[side], 2] > _RAISED).tolist():
        pose = dict(zip(joints, motion[frame].tolist(), strict=True))
        q = robot.configuration(pose)
        placed = robot.placements(q, frames)
        palm, plate, points = placed[0], placed[1, :3, 3], placed[2:, :3, 3].reshape(5, 2, 3)
        found["palm"].append(_angle(palm[:3, 2], axes[frame, :, 2] * flip))
        found["hand"].append(_angle(palm[:3, 0], axes[frame, :, 0] * flip))
        total = bends[frame].sum(axis=1) / 3.0
        flexions = np.array([pose[f"{name}{finger}Finger"] for finger in _FINGERS])
        found["flexion"].append(float(np.degrees(np.abs(total - flexions).mean())))
        if total[0] < _STRAIGHT and (total[1:] > _FOLDED).all():
            found["pointing"].append(_angle(points[1, 1] - points[1, 0], hand[frame, 8] - hand[frame, 5]))
        nearest = int(np.linalg.norm(person[frame] - hand[frame, 0], axis=1).argmin())
        way = scale * (hand[frame, 0] - person[frame, nearest])
        found["wrist"].append(1000.0 * float(np.linalg.norm(way - (plate - teo[nearest]))))
        away = np.linalg.norm(person[frame, None, :_OF_THE_FACE] - hand[frame, _TIPS, None], axis=2)
        tip, place = np.unravel_index(away.argmin(), away.shape)
        if away[tip, place] < _TOUCHES:
            way = scale * (hand[frame, _TIPS[tip]] - person[frame, place])
            found["contact"].append(1000.0 * float(np.linalg.norm(way - (points[tip, 1] - teo[place]))))
        found["touching"].append(robot.clearance(q).distance < 0.0)
    return Errors(*(np.asarray(values, dtype=np.float64) for values in found.values()))


def _landmarks(robot: Robot, track: SkeletonTrack) -> tuple[Array, Array]:
    """Places on the person, shape (T, k, 3), and on TEO, shape (k, 3); those of the face first [m]."""
    body, face = track.body.positions, track.face.positions
    person = [body[:, NOSE], face[:, 8], face[:, (51, 57)].mean(axis=1), face[:, (21, 22)].mean(axis=1)]
    person += [body[:, EAR["right"]], body[:, EAR["left"]]]
    person += [body[:, NECK], (body[:, NECK] + body[:, MID_HIP]) / 2.0]
    boxes = body_boxes(robot)
    names = ("nose", "chin", "mouth", "eye", "ear")
    nose, chin, mouth, eye, ear = (on_skin(robot.humanoid, boxes, name) for name in names)
    brow = eye * (1.0, 0.0, 1.0) + (0.0, 0.0, 0.01)
    shoulder = robot.placement(robot.configuration({}), "SagittalRightShoulder_link")[:3, 3]
    # The hips' axes are at the origin.
    teo = [nose, chin, mouth, brow, ear, ear * MIRROR, shoulder * (1.0, 0.0, 1.0), shoulder * (0.5, 0.0, 0.5)]
    return np.stack(person, axis=1), np.array(teo)


def _arm_of(track: SkeletonTrack, side: str) -> float:
    rows = {"right": (2, 3, 4), "left": (5, 6, 7)}[side]
    return float(
        np.median(np.linalg.norm(np.diff(track.body.positions[:, rows], axis=1), axis=2).sum(axis=1))
    )


def _arm_of_teo(robot: Robot) -> float:
    """From the shoulder to the plate that carries the hand [m]."""
    placed = robot.placements(robot.configuration({}), ["SagittalRightShoulder_link", "right_sensor_plate"])
    return float(np.linalg.norm(placed[0, :3, 3] - placed[1, :3, 3]))


def _angle(first: Array, second: Array) -> float:
    cosine = first @ second / (np.linalg.norm(first) * np.linalg.norm(second))
    return float(np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))))
