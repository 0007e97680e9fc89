# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Signs as tables for TEO's own PlaybackThread (roboticslab-uc3m/tools, libraries/Playback and YarpPlugins).

One file for each control board that moves. No header; a row for each moment, numbers by spaces: the time [s],
then the board's axes in its order and units: degrees, and for the fingers of a Dextra hand millimetres
of tendon. PlaybackThread plays it with `timeIdx 0`, `timeScale 1` and the mask of `playback_mask`.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from teo_description.tendons import LEFT_AXES, RIGHT_AXES
from teo_signs.errors import LutError
from teo_signs.export.sign_motion import PARTS, SignMotion

_HAND_AXES = {"leftHand": LEFT_AXES, "rightHand": RIGHT_AXES}

# Finer than what TEO's drives count in, 5e-4 deg, and than a tick of a Dextra's encoder.
_DECIMALS = 4

_TIME_DECIMALS = 6


def playback_mask(part: str) -> str:
    """PlaybackThread's option `mask` for a part: 0 for the time's column, 1 for each axis."""
    return f"({' '.join(['mask', '0', *['1'] * len(PARTS[part])])})"


def playback_table(motion: SignMotion, part: str) -> str:
    """The text of one board's file.

    Raises:
        DescriptionError: A finger is outside what the device can do ("outside_hand_range").
    """
    columns = _board_units(part, motion.part(part))
    rows = zip(motion.times.tolist(), columns.tolist(), strict=True)
    return "".join(
        " ".join([f"{time:.{_TIME_DECIMALS}f}", *(f"{value + 0.0:.{_DECIMALS}f}" for value in row)]) + "\n"
        for time, row in rows
    )


def save_playback_tables(directory: Path, motion: SignMotion, *, replace: bool = False) -> list[Path]:
    """Write a sign's tables into a folder of its own, all of them or none.

    A folder is replaced whole: a table of an arm that moved in an older version of the sign must not stay.

    Args:
        directory: Where the folder goes, named after the gloss; made if it is not there.
        motion: The sign.
        replace: Whether a folder of that name may be replaced.

    Returns:
        The files, in the order of `PARTS`.

    Raises:
        LutError: The folder is there already ("exists").
        OSError: It cannot be written.
    """
    folder = directory / motion.sign.gloss
    if folder.exists() and not replace:
        raise LutError("exists", f"{folder}: expected a folder that is not there, or --replace")
    tables = {part: playback_table(motion, part) for part in motion.parts}
    directory.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=directory, prefix=".") as temporary:
        made = Path(temporary) / "made"
        made.mkdir()
        for part, text in tables.items():
            with (made / f"{part}.txt").open("w", encoding="ascii") as file:
                file.write(text)
                file.flush()
                os.fsync(file.fileno())
        if folder.exists():
            shutil.move(folder, Path(temporary) / "old")
        made.rename(folder)
    return [folder / f"{part}.txt" for part in tables]


def _board_units(part: str, positions: NDArray[np.float64]) -> NDArray[np.float64]:
    """Positions [rad] in the units of a board, rounded to what the file keeps."""
    if part not in _HAND_AXES:
        return np.asarray(np.round(np.degrees(positions), _DECIMALS), dtype=np.float64)
    columns = [
        [min(max(axis.setpoint(angle), 0.0), axis.travel) for angle in column]
        for axis, column in zip(_HAND_AXES[part], positions.T.tolist(), strict=True)
    ]
    return np.asarray(np.round(np.array(columns).T, _DECIMALS), dtype=np.float64)
