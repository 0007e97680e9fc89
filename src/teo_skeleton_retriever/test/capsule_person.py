# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A person made of capsules, with exact depth by ray casting: the truth that estimates are held against."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from teo_skeleton_retriever.camera.camera_model import CameraModel
from teo_skeleton_retriever.detectors.detector import DetectionFrame
from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_skeleton_retriever.layouts.person_2d import Person2D

CAMERA = CameraModel(width=320, height=240, fx=300.0, fy=300.0, cx=159.5, cy=119.5)
ROW = BODY_25.index
UPPER_ARM, FOREARM, SHOULDERS = 0.29, 0.25, 0.34  # [m]
FINGER_BASES = {
    1: (-0.025, 0.02),
    5: (-0.028, 0.09),
    9: (-0.006, 0.09),
    13: (0.014, 0.083),
    17: (0.032, 0.075),
}
PHALANGES = {1: (0.04, 0.032, 0.026), 5: (0.041, 0.025, 0.02), 9: (0.045, 0.028, 0.021)}
PHALANGES |= {13: (0.042, 0.027, 0.021), 17: (0.033, 0.02, 0.018)}


class Pose(NamedTuple):
    """Where joints are, in the camera's frame [m]."""

    body: np.ndarray  # (25, 3)
    left_hand: np.ndarray  # (21, 3)
    right_hand: np.ndarray  # (21, 3)


def pose(
    right_wrist: tuple[float, ...],
    left_wrist: tuple[float, ...],
    *,
    at: tuple[float, float, float] = (0.0, -0.25, 1.6),
    curl: float = 0.2,
    size: float = 1.0,
) -> Pose:
    """Pose the person who faces the camera: wrists relative to the middle of the shoulders [m], for size 1.

    Args:
        right_wrist: of the person, who sees it to their right, the camera to the left.
        left_wrist: likewise.
        at: middle of the shoulders [m].
        curl: bend of every finger joint [rad].
        size: of the person.
    """
    body = np.zeros((25, 3))
    places = {
        **{"Neck": (0, 0, 0), "MidHip": (0, 0.5, 0), "Nose": (0, -0.2, -0.1)},
        **{"RHip": (-0.1, 0.5, 0), "LHip": (0.1, 0.5, 0), "RKnee": (-0.1, 0.92, 0), "LKnee": (0.1, 0.92, 0)},
        **{"RAnkle": (-0.1, 1.34, 0), "LAnkle": (0.1, 1.34, 0)},
        **{"REye": (-0.03, -0.23, -0.08), "LEye": (0.03, -0.23, -0.08)},
        **{"REar": (-0.07, -0.22, 0), "LEar": (0.07, -0.22, 0)},
    }
    for name, place in places.items():
        body[ROW[name]] = place
    hands = []
    for side, sign, wrist in (("R", -1.0, right_wrist), ("L", 1.0, left_wrist)):
        shoulder = np.array([sign * SHOULDERS / 2, 0.0, 0.0])
        elbow, reached = _elbow(shoulder, np.array(wrist, float), pole=np.array([0.5 * sign, 1.0, 0.3]))
        for joint, place in (("Shoulder", shoulder), ("Elbow", elbow), ("Wrist", reached)):
            body[ROW[side + joint]] = place
        hands.append(_hand(reached, reached - elbow, sign, curl))
    right, left = hands
    return Pose(*(np.array(at) + size * points for points in (body, left, right)))


