# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`.pose` files: a person's points in the picture over time, read and written.

The format is pose-format's (Moryossef, Müller, Fahrni: "pose-format: Library for Viewing, Augmenting, and
Handling .pose Files", 2023), the usual one in sign language research. Points are found by the names in a
file's header, so that files with a part of the points are read as well. Known are the layouts that
pose-format itself makes: MediaPipe Holistic's (whole, or without legs, fingers of the body or faces) and
OpenPose's BODY_25 with hands. MediaPipe's POSE_WORLD_LANDMARKS are passed over: pose-format multiplies their
metres with the size of the image, each axis with another figure.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from teo_common.arrays import Array
from teo_sign_capture.tracks.skeleton_track import BODY, EAR, EYE, HAND, HIP, SHOULDER
from teo_signs.errors import LutError
from teo_skeleton_retriever.layouts.layout import BODY_25
from teo_skeleton_retriever.lifting.clip import Points, PoseClip

# MediaPipe's name of points of BODY_25; the neck and the middle of the hips are means of two, legs are left
# out.
_MEDIAPIPE_BODY = {
    0: "NOSE",
    2: "RIGHT_SHOULDER",
    3: "RIGHT_ELBOW",
    4: "RIGHT_WRIST",
    5: "LEFT_SHOULDER",
    6: "LEFT_ELBOW",
    7: "LEFT_WRIST",
    9: "RIGHT_HIP",
    12: "LEFT_HIP",
    15: "RIGHT_EYE",
    16: "LEFT_EYE",
    17: "RIGHT_EAR",
    18: "LEFT_EAR",
}

_MEDIAPIPE_HAND = (
    "WRIST",
    *(f"THUMB_{joint}" for joint in ("CMC", "MCP", "IP", "TIP")),
    *(
        f"{finger}_FINGER_{joint}"
        for finger in ("INDEX", "MIDDLE", "RING")
        for joint in ("MCP", "PIP", "DIP", "TIP")
    ),
    *(f"PINKY_{joint}" for joint in ("MCP", "PIP", "DIP", "TIP")),
)

# As pose-format names them, from the wrist out.
_OPENPOSE_HAND = (
    "BASE",
    *(f"T_{joint}" for joint in ("STT", "BCMC", "MCP", "IP")),
    *(f"{finger}_{joint}" for finger in "IMRP" for joint in ("CMC", "MCP", "PIP", "DIP")),
)


@dataclass(frozen=True, kw_only=True)
class _Layout:
    """Names of a kind of file.

    Attributes:
        name: For people.
        body: Component of the body.
        left_hand: Component of the person's own left hand.
        right_hand: Likewise.
        body_points: Name of points of BODY_25, by its number.
        hand_points: Names of a hand's 21, in order.
    """

    name: str
    body: str
    left_hand: str
    right_hand: str
    body_points: Mapping[int, str]
    hand_points: Sequence[str]


_MEDIAPIPE = _Layout(
    name="MediaPipe Holistic",
    body="POSE_LANDMARKS",
    left_hand="LEFT_HAND_LANDMARKS",
    right_hand="RIGHT_HAND_LANDMARKS",
    body_points=_MEDIAPIPE_BODY,
    hand_points=_MEDIAPIPE_HAND,
)
_OPENPOSE = _Layout(
    name="OpenPose",
    body="pose_keypoints_2d",
    left_hand="hand_left_keypoints_2d",
    right_hand="hand_right_keypoints_2d",
    body_points={row: BODY_25.keypoints[row] for row in _MEDIAPIPE_BODY},
    hand_points=_OPENPOSE_HAND,
)
# The layouts that are read.
_LAYOUTS = (_MEDIAPIPE, _OPENPOSE)


# Several times what `MAX_FRAMES` of MediaPipe's 586 points need; more is not read to find that out.
MAX_FILE_BYTES = 256 * 1024**2

# Four minutes at 25 frames a second, which take half a GB and half a minute to lift.
MAX_FRAMES = 6000

# [Hz] No camera that films signers is faster.
_MAX_RATE = 1000.0

# A person of whom fewer points are ever seen is an empty place in the file.
_PERSON_POINTS = 3

