# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Recordings of manual alphabets, from the package `spoken-to-signed`, and what they say over time.

A clip for each letter, of one signer for each language: MediaPipe Holistic landmarks at 25 frames a
second. They look flat, but are not: width and height were scaled to pixels and the depth was left in
MediaPipe's unit, a fraction of the picture's width. `DEPTH_SCALE` puts it back. Where the tracker of the
hand lost it, which the tracker of the body tells, the hand is led straight from where it was last seen to
where it is seen again; a clip begins and ends where it is seen. A letter of the left hand is read as its
mirror image, one of both hands is refused. `find_stroke` says where the sign begins and ends in a clip, what
moves and what is held.
"""

from __future__ import annotations

import csv
import unicodedata
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import metadata, resources
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from teo_common.arrays import Array
from teo_sign_languages import Language
from teo_signs.errors import LutError
from teo_skeleton_retriever.lifting.hand_axes import INDEX, KNUCKLES, PALM, WRIST, palm_axes

PACKAGE = "spoken-to-signed"
LICENCE = "MIT"

# Pixels for one unit of the clips' depth: at this value the bones of the hand keep their lengths best over
# the 758 frames of the 30 clips of Spanish Sign Language (mean deviation 10 %, against 14 % without depth;
# flat between 550 and 700).
DEPTH_SCALE = 620.0

# Landmarks of the hands, the one that most people spell with first, and the wrist of each among the body's.
_HANDS = {"RIGHT_HAND_LANDMARKS": 16, "LEFT_HAND_LANDMARKS": 15}
_BODY, _SHOULDERS = "POSE_LANDMARKS", [11, 12]
# [pixel] The hand's wrist is within 27 of the body's in every Spanish letter's stroke but Q's, where 15
# frames in a row have it 34 to 55 away and the hand shrunk to a third: the hand was lost, the arm was not.
# Wrist to middle knuckle is 59.
_LOST = 30.0
# [shoulder widths] The other hand takes part if it is no farther below the shoulders for half of a clip. In
# the package's clips hands at rest are 1.19 and more below; where both spell, the other is 1.09 at most.
_TAKES_PART = 1.14


@dataclass(frozen=True, kw_only=True)
class LetterClip:
    """One letter as it was signed.

    Attributes:
        letter: Of the language's alphabet: "A", "CH".
        rate: Frames a second [Hz].
        hand: The 21 landmarks of the right hand, or the left one's mirror image [pixel of the normalised
            clip]: forward (to the viewer, from the wrist), to the signer's left, up. Shape (n, 21, 3),
            read-only.
        lost: Frames in which the hand was not seen, and is filled in. Shape (n,), read-only.
        file: Name of the recording.
    """

    letter: str
    rate: float
    hand: NDArray[np.float64]
    lost: NDArray[np.bool_]
    file: str


def load_letter_clips(
    language: Language, *, refused: Callable[[str, LutError], None] | None = None
) -> dict[str, LetterClip]:
    """Read the recordings of a language's letters.

    Args:
        language: The language.
        refused: Called with each letter that has no recording that can be used, and the reason; without it
            the first such reason is raised.

    Returns:
        Clips by letter, in the order of the alphabet.

    Raises:
        LutError: The language names no recordings or the package that holds them is missing ("no_clips"), or
            they are another language's ("other_language"). Of a letter: it has none ("no_clips"), a damaged
            one ("bad_clip") or one of both hands ("two_hands").
    """
    if language.alphabet.clips is None:
        raise LutError(
            "no_clips", f"expected alphabet.clips in language.yaml of {language.code!r}, got none: name them"
        )
    collection = language.alphabet.clips.collection
    try:
        root = Path(str(resources.files("spoken_to_signed"))) / "assets" / "fingerspelling_lexicon"
        with (root / "index.csv").open(encoding="utf-8", newline="") as file:
            rows = [row for row in csv.DictReader(file) if row["signed_language"] == collection]
        paths = {unicodedata.normalize("NFC", row["words"]).upper(): row["path"] for row in rows}
    except (ModuleNotFoundError, OSError, KeyError) as error:
        raise LutError(
            "no_clips", f"expected the package {PACKAGE} with its clips (pip install {PACKAGE}), got: {error}"
        ) from error
    # The rows of French Sign Language name the American files.
    others = {Path(path).parts[0] for path in paths.values()} - {collection}
    if others:
        raise LutError(
            "other_language",
            f"expected recordings of {collection!r}, got files of {', '.join(sorted(others))} under its name",
        )
    clips = {}
    for letter in language.alphabet.letters:
        try:
            if letter not in paths:
                there = ", ".join(paths) or "none"
                raise LutError(
                    "no_clips", f"{letter}: expected a recording in {collection!r}, which has {there}"
                )
            clips[letter] = _read(root / paths[letter], letter)
        except LutError as error:
            if refused is None:
                raise
            refused(letter, error)
    return clips


def clips_version() -> str:
    """Version of the package that holds the clips."""
    return metadata.version(PACKAGE)


def _read(path: Path, letter: str) -> LetterClip:
    from pose_format import Pose  # heavy, and needed by nothing but this

    try:
        pose = Pose.read(path.read_bytes())
        components = [(component.name, len(component.points)) for component in pose.header.components]
        names = [name for name, _ in components]
        starts = dict(zip(names, np.cumsum([0, *(count for _, count in components)]).tolist(), strict=False))
        points = np.asarray(pose.body.data.filled(np.nan), dtype=np.float64)[:, 0]
        body = points[:, starts[_BODY] : starts[_BODY] + 33]
        hands = [points[:, starts[name] : starts[name] + 21] for name in _HANDS]
        rate = float(pose.body.fps)
    except Exception as error:  # whatever a damaged file makes of pose-format
        raise LutError(
            "bad_clip", f"{letter}: {path.name}: expected a pose file with {', '.join(_HANDS)}, got: {error}"
        ) from error
    landmarks, body_wrist = _signing_hand(hands, body, f"{letter}: {path.name}")
    away = np.linalg.norm(landmarks[:, WRIST, :2] - body_wrist[:, :2], axis=1)
    there = np.asarray(np.isfinite(landmarks).all(axis=(1, 2)))
    lost = np.asarray(~(there & (away <= _LOST)))
    if lost.all():
        raise LutError(
            "bad_clip", f"{letter}: {path.name}: expected a hand at the arm's wrist, got none in any frame"
        )
    # What is before the first or after the last sight of the hand cannot be led from anywhere: left as it is.
    seen = np.flatnonzero(~lost)
    lost[: seen[0]] = ~there[: seen[0]]
    lost[seen[-1] :] = ~there[seen[-1] :]
    depth = landmarks[..., 2] - landmarks[:, WRIST, None, 2]
    hand = np.stack([-DEPTH_SCALE * depth, landmarks[..., 0], -landmarks[..., 1]], axis=-1)
    hand = _filled(hand, lost)
    hand.setflags(write=False)
    lost.setflags(write=False)
    return LetterClip(letter=letter, rate=rate, hand=hand, lost=lost, file=path.name)


def _signing_hand(hands: Sequence[Array], body: Array, where: str) -> tuple[Array, Array]:
    """The hand that spells, as if it were the right one, from its first to its last sight.

    Args:
        hands: Landmarks of the right hand and of the left one, NaN where it is not seen. Shapes (n, 21, 3).
        body: Those of the body. Shape (n, 33, 3).
        where: What errors begin with.

    Returns:
        Landmarks of the hand, shape (k, 21, 3), and of the wrist by the tracker of the body, (k, 3).
    """
    sights = [np.flatnonzero(np.isfinite(hand).all(axis=(1, 2))) for hand in hands]
    own = 0 if len(sights[0]) else 1
    if not len(sights[own]) or hands[own].shape[1:] != (21, 3):
        raise LutError("bad_clip", f"{where}: expected 21 landmarks of a hand, got none in any frame")
    wrists, shoulders = body[:, list(_HANDS.values())].swapaxes(0, 1), body[:, _SHOULDERS]
    width = np.nanmedian(np.linalg.norm(shoulders[:, 0] - shoulders[:, 1], axis=1))
    below = wrists[1 - own, :, 1] - shoulders[:, :, 1].mean(axis=1)
    below = below[np.isfinite(below)]  # of a hand out of the picture nothing is known
    if len(below) and np.median(below) <= _TAKES_PART * width:
        raise LutError(
            "two_hands", f"{where}: expected a letter of one hand, got both hands up: describe it in a score"
        )
    seen = slice(sights[own][0], sights[own][-1] + 1)
    hand, wrist = hands[own][seen], wrists[own][seen]
    if own:  # about the middle between the shoulders
        middle = float(np.nanmedian(shoulders[..., 0]))
        hand, wrist = ([2.0 * middle, 0.0, 0.0] + points * [-1.0, 1.0, 1.0] for points in (hand, wrist))
    return hand, wrist


def _filled(hand: NDArray[np.float64], lost: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Landmarks with the lost frames led straight from the frame before to the frame after."""
    frames = np.arange(len(hand))
    flat = hand.reshape(len(hand), -1)
    columns = [np.interp(frames, frames[~lost], column[~lost]) for column in flat.T]
    return np.column_stack(columns).reshape(hand.shape)


