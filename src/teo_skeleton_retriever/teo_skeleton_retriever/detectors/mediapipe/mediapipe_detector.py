# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""MediaPipe Holistic: bodies, hands and faces of a few people, on the CPU, as OpenPose's keypoints.

Sources: MediaPipe's pose and face mesh numbering; ROS4HRI's table of the face
(`hri_face_detect/doc/mediapipe_face_mesh_2_ros4hri.md`), whose outer lip 55 to 59 runs the wrong way round
there and is put right here; the eyes, inner lip and jaw are those in common use, which lie on the annotated
contours.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.detectors.detector import ImageArray, check_image
from teo_skeleton_retriever.detectors.mediapipe.holistic_graph import HolisticGraph, HolisticLandmarks
from teo_skeleton_retriever.detectors.mediapipe.people_follower import PeopleFollower, PeopleGraph
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.layouts.layout import BODY_25, HAND_21
from teo_skeleton_retriever.layouts.person_2d import Person2D, midpoint

_NOTHING = np.zeros((0, 3))

# From the shoulders down left landmarks are odd, the right ones next to them. Small toes have no counterpart.
BODY_25_FROM_POSE: dict[str, int] = {"Nose": 0, "LEye": 2, "REye": 5, "LEar": 7, "REar": 8} | {
    f"{side}{joint}": left + (side == "R")
    for side in "LR"
    for joint, left in (
        *(("Shoulder", 11), ("Elbow", 13), ("Wrist", 15)),
        *(("Hip", 23), ("Knee", 25), ("Ankle", 27), ("Heel", 29), ("BigToe", 31)),
    )
}
# Keypoints that MediaPipe does not give: mean of two, with the lower confidence.
_BODY_25_FROM_PAIRS: dict[str, tuple[str, str]] = {
    "Neck": ("RShoulder", "LShoulder"),
    "MidHip": ("RHip", "LHip"),
}

# Face mesh landmark of each of the 70, part by part; the pupils need the irises.
FACE_70_FROM_MESH: dict[str, tuple[int, ...]] = {
    "Jaw": (127, 234, 93, 132, 58, 136, 150, 176, 152, 400, 379, 365, 288, 361, 323, 454, 356),
    "RBrow": (70, 63, 105, 66, 107),
    "LBrow": (336, 296, 334, 293, 300),
    "NoseBridge": (6, 197, 4, 1),
    "Nostrils": (242, 141, 94, 370, 462),
    "REye": (33, 160, 158, 133, 153, 144),
    "LEye": (362, 385, 387, 263, 373, 380),
    "OuterLip": (61, 40, 37, 0, 267, 270, 291, 321, 314, 17, 84, 91),
    "InnerLip": (78, 81, 13, 311, 308, 402, 14, 178),
    "RPupil": (468,),
    "LPupil": (473,),
}


def person_from_holistic(landmarks: HolisticLandmarks, *, width: int, height: int) -> Person2D:
    """Bring one person's landmarks into OpenPose's order and into pixels.

    Args:
        landmarks: Of the person. A hand that is the other one is left out.
        width: Of the image [px].
        height: Of the image [px].
    """
    size = np.array([width, height], dtype=np.float64)
    left, right = own_hands(landmarks)
    return without_doubles(
        Person2D(
            body=_body(landmarks.pose, size),
            # Depths are in the scale of x: they go the way of x.
            body_depth=None
            if landmarks.pose is None
            else _body(landmarks.pose[:, [2, 1, 2, 3, 4]], size)[:, 0],
            left_hand=_part(landmarks.left_hand if left else None, size, landmarks.left_hand_score),
            right_hand=_part(landmarks.right_hand if right else None, size, landmarks.right_hand_score),
            face=_face(landmarks.face, size, landmarks.face_score),
            left_hand_world=landmarks.left_hand_world if left else None,
            right_hand_world=landmarks.right_hand_world if right else None,
        )
    )


def _body(pose: FloatArray | None, size: FloatArray) -> FloatArray:
    if pose is None:
        return _NOTHING
    confident = np.column_stack([pose[:, :2], pose[:, 3:].min(axis=1)])  # in the image, and in view
    body = np.zeros((len(BODY_25), 3))
    for name, landmark in BODY_25_FROM_POSE.items():
        body[BODY_25.index[name]] = confident[landmark] * [*size, 1.0]
    for name, (first, second) in _BODY_25_FROM_PAIRS.items():
        body[BODY_25.index[name]] = midpoint(body[BODY_25.index[first]], body[BODY_25.index[second]])
    return body


def _part(landmarks: FloatArray | None, size: FloatArray, confidence: float) -> FloatArray:
    if landmarks is None:
        return _NOTHING
    return np.column_stack([landmarks[:, :2] * size, np.full(len(landmarks), confidence)])


def _face(mesh: FloatArray | None, size: FloatArray, confidence: float) -> FloatArray:
    if mesh is None:
        return _NOTHING
    chosen = np.array([i for part in FACE_70_FROM_MESH.values() for i in part])
    seen = chosen < len(mesh)
    face = np.zeros((len(chosen), 3))
    face[seen, :2] = mesh[chosen[seen], :2] * size
    face[seen, 2] = confidence
    return face


HAND_NETWORKS = ("full", "lite")
# Four already take a second for six images on two cores; who signs is among the four nearest.
MOST_PEOPLE = 4