# Points given as fractions of a picture's size stay this near its middle, some way outside included...
_FRACTION_LIMIT = 1.5
# ...but for one in a hundred.
_MOST = 0.99
# Shoulders of a clip that is scaled to them are nearer to 0 than this: in a picture that is a corner.
_CENTRED = 0.1
# Size of a hand over that of the trunk (the breadth of the shoulders, or their distance from the hips): 0.6,
# and double that half-way to the camera. Random points reach 2 and more.
_LARGEST_HAND = 1.5


def read_pose_file(path: Path, *, person: int | None = None) -> PoseClip:
    """Read a clip.

    Args:
        path: The file.
        person: Which person, from 0, where the file has several.

    Raises:
        LutError: "unreadable", "empty_file", "too_large"; "bad_pose_file" for a file that is damaged or no
            such file; "unknown_layout"; "bad_rate"; "too_short" for fewer than two frames; "too_long";
            "non_finite"; "several_people" where `person` is needed, "no_person" where there is none of that
            number; "no_torso" or "no_hand" if the shoulders or the hands are never seen; "no_body" of points
            that are no person's; "seen_from_behind".
    """
    return _Reader(path.name).read(_content(path), person)


def _content(path: Path) -> bytes:
    try:
        with path.open("rb") as file:
            content = file.read(MAX_FILE_BYTES + 1)
    except OSError as error:
        reason = error.strerror or str(error)
        raise LutError("unreadable", f"{path.name}: expected a file to read, got: {reason}") from error
    if not content:
        raise LutError("empty_file", f"{path.name}: expected a .pose file, got an empty one")
    if len(content) > MAX_FILE_BYTES:
        raise LutError(
            "too_large",
            f"{path.name}: expected at most {MAX_FILE_BYTES // 1024**2} MiB, got more: "
            "cut the film into signs before its points are found",
        )
    return content