# Figures below are in pixels of the normalised clips, where wrist to middle knuckle is 59 pixels, and in
# degrees; "still" and "moving" letters lie well apart on each, as said there.
# [pixel/frame] The wrist rises and falls faster than this; no stroke of a letter does for so long.
_RISE = 8.0
# [deg/frame] Fingers bend faster than this, on average of the four, while the handshape forms or dissolves.
_FORMING = 20.0
# [deg] A hand tilted by this much more than it is in the later three quarters of the stroke is still
# arriving.
_SWING = 10.0
# [pixel] Way of the index tip from side to side, all swings added: at most 41 in still letters, 92 up in
# moving.
_SWAY = 60.0
# [deg] The palm turns more than this from its median in one frame of ten: at most 32 in letters that do not
# turn.
_TURN = 45.0
# [pixel] How much a finger's reach, knuckle to tip, changes beyond once through its range: Y's little finger
# 115, others at most 71.
_WAG = 90.0
# [deg] Frames of one hold have palms within this of their first.
_HOLD_ANGLE = 25.0
# [frame] A hold that is shorter is a passage.
_HOLD_FRAMES = 4


@dataclass(frozen=True, kw_only=True)
class Stroke:
    """The part of a clip that is the letter, without the arm's rise and fall.

    Attributes:
        first: First frame.
        last: Last frame, included.
        holds: Runs of frames in which the palm keeps its orientation: first and last frame; at least one.
        sways: Whether the hand moves from place to place, rocks or turns.
        wagging: Fingers that bend again and again: 0 index ... 3 little.
    """

    first: int
    last: int
    holds: tuple[tuple[int, int], ...]
    sways: bool
    wagging: tuple[int, ...]

    @property
    def frames(self) -> NDArray[np.intp]:
        """All frames. Shape (n,)."""
        return np.arange(self.first, self.last + 1)

    @property
    def turns(self) -> bool:
        """Whether the palm has more than one orientation."""
        return len(self.holds) > 1


