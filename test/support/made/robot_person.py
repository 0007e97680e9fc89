# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""TEO as a person: keypoints at TEO's own joints, and people that are made of them."""

from __future__ import annotations

import numpy as np

from teo_names import LEFT_ARM, LEFT_HAND, RIGHT_ARM, RIGHT_HAND
from teo_sign_capture.retarget.hand_goals import HandGoals
from teo_sign_capture.tracks.skeleton_track import Keypoints, in_body_axes

FINGERS = ("Thumb", "Index", "Middle", "Ring", "Pinky")
# Face keypoints at the places that TEO has for them (`score.places`, moved onto the collision shape) [m].
FACE = {8: (0.1015, 0.0, 0.640), 51: (0.1015, 0.0, 0.672), 57: (0.1015, 0.0, 0.664)}
FACE |= {21: (0.1015, 0.02, 0.736), 22: (0.1015, -0.02, 0.736)}
NOSE, EYE, EAR = (0.1015, 0.0, 0.695), (0.1015, -0.034, 0.723), (0.0, -0.099, 0.710)
MIRROR = np.array([1.0, -1.0, 1.0])
# What the head turns about [m], and its keypoints among the body's: nose, eyes, ears.
NECK, HEAD_OF_BODY = np.array([0.0, 0.0, 0.63]), (0, 15, 16, 17, 18)


def part(positions):
    count = positions.shape[:2]
    lost = ~np.isfinite(positions).all(axis=2)
    return Keypoints(
        positions=positions,
        sigma=np.zeros(count),
        confidence=np.where(lost, 0.0, 1.0),
        status=np.where(lost, 0, 1).astype(np.uint8),
    )


def keypoints(robot, joints, motion):
    """Body, left hand, right hand and face of TEO [m] at each of its postures."""
    frames = {}
    for side in ("Right", "Left"):
        frames[side] = [f"Sagittal{side}Shoulder_link", f"Frontal{side}Elbow_link"]
        frames[side] += [f"{side.lower()}_sensor_plate"]
        frames[side] += [f"{side}ThumbFinger{end}" for end in ("_link", "Distal_link", "Tip")]
        frames[side] += [
            f"{side}{finger}Finger{end}"
            for finger in FINGERS[1:]
            for end in ("_link", "Middle_link", "Distal_link", "Tip")
        ]
    body, hands = np.full((len(motion), 25, 3), np.nan), {"Right": [], "Left": []}
    for frame, row in enumerate(motion):
        q = robot.configuration(dict(zip(joints, row.tolist(), strict=True)))
        for side, (shoulder, elbow, wrist) in {"Right": (2, 3, 4), "Left": (5, 6, 7)}.items():
            placed = robot.placements(q, frames[side])[:, :3, 3]
            body[frame, [shoulder, elbow, wrist]] = placed[:3]
            hand = np.empty((21, 3))
            hand[0], hand[1] = placed[2], (placed[2] + placed[3]) / 2.0
            hand[2:5], hand[5:] = placed[3:6], placed[6:]
            hands[side].append(hand)
    body[:, 1] = (body[:, 2] + body[:, 5]) / 2.0
    body[:, [8, 9, 12]] = (0.0, 0.0, 0.0), (0.0, -0.146, 0.0), (0.0, 0.146, 0.0)
    body[:, 0], body[:, 15], body[:, 17] = NOSE, EYE, EAR
    body[:, 16], body[:, 18] = EYE * MIRROR, EAR * MIRROR
    face = np.full((len(motion), 70, 3), np.nan)
    for row, place in FACE.items():
        face[:, row] = place
    return body, np.array(hands["Left"]), np.array(hands["Right"]), face


def turn_head(body, face, turns):
    """Turn the head about the neck from frame to frame, in place. Shape of the turns (T, 3, 3)."""
    for points, rows in ((body, HEAD_OF_BODY), (face, range(70))):
        points[:, rows] = np.einsum("tij,tkj->tki", turns, points[:, rows] - NECK) + NECK


def track_of(times, points, source="robot"):
    body, left, right, face = (part(np.asarray(positions)) for positions in points)
    return in_body_axes(
        times=times,
        body=body,
        left_hand=left,
        right_hand=right,
        face=face,
        source=source,
        recorded=None,
        up=(0.0, 0.0, 1.0),
    )


def mirrored_points(points):
    """The person in a mirror: left and right change places."""
    body, left, right, face = (np.asarray(positions) * MIRROR for positions in points)
    swapped = body.copy()
    for one, other in ((2, 5), (3, 6), (4, 7), (9, 12), (15, 16), (17, 18)):
        swapped[:, [one, other]] = body[:, [other, one]]
    face = face.copy()
    face[:, [21, 22]] = face[:, [22, 21]]
    return swapped, right, left, face


JOINTS = RIGHT_ARM + RIGHT_HAND + LEFT_ARM + LEFT_HAND


def goals_of(chain, arms, *, local=(0.0, 0.0, 0.0), shift=(0.0, 0.0, 0.0), contact=1.0, at_face=0.0):
    """What a hand wants that is, but for a shift [m], where an arm has it."""
    poses, local = chain.poses(arms), np.broadcast_to(local, (len(arms), 3))
    upper, fore = poses.origins[:, 3] - chain.shoulder, poses.origins[:, 5] - poses.origins[:, 3]
    return HandGoals(
        local=local,
        place=poses.points(local) + np.array(shift),
        contact=np.full(len(arms), contact),
        palm=poses.rotation[:, :, 2],
        fingers=poses.rotation[:, :, 0],
        upper_arm=upper / np.linalg.norm(upper, axis=1, keepdims=True),
        fore_arm=fore / np.linalg.norm(fore, axis=1, keepdims=True),
        at_face=np.full(len(arms), at_face),
    )


def bent_hand(fingers, length=0.09):
    """A right hand without its thumb, index to little finger bent so, joint by joint [deg]. (21, 3) [m]."""
    points = np.zeros((21, 3))
    for finger, joints in enumerate(fingers):
        knuckle = 5 + 4 * finger
        points[knuckle] = (0.09, -0.03 + 0.02 * finger, 0.0)
        total = np.cumsum(np.radians(joints))
        for bone, (share, angle) in enumerate(zip((0.5, 0.3, 0.2), total, strict=True)):
            way = length * share * np.array([np.cos(angle), 0.0, np.sin(angle)])
            points[knuckle + bone + 1] = points[knuckle + bone] + way
    return points