class _Reader:
    """Reads one file; every refusal names it."""

    def __init__(self, name: str) -> None:
        self._name = name

    def read(self, content: bytes, person: int | None) -> PoseClip:
        pose = self._parse(content)
        layout = self._layout(pose.header)
        with np.errstate(invalid="ignore"):  # signalling NaN of a damaged file
            data = np.asarray(np.ma.getdata(pose.body.data), dtype=np.float64)
        confidence = np.array(pose.body.confidence, dtype=np.float64)
        rate = self._rate(float(pose.body.fps))
        if len(data) < 2:
            self._refuse("too_short", "two frames or more", f"{len(data)}: a sign is a motion")
        if len(data) > MAX_FRAMES:
            self._refuse(
                "too_long", f"at most {MAX_FRAMES} frames", f"{len(data)}: cut the film into signs first"
            )
        chosen = self._person(confidence, person)
        data, confidence = data[:, chosen], confidence[:, chosen]
        # Detectors that give no confidence below 0 or above 1 by a rounding are taken at their word.
        confidence = np.clip(np.where(np.isfinite(confidence), confidence, 0.0), 0.0, 1.0)
        confidence[np.ma.getmaskarray(pose.body.data)[:, chosen].any(axis=-1)] = 0.0
        self._check_finite(data, confidence)
        parts = self._parts(pose.header, layout, data, confidence)
        self._check_seen(parts)
        size = (pose.header.dimensions.width, pose.header.dimensions.height)
        in_picture = _is_in_picture(parts["body"].places)
        if in_picture and _is_fractions(parts["body"].places, size):
            parts = {name: _scaled(points, [1.0, *size]) for name, points in parts.items()}
        if in_picture and layout is _MEDIAPIPE:
            # MediaPipe's depths of a body are shares of the picture's width; pose-format leaves them so.
            parts["body"] = _scaled(parts["body"], [size[0], 1.0, 1.0])
        return PoseClip(rate=rate, **parts, source=self._name)

    def _refuse(self, code: str, expected: str, got: str) -> NoReturn:
        raise LutError(code, f"{self._name}: expected {expected}, got {got}")

    def _parse(self, content: bytes) -> Any:
        from pose_format import Pose  # heavy, and needed by nothing but this

        try:
            pose = Pose.read(content)
            header = BytesIO()
            pose.header.write(header)
            # Read short, a file of the older version would give fewer frames and wrong ones.
            version = round(float(pose.header.version), 3)
            rest = {0.1: 6, 0.2: 10}.get(version)
            expected = header.tell() + (rest or 0) + 4 * (pose.body.data.size + pose.body.confidence.size)
        except Exception as error:  # whatever a damaged file makes of pose-format
            reason = f"{type(error).__name__}: {error}"
            self._refuse("bad_pose_file", "a whole .pose file", f"one that cannot be read ({reason})")
        if rest is not None and len(content) != expected:
            self._refuse("bad_pose_file", f"a .pose file of {expected} bytes", f"{len(content)} bytes")
        return pose

    def _layout(self, header: Any) -> _Layout:
        found = [component.name for component in header.components]
        fitting = [layout for layout in _LAYOUTS if layout.body in found]
        if not fitting:
            known = ", ".join(f"{layout.name} ({layout.body})" for layout in _LAYOUTS)
            self._refuse("unknown_layout", f"points of {known}", f"components {', '.join(found) or 'none'}")
        return fitting[0]

    def _rate(self, rate: float) -> float:
        if not (math.isfinite(rate) and 0.0 < rate <= _MAX_RATE):
            self._refuse("bad_rate", f"more than 0 and at most {_MAX_RATE:g} frames a second", f"{rate:g}")
        return rate

    def _person(self, confidence: Array, person: int | None) -> int:
        people = np.flatnonzero((confidence > 0.0).any(axis=0).sum(axis=-1) >= _PERSON_POINTS)
        numbers = ", ".join(map(str, people.tolist())) or "none"
        if person is not None:
            if person not in people:
                self._refuse("no_person", f"one of the people {numbers}", f"person {person}")
            return person
        if not people.size:
            self._refuse("no_person", "a person in the clip", "none in any frame")
        if people.size > 1:
            self._refuse("several_people", "one person, or a choice with --person", f"the people {numbers}")
        return int(people[0])

    def _check_finite(self, data: Array, confidence: Array) -> None:
        bad = np.argwhere(~np.isfinite(data).all(axis=-1) & (confidence > 0.0))
        if bad.size:
            frame, point = bad[0].tolist()
            self._refuse(
                "non_finite", "finite numbers for all points seen", f"none for point {point} in frame {frame}"
            )

    def _parts(self, header: Any, layout: _Layout, data: Array, confidence: Array) -> dict[str, Points]:
        starts = np.cumsum([0, *(len(component.points) for component in header.components)])
        columns = {
            component.name: {name: int(start) + index for index, name in enumerate(component.points)}
            for component, start in zip(header.components, starts, strict=False)
        }
        body = {at: columns[layout.body].get(name) for at, name in layout.body_points.items()}
        parts = {"body": _points(data, confidence, body, BODY)}
        for side, component in (("left_hand", layout.left_hand), ("right_hand", layout.right_hand)):
            names = columns.get(component, {})
            missing = [name for name in layout.hand_points if name not in names] if names else []
            if missing:
                self._refuse(
                    "unknown_layout",
                    f"{component} with all of a hand's 21 points",
                    f"one without {', '.join(missing)}",
                )
            hand = {at: names.get(name) for at, name in enumerate(layout.hand_points)}
            parts[side] = _points(data, confidence, hand, HAND)
        return parts

    def _check_seen(self, parts: dict[str, Points]) -> None:
        body = parts["body"]
        shoulders = body.seen[:, [SHOULDER["left"], SHOULDER["right"]]].all(axis=1)
        if not shoulders.any():
            self._refuse("no_torso", "a person whose shoulders are seen", "both shoulders in no frame")
        if not any(parts[side].seen.all(axis=1).any() for side in ("left_hand", "right_hand")):
            self._refuse("no_hand", "a hand with all its points in some frame", "none in any")
        share = max(_hand_over_trunk(body, parts[side]) for side in ("left_hand", "right_hand"))
        if share > _LARGEST_HAND:
            self._refuse(
                "no_body",
                "hands that are smaller than the trunk",
                f"hands {share:.1f} times as large: are these a person's points, in the layout that the file "
                "names?",
            )
        if _is_reversed(body):
            self._refuse(
                "seen_from_behind",
                "shoulders, hips, eyes and ears of which the left one is on the right of the picture",
                "most of them the other way round: the person is seen from behind, or the clip was mirrored "
                "after its points were found",
            )