def _elbow(shoulder: np.ndarray, wrist: np.ndarray, pole: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    reach = wrist - shoulder
    distance = min(max(float(np.linalg.norm(reach)), 0.15), UPPER_ARM + FOREARM - 0.002)
    direction = reach / np.linalg.norm(reach)
    along = (UPPER_ARM**2 - FOREARM**2 + distance**2) / (2 * distance)
    out = pole - direction * (pole @ direction)
    out /= np.linalg.norm(out)
    return (
        shoulder + direction * along + out * math.sqrt(max(UPPER_ARM**2 - along**2, 0.0)),
        shoulder + direction * distance,
    )


def _hand(wrist: np.ndarray, forearm: np.ndarray, sign: float, curl: float) -> np.ndarray:
    """A hand that goes on where the forearm ends, its palm towards the camera as far as that allows."""
    along = forearm / np.linalg.norm(forearm)
    normal = np.array([0.0, 0.0, -1.0]) + along * along[2]
    if np.linalg.norm(normal) < 0.2:
        normal = np.array([0.0, 1.0, 0.0]) - along * along[1]
    normal /= np.linalg.norm(normal)
    across = np.cross(along, normal) * -sign
    points = np.zeros((21, 3))
    for base, (x, y) in FINGER_BASES.items():
        place = across * x + along * y
        points[base], angle = place, 0.0
        for k, length in enumerate(PHALANGES[base]):
            angle += curl
            place = place + length * (along * math.cos(angle) + normal * math.sin(angle))
            points[base + 1 + k] = place
    return wrist + points


def capsules(person: Pose) -> np.ndarray:
    """Ends and radius of each capsule [m]. Shape (n, 7)."""
    body, found = person.body, []

    def add(a: np.ndarray, b: np.ndarray, radius: float) -> None:
        found.append([*a, *b, radius])

    for x in (-0.4, -0.15, 0.15, 0.4):  # trunk, as deep as its radius
        shift = (body[ROW["LShoulder"]] - body[ROW["RShoulder"]]) * x
        add(body[ROW["Neck"]] + shift + [0, 0.06, 0.02], body[ROW["MidHip"]] + shift * 0.8, 0.085)
    head = (body[ROW["REar"]] + body[ROW["LEar"]]) / 2
    add(head, head, 0.09)
    add(head, body[ROW["Neck"]], 0.055)
    for side in ("R", "L"):
        add(body[ROW[f"{side}Shoulder"]], body[ROW[f"{side}Elbow"]], 0.042)
        add(body[ROW[f"{side}Elbow"]], body[ROW[f"{side}Wrist"]], 0.032)
        add(body[ROW[f"{side}Hip"]], body[ROW[f"{side}Knee"]], 0.07)
        add(body[ROW[f"{side}Knee"]], body[ROW[f"{side}Ankle"]], 0.05)
    for hand in (person.left_hand, person.right_hand):
        for base in FINGER_BASES:
            add(hand[0], hand[base], 0.013)
            for k in range(3):
                add(hand[base + k], hand[base + k + 1], 0.008)
    return np.array(found)


def render(shapes: np.ndarray, camera: CameraModel) -> np.ndarray:
    """Depth [m] before a wall, by ray casting (Quilez, "Intersectors"). Shape (height, width)."""
    depth = np.full((camera.height, camera.width), 3.0)
    last = [camera.width - 1, camera.height - 1]
    for shape in shapes:
        a, b, radius = shape[:3], shape[3:6], shape[6]
        nearest = min(a[2], b[2]) - radius
        if nearest <= 0.05:
            continue
        corners = camera.project(np.array([a, b]))
        margin = radius * max(camera.fx, camera.fy) / nearest * 1.3 + 2
        low = np.maximum(np.floor(corners.min(axis=0) - margin), 0).astype(int)
        high = np.minimum(np.ceil(corners.max(axis=0) + margin), last).astype(int)
        if (high <= low).any():
            continue
        grid = np.stack(np.meshgrid(np.arange(low[0], high[0] + 1), np.arange(low[1], high[1] + 1)), axis=-1)
        rays = camera.rays(grid.reshape(-1, 2).astype(float))
        hit = _cast(rays, a, b, radius).reshape(grid.shape[:2])
        window = depth[low[1] : high[1] + 1, low[0] : high[0] + 1]
        np.minimum(window, hit, out=window)
    return depth.astype(np.float32)


def _cast(rays: np.ndarray, a: np.ndarray, b: np.ndarray, radius: float) -> np.ndarray:
    """How many times each ray goes to the capsule; infinite if it misses."""
    axis, start = b - a, -a
    best = np.full(len(rays), np.inf)
    squared = float(axis @ axis)
    if squared > 1e-12:
        along, offset = rays @ axis / squared, float(start @ axis) / squared
        across, away = rays - along[:, None] * axis, start - offset * axis
        p, q, r = (across**2).sum(1), across @ away, float(away @ away) - radius**2
        inside = q * q - p * r
        with np.errstate(invalid="ignore", divide="ignore"):
            t = (-q - np.sqrt(inside)) / p
        on = (inside >= 0) & (t > 0) & (offset + t * along >= 0) & (offset + t * along <= 1)
        best[on] = t[on]
    for centre in (a, b):
        p, q, r = (rays**2).sum(1), -rays @ centre, float(centre @ centre) - radius**2
        inside = q * q - p * r
        with np.errstate(invalid="ignore"):
            t = (-q - np.sqrt(inside)) / p
        on = (inside >= 0) & (t > 0)
        best[on] = np.minimum(best[on], t[on])
    return best


def person_2d(
    person: Pose, camera: CameraModel = CAMERA, *, jitter: float = 0.0, seed: int = 0, imagined: bool = True
) -> Person2D:
    """The person as a detector sees them that errs by `jitter` [px], and imagines the hands' shape or not."""
    random = np.random.default_rng(seed)

    def seen(points: np.ndarray, absent: tuple[int, ...] = ()) -> np.ndarray:
        pixels = camera.project(points) + random.normal(0.0, 1.0, (len(points), 2)) * jitter
        found = np.column_stack([pixels, np.full(len(points), 0.9)])
        found[list(absent)] = 0.0
        return found

    return Person2D(
        body=seen(person.body, tuple(range(19, 25))),
        left_hand=seen(person.left_hand),
        right_hand=seen(person.right_hand),
        face=seen(face(person)),
        left_hand_world=imagined_shape(person.left_hand) if imagined else None,
        right_hand_world=imagined_shape(person.right_hand) if imagined else None,
    )


def imagined_shape(hand: np.ndarray) -> np.ndarray:
    """A hand as a detector imagines it that sees it cut out, as if it looked straight at it [m]."""
    middle = hand.mean(axis=0)
    turned, _ = Rotation.align_vectors([[0, 0, 1]], [middle / np.linalg.norm(middle)])
    shape: np.ndarray = turned.apply(hand - middle)
    return shape


def face(person: Pose) -> np.ndarray:
    """70 points on the front of the head, a ball of 9 cm [m]. Shape (70, 3)."""
    centre = (person.body[ROW["REar"]] + person.body[ROW["LEar"]]) / 2
    angles = np.arange(70) * math.pi * (3 - math.sqrt(5))  # sunflower
    radius = 0.06 * np.sqrt((np.arange(70) + 0.5) / 70)
    x, y = radius * np.cos(angles), radius * np.sin(angles)
    return centre + np.column_stack([x, y, -np.sqrt(0.09**2 - x**2 - y**2)])


def frame(
    stamp: float,
    *people: Pose,
    noise: float = 0.0,
    missing: float = 0.0,
    jitter: float = 0.0,
    imagined: bool = True,
    camera: CameraModel = CAMERA,
) -> DetectionFrame:
    """A frame with depth noise [m], a share of depth missing and detections that err by `jitter` [px]."""
    shapes = np.concatenate([capsules(person) for person in people]) if people else np.zeros((0, 7))
    depth = render(shapes, camera)
    seed = int(abs(stamp) * 1e4)
    random = np.random.default_rng(seed)
    if noise:
        depth += random.normal(0, noise, depth.shape).astype(np.float32)
    if missing:
        depth[random.random(depth.shape) < missing] = math.nan
    seen = [
        person_2d(p, camera, jitter=jitter, seed=seed + i, imagined=imagined) for i, p in enumerate(people)
    ]
    return DetectionFrame(stamp, tuple(seen), depth, camera)