def find_stroke(clip: LetterClip) -> Stroke:
    """Cut a clip and say what moves in it."""
    hand = clip.hand
    bends = _total_bends(hand)
    rising = np.abs(np.diff(hand[:, WRIST, 2])) >= _RISE
    forming = np.abs(np.diff(bends, axis=0)).mean(axis=1) >= _FORMING
    steady = np.flatnonzero(~(rising | forming))
    first, last = int(steady[0]), int(steady[-1]) + 1
    first += _arrival(hand[first : last + 1])
    inside = slice(first, last + 1)
    holds = _holds(hand[inside])
    spans = tuple((first + start, first + end) for start, end in holds)
    way = np.abs(np.diff(hand[inside][:, INDEX + 3, 1])).sum()
    span = reaches(hand[inside])
    beyond = np.abs(np.diff(span, axis=0)).sum(axis=0) - np.ptp(span, axis=0)
    return Stroke(
        first=first,
        last=last,
        holds=spans,
        sways=bool(way > _SWAY) or len(spans) > 1,
        # Fingers of a hand that turns are seen shorter and longer without bending.
        wagging=() if len(spans) > 1 else tuple(int(finger) for finger in np.flatnonzero(beyond > _WAG)),
    )


def _arrival(hand: Array) -> int:
    """Frames at the beginning in which the hand still swings into place, beyond all that it does later."""
    tilt = np.degrees(tilts(hand))
    later = tilt[len(tilt) // 4 :]
    inside = (tilt > later.min() - _SWING) & (tilt < later.max() + _SWING)
    return int(inside.argmax())


def _total_bends(hand: Array) -> Array:
    """Bend of each finger, knuckle to tip, all joints added [deg]. Shape (n, 4)."""
    local = np.einsum("nij,nki->nkj", palm_axes(hand), hand - hand[:, WRIST, None])
    total = np.empty((len(hand), 4))
    for finger, knuckle in enumerate(KNUCKLES):
        bones = np.diff(local[:, knuckle : knuckle + 4], axis=1)
        knuckle_bend = np.degrees(np.arctan2(bones[:, 0, 2], bones[:, 0, 0]))
        total[:, finger] = (
            knuckle_bend + _between(bones[:, 0], bones[:, 1]) + _between(bones[:, 1], bones[:, 2])
        )
    return total


def reaches(hand: Array) -> Array:
    """Length of each finger, knuckle to tip, as the viewer sees it [pixel]. Shape (n, 4)."""
    tips = [knuckle + 3 for knuckle in KNUCKLES]
    lengths: Array = np.linalg.norm(hand[:, tips, 1:] - hand[:, KNUCKLES, 1:], axis=-1)
    return lengths


def tilts(hand: Array) -> Array:
    """Direction of the hand as the viewer sees it [rad], unwrapped. Shape (n,)."""
    along = hand[:, KNUCKLES, 1:].mean(axis=1) - hand[:, WRIST, 1:]
    return np.unwrap(np.arctan2(along[:, 1], along[:, 0]))


def palm_centres(hand: Array) -> Array:
    """Middle of the palm across the view: left, up [pixel]. Shape (n, 2)."""
    centres: Array = hand[:, PALM, 1:].mean(axis=1)
    return centres


def _holds(hand: Array) -> list[tuple[int, int]]:
    axes = palm_axes(hand)
    middle = axes[:, :, (0, 2)]
    median = np.median(middle, axis=0)
    median /= np.linalg.norm(median, axis=0)
    away = np.degrees(np.arccos(np.clip((middle * median).sum(axis=1), -1.0, 1.0)))
    if np.percentile(away, 90, axis=0).max() <= _TURN:
        return [(0, len(hand) - 1)]
    found: list[tuple[int, int]] = []
    start = 0
    for frame in range(1, len(hand) + 1):
        if frame < len(hand) and _apart(axes[start], axes[frame]) <= _HOLD_ANGLE:
            continue
        if frame - start >= _HOLD_FRAMES:
            found.append((start, frame - 1))
        start = frame
    return found or [(0, len(hand) - 1)]


def _apart(first: Array, second: Array) -> float:
    """Angle of the rotation between two sets of axes [deg]."""
    cosine = (np.trace(first.T @ second) - 1.0) / 2.0
    return float(np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))))


def _between(first: Array, second: Array) -> Array:
    cosine = (first * second).sum(axis=-1) / (
        np.linalg.norm(first, axis=-1) * np.linalg.norm(second, axis=-1)
    )
    angles: Array = np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))
    return angles
