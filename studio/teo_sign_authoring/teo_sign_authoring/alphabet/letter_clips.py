# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The recordings of manual alphabets that come with the package `spoken-to-signed`.

A clip for each letter, of one signer for each language: MediaPipe Holistic landmarks at 25 frames a second.
They look flat, but are not: width and height were scaled to pixels and the depth was left in MediaPipe's
unit, a fraction of the picture's width. `DEPTH_SCALE` puts it back. Where the tracker of the hand lost it,
which the tracker of the body tells, the hand is led straight from where it was last seen to where it is seen
again.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from importlib import metadata, resources
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from teo_sign_languages import Language
from teo_signs.errors import LutError
from teo_skeleton_retriever.lifting.hand_axes import WRIST

PACKAGE = "spoken-to-signed"
LICENCE = "MIT"

# Pixels for one unit of the clips' depth: at this value the bones of the hand keep their lengths best over
# the 758 frames of the 30 clips of Spanish Sign Language (mean deviation 10 %, against 14 % without depth;
# flat between 550 and 700).
DEPTH_SCALE = 620.0

_HAND = "RIGHT_HAND_LANDMARKS"
_BODY, _BODY_WRIST = "POSE_LANDMARKS", 16
# [pixel] The hand's wrist is within 27 of the body's in every Spanish letter's stroke but Q's, where 15
# frames in a row have it 34 to 55 away and the hand shrunk to a third: the hand was lost, the arm was not.
# Wrist to middle knuckle is 59.
_LOST = 30.0


@dataclass(frozen=True, kw_only=True)
class LetterClip:
    """One letter as it was signed.

    Attributes:
        letter: Of the language's alphabet: "A", "CH".
        rate: Frames a second [Hz].
        hand: The 21 landmarks of the right hand [pixel of the normalised clip]: forward (to the viewer, from
            the wrist), to the signer's left, up. Shape (n, 21, 3), read-only.
        lost: Frames in which the hand was not seen, and is filled in. Shape (n,), read-only.
        file: Name of the recording.
    """

    letter: str
    rate: float
    hand: NDArray[np.float64]
    lost: NDArray[np.bool_]
    file: str


def load_letter_clips(language: Language) -> dict[str, LetterClip]:
    """Read the recordings of a language's letters.

    Returns:
        Clips by letter, in the order of the alphabet.

    Raises:
        LutError: The language names no recordings, the package that holds them is missing, or has none of a
            letter ("no_clips"), those of another language ("other_language") or a damaged one ("bad_clip").
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
        paths = {row["words"].upper(): row["path"] for row in rows}
    except (ModuleNotFoundError, OSError, KeyError) as error:
        raise LutError(
            "no_clips", f"expected the package {PACKAGE} with its clips (pip install {PACKAGE}), got: {error}"
        ) from error
    missing = [letter for letter in language.alphabet.letters if letter not in paths]
    if missing:
        raise LutError(
            "no_clips",
            f"expected a recording of each letter of {language.code!r} in the collection {collection!r}, "
            f"got none of {', '.join(missing)}: it has {', '.join(paths) or 'none'}",
        )
    # The rows of French Sign Language name the American files.
    others = {Path(paths[letter]).parts[0] for letter in language.alphabet.letters} - {collection}
    if others:
        raise LutError(
            "other_language",
            f"expected recordings of {collection!r}, got files of {', '.join(sorted(others))} under its name",
        )
    return {letter: _read(root / paths[letter], letter) for letter in language.alphabet.letters}


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
        landmarks = points[:, starts[_HAND] : starts[_HAND] + 21]
        body_wrist = points[:, starts[_BODY] + _BODY_WRIST]
        rate = float(pose.body.fps)
    except Exception as error:  # whatever a damaged file makes of pose-format
        raise LutError("bad_clip", f"{path.name}: expected a pose file with {_HAND}, got: {error}") from error
    if landmarks.shape[1:] != (21, 3) or not np.isfinite(landmarks).all():
        raise LutError("bad_clip", f"{path.name}: expected 21 landmarks in each frame, got some missing")
    away = np.linalg.norm(landmarks[:, WRIST, :2] - body_wrist[:, :2], axis=1)
    lost = away > _LOST
    if lost.all():
        raise LutError("bad_clip", f"{path.name}: expected a hand at the arm's wrist, got none in any frame")
    # What is before the first or after the last sight of the hand cannot be led from anywhere: left as it is.
    seen = np.flatnonzero(~lost)
    lost[: seen[0]] = lost[seen[-1] :] = False
    depth = landmarks[..., 2] - landmarks[:, WRIST, None, 2]
    hand = np.stack([-DEPTH_SCALE * depth, landmarks[..., 0], -landmarks[..., 1]], axis=-1)
    hand = _filled(hand, lost)
    hand.setflags(write=False)
    lost.setflags(write=False)
    return LetterClip(letter=letter, rate=rate, hand=hand, lost=lost, file=path.name)


def _filled(hand: NDArray[np.float64], lost: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Landmarks with the lost frames led straight from the frame before to the frame after."""
    frames = np.arange(len(hand))
    flat = hand.reshape(len(hand), -1)
    columns = [np.interp(frames, frames[~lost], column[~lost]) for column in flat.T]
    return np.column_stack(columns).reshape(hand.shape)