def _hand_over_trunk(body: Points, hand: Points) -> float:
    """Size of a hand over that of the trunk, in the picture, medians of the frames; 0 if never seen."""
    whole = hand.places[hand.seen.all(axis=1), :, 1:]
    shoulders, hips = (body.places[:, list(pair.values()), 1:] for pair in (SHOULDER, HIP))
    ways = (shoulders[:, 0] - shoulders[:, 1], shoulders.mean(axis=1) - hips.mean(axis=1))
    lengths = [np.linalg.norm(way[np.isfinite(way).all(axis=1)], axis=1) for way in ways]
    trunk = max(float(np.median(length)) for length in lengths if length.size)
    return (
        float(np.median(np.linalg.norm(np.ptp(whole, axis=1), axis=1))) / trunk
        if len(whole) and trunk
        else 0.0
    )


def _is_reversed(body: Points) -> bool:
    """Whether most pairs of the body have their left point on the left of the picture.

    Shoulders alone do not tell: those of somebody who stands sideways pass each other, and a detector takes
    one for the other where an arm is before them.
    """
    votes = 0
    for pair in (SHOULDER, HIP, EYE, EAR):
        left, right = pair["left"], pair["right"]
        both = body.seen[:, left] & body.seen[:, right]
        if both.any():
            votes += int(np.sign(np.median(body.places[both, left, 1] - body.places[both, right, 1])))
    return votes < 0


def _is_in_picture(body: Array) -> bool:
    """Whether places are of a picture, and not scaled to the shoulders' breadth, which then are at 0."""
    middle = np.nanmedian(body[:, list(SHOULDER.values()), 1:], axis=(0, 1))
    return bool(np.abs(middle).max() > _CENTRED)


def _is_fractions(body: Array, size: tuple[int, int]) -> bool:
    """Whether places in a picture count in its widths and heights, as MediaPipe itself gives them.

    Those differ; pixels count alike both ways.
    """
    seen = body[np.isfinite(body[..., 1])][:, 1:] * [1.0, -1.0]
    return bool(min(size) > 1 and (np.abs(seen - 0.5) <= _FRACTION_LIMIT).mean() > _MOST)


def _scaled(points: Points, scales: Sequence[float]) -> Points:
    """Depths, and places across and up, each times a number."""
    places = points.places * scales
    places.setflags(write=False)
    return Points(places=places, confidence=points.confidence)


def _points(data: Array, confidence: Array, columns: dict[int, int | None], count: int) -> Points:
    places = np.full((len(data), count, 3), np.nan)
    known = np.zeros((len(data), count))
    for at, column in columns.items():
        if column is None:
            continue
        seen = confidence[:, column] > 0.0
        known[:, at] = confidence[:, column]
        places[seen, at, 1] = data[seen, column, 0]
        places[seen, at, 2] = -data[seen, column, 1]
        if data.shape[-1] > 2:
            places[seen, at, 0] = -data[seen, column, 2]
    depths = places[known > 0.0, 0]
    if depths.size and np.ptp(depths) == 0.0:
        places[..., 0] = np.nan  # a depth that never changes was not found
    for array in (places, known):
        array.setflags(write=False)
    return Points(places=places, confidence=known)


def pose_file(rate: float, points: Array, size: tuple[int, int]) -> bytes:
    """A `.pose` file of one person.

    Args:
        rate: [Hz].
        points: x, y [px], depth away from the camera [m], confidence, 0 where not seen. Shape (n, 67, 4).
        size: Width and height of the picture [px].
    """
    from pose_format import Pose  # heavy, and needed by nothing but this
    from pose_format.numpy import NumPyPoseBody
    from pose_format.pose_header import PoseHeader, PoseHeaderComponent, PoseHeaderDimensions

    body = [_OPENPOSE.body_points.get(row, f"unused_{row}") for row in range(BODY)]
    components = [
        PoseHeaderComponent(name, list(names), [], [], "XYZC")
        for name, names in (
            (_OPENPOSE.body, body),
            (_OPENPOSE.left_hand, _OPENPOSE.hand_points),
            (_OPENPOSE.right_hand, _OPENPOSE.hand_points),
        )
    ]
    header = PoseHeader(0.2, PoseHeaderDimensions(*size, 0), components)
    seen = points[:, None, :, 3]
    data = np.ma.masked_array(points[:, None, :, :3], np.repeat(seen[..., None] <= 0.0, 3, axis=3))
    stream = BytesIO()
    Pose(header, NumPyPoseBody(rate, data, seen)).write(stream)
    return stream.getvalue()
