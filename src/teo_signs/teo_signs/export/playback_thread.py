# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Signs as tables for TEO's PlaybackThread (roboticslab-uc3m/tools, libraries/Playback and YarpPlugins).

One file for each control board that moves. No header; a row for each moment, numbers by spaces: the time [s],
then the board's axes in its order and units: degrees, and for the fingers of a Dextra hand millimetres
of tendon. PlaybackThread plays it with `timeIdx 0`, `timeScale 1` and the mask of `playback_mask`. `SIGN.txt`
beside them says of which language the sign is and for which robot, for which a table has no place.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from teo_description.hand_setpoints import setpoint_axes
from teo_description.humanoid import SIDES, load_humanoid
from teo_description.schema.controllers import Controllers
from teo_signs.errors import LutError
from teo_signs.export.sign_motion import SignMotion

# Finer than what TEO's drives count in, 5e-4 deg, and than a tick of a Dextra's encoder.
_DECIMALS = 4

_TIME_DECIMALS = 6


def playback_mask(axes: int) -> str:
    """PlaybackThread's option `mask` for a board of so many axes: 0 for the time's column, 1 for each."""
    return f"({' '.join(['mask', '0', *['1'] * axes])})"


def playback_table(motion: SignMotion, limb: str) -> str:
    """The text of the file of a limb's board.

    Raises:
        DescriptionError: A finger is outside what the device can do ("outside_hand_range").
    """
    columns = _board_units(motion, limb)
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
        The files, in the order of the motion's limbs.

    Raises:
        LutError: The folder is there already ("exists"), or the names of the robot's control boards are not
            known ("no_boards").
        OSError: It cannot be written.
    """
    boards = _controllers(motion).boards
    folder = directory / motion.sign.gloss
    if folder.exists() and not replace:
        raise LutError("exists", f"{folder}: expected a folder that is not there, or --replace")
    tables = {boards[limb]: playback_table(motion, limb) for limb in motion.limbs}
    directory.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=directory, prefix=".") as temporary:
        made = Path(temporary) / "made"
        made.mkdir()
        for name, text in {**tables, "SIGN": f"{motion.sign.gloss}: {motion.description}\n"}.items():
            with (made / f"{name}.txt").open("w", encoding="utf-8") as file:
                file.write(text)
                file.flush()
                os.fsync(file.fileno())
        if folder.exists():
            shutil.move(folder, Path(temporary) / "old")
        made.rename(folder)
    return [folder / f"{board}.txt" for board in tables]


def _controllers(motion: SignMotion) -> Controllers:
    controllers = load_humanoid(motion.sign.robot).file.controllers
    if controllers is None:
        raise LutError(
            "no_boards",
            f"{motion.sign.gloss}: expected a robot whose robot.yaml names its control boards, got "
            f"{motion.sign.robot}: export its signs for play_motion2, which takes joint angles",
        )
    return controllers


def _board_units(motion: SignMotion, limb: str) -> NDArray[np.float64]:
    """Positions of a limb in the units of its board, rounded to what the file keeps."""
    humanoid, positions = load_humanoid(motion.sign.robot), motion.limb(limb)
    hands = {f"{side}_hand": setpoint_axes(humanoid, side) for side in SIDES}
    if limb not in hands:
        return np.asarray(np.round(np.degrees(positions), _DECIMALS), dtype=np.float64)
    columns = [
        [min(max(axis.setpoint(angle), 0.0), axis.travel) for angle in column]
        for axis, column in zip(hands[limb], positions.T.tolist(), strict=True)
    ]
    return np.asarray(np.round(np.array(columns).T, _DECIMALS), dtype=np.float64)