class MediaPipeDetector:
    """Finds people, the nearest first, and follows them from image to image.

    On rendered people of 640 x 480 it needs the head in the image, from about 1 m on, and found body and both
    hands in the first image up to 5.5 m: no crop of small people is needed. A hand is lost while it points at
    the camera.

    `detect` may be called from two threads at once, each with an image of its own: both are worked on
    together, which on two cores gives 1.5 times the images per second. A jump in time or in place needs
    nothing: a person who is no longer where they were is looked for anew in the same image.

    Args:
        min_detection_confidence: Below which a first sight of a person does not count, in [0, 1]. MediaPipe's
            own default.
        min_tracking_confidence: Below which a followed person counts as lost, in [0, 1]. MediaPipe's own
            default.
        hands: Which network looks at hands, of `HAND_NETWORKS`.
        people: Most people who are followed at once; each takes as long as the first.

    Raises:
        RetrieverError: An option is outside its range.
    """

    name = "mediapipe"
    images_at_once = 2

    def __init__(
        self,
        *,
        min_detection_confidence: float = 0.5,
        min_tracking_confidence: float = 0.5,
        hands: str = "full",
        people: int = 4,
    ) -> None:
        if hands not in HAND_NETWORKS:
            raise RetrieverError("bad_option", f"hands: expected one of {HAND_NETWORKS}, got {hands!r}")
        if not (isinstance(people, int) and 1 <= people <= MOST_PEOPLE):
            raise RetrieverError("bad_option", f"people: expected 1 to {MOST_PEOPLE}, got {people!r}")
        self._make_graph = partial(
            HolisticGraph,
            min_tracking_confidence=_in_unit_range("min_tracking_confidence", min_tracking_confidence),
            lite_hands=hands == "lite",
        )
        self._make_finder = partial(
            PeopleGraph,
            min_detection_confidence=_in_unit_range("min_detection_confidence", min_detection_confidence),
        )
        self._people = people
        self._follower: PeopleFollower | None = self._make_follower()

    def detect(self, image: ImageArray, stamp: float) -> tuple[Person2D, ...]:
        """Find people; see `Detector.detect`.

        Body confidence is the lower of how likely a landmark is in the image and how likely it is in view; a
        hand and a face come whole, each with one confidence.
        """
        follower = self._follower
        if follower is None:
            raise RetrieverError("closed", "expected an open detector, got one that was closed")
        check_image(image, stamp)
        try:
            found = follower.follow(image)
        except RetrieverError:
            if self._follower is follower:  # a graph that failed once refuses everything after
                self._follower = self._make_follower()
            raise
        height, width = image.shape[:2]
        return tuple(person_from_holistic(landmarks, width=width, height=height) for landmarks in found)

    @property
    def people_left_out(self) -> int:
        """How many more are seen than `MOST_PEOPLE`, which are followed; who asks for fewer is not told."""
        follower = self._follower
        return follower.left_out if follower is not None else 0

    def close(self) -> None:
        """Stop, when the images at hand are done."""
        follower, self._follower = self._follower, None
        if follower is not None:
            follower.close()

    def _make_follower(self) -> PeopleFollower:
        counts_more = self._people == MOST_PEOPLE
        return PeopleFollower(self._make_graph, self._make_finder(), self._people, counts_more=counts_more)


def _in_unit_range(name: str, value: float) -> float:
    if not (isinstance(value, int | float) and math.isfinite(value) and 0.0 <= value <= 1.0):
        raise RetrieverError("bad_option", f"{name}: expected a number in [0, 1], got {value!r}")
    return float(value)


# Where arms cross, MediaPipe's crop of one hand may settle on the other one and follow it for a second, as
# sure as ever; its network also tells left hands from right ones, which gives this away. Below this a hand
# is the other one. Of 646 hands on rendered people 16 were the other hand, 15 of them below it, with 11 of
# the 630 others: fists, or hands seen from their edge, which were off by 33 mm instead of 9.
_LEAST_SIDE = 0.3


def own_hands(landmarks: HolisticLandmarks) -> tuple[bool, bool]:
    """Whether the left and the right hand are there and on the side they were taken for.

    A single hand always counts as such.
    """
    if landmarks.left_hand is None or landmarks.right_hand is None:
        return landmarks.left_hand is not None, landmarks.right_hand is not None
    return landmarks.left_hand_side >= _LEAST_SIDE, landmarks.right_hand_side >= _LEAST_SIDE


# Where hands come close, both crops may settle on the same hand: in a rendered take of two hands on each
# other, in 17 of 120 images. Mean distance of their keypoints, in mean distances from the hand's middle,
# below which two hands are one. Of one hand taken twice it was 0 to 0.2; of two hands that touch, 0.9.
_SAME_HAND = 0.35


def without_doubles(person: Person2D) -> Person2D:
    """Where both hands are the same one, remove that which is farther from its own arm's wrist."""
    left, right = person.left_hand, person.right_hand
    if not (len(left) and len(right) and len(person.body)) or _apart(left, right) > _SAME_HAND:
        return person
    if _off_arm(left, person, "LWrist") > _off_arm(right, person, "RWrist"):
        return replace(person, left_hand=_NOTHING, left_hand_world=None)
    return replace(person, right_hand=_NOTHING, right_hand_world=None)


def _apart(one: FloatArray, other: FloatArray) -> float:
    size = np.linalg.norm(one[:, :2] - one[:, :2].mean(axis=0), axis=1).mean()
    return float(np.linalg.norm(one[:, :2] - other[:, :2], axis=1).mean() / max(size, 1e-6))


def _off_arm(hand: FloatArray, person: Person2D, wrist: str) -> float:
    return float(np.linalg.norm(hand[HAND_21.index["Wrist"], :2] - person.body[BODY_25.index[wrist], :2]))
