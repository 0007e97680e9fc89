# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Signs as motions in the formats of programs that play motions: play_motion2 and PlaybackThread."""

from __future__ import annotations

import json
import os
import shutil
import tempfile
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from teo_common.arrays import Array
from teo_description.hand_setpoints import setpoint_axes
from teo_description.humanoid import SIDES, load_humanoid
from teo_signs.errors import LutError
from teo_signs.sign import Sign


@dataclass(frozen=True, kw_only=True, eq=False)
class SignMotion:
    """A sign from rest to rest, for programs that play motions and know no signs. Arrays are read-only.

    Such a program goes straight to the first position, with no look at what is in between; a motion from rest
    to rest leaves nothing to hit on the way.

    Attributes:
        sign: The entry.
        limbs: Joints of each of the robot's limbs that moves, in its order; the others stay at rest.
        times: [s] from 0, evenly spaced. Shape (n,).
        positions: [rad], a column for each of `joints`. Shape (n, m).
        start: When the sign itself begins [s].
        duration: How long the sign itself lasts [s].
        stretch: Duration over the duration in the table [1].
    """

    sign: Sign
    limbs: Mapping[str, tuple[str, ...]]
    times: Array
    positions: Array
    start: float
    duration: float
    stretch: float

    @property
    def joints(self) -> tuple[str, ...]:
        """Joints of the moving limbs."""
        return tuple(joint for joints in self.limbs.values() for joint in joints)

    @property
    def description(self) -> str:
        """What it is of and what it was made for, in a sentence."""
        sign = self.sign
        return (
            f"{sign.kind} of {sign.language} for {sign.robot}, {sign.provenance.standing}; from rest to "
            f"rest, the sign from {self.start:.2f} s for {self.duration:.2f} s "
            f"({self.stretch:.2f} times its time)"
        )

    def limb(self, name: str) -> Array:
        """Positions of one moving limb [rad]. Shape (n, joints of the limb)."""
        columns = [self.joints.index(joint) for joint in self.limbs[name]]
        return self.positions[:, columns]


# A nanoradian: what is written stays within the limits that it stands on.
_RADIAN_DECIMALS = 9


def play_motion2_parameters(motions: Iterable[SignMotion]) -> str:
    """The text of a parameter file of play_motion2: motions by gloss, joints in radians.

    Its form is that of pal-robotics/play_motion2, README and motion_loader.cpp: `motions.<key>.joints`,
    `.positions` (a row for each time, rows one after the other), `.times_from_start` and `.meta.name`,
    `.usage`, `.description`. Numbers all carry a decimal point, for ROS takes a list of numbers without one
    for integers and play_motion2 refuses those. Texts and keys are quoted: without quotes `NO` and `Y` are
    truth values in YAML, and `7` is a number.
    """
    lines = ["play_motion2:", "  ros__parameters:", "    motions:"]
    for motion in motions:
        sign = motion.sign
        rows = [", ".join(map(_number, row)) for row in motion.positions.tolist()]
        lines += [
            f"      {_text(sign.gloss)}:",
            f"        joints: [{', '.join(map(_text, motion.joints))}]",
            "        positions: [",
            *(f"          {row}," for row in rows[:-1]),
            f"          {rows[-1]}]",
            f"        times_from_start: [{', '.join(map(_number, motion.times.tolist()))}]",
            "        meta:",
            f"          name: {_text(sign.gloss)}",
            f"          usage: {_text('sign')}",
            f"          description: {_text(motion.description)}",
        ]
    return "\n".join(lines) + "\n"


def _number(value: float) -> str:
    return f"{round(value, _RADIAN_DECIMALS) + 0.0:.{_RADIAN_DECIMALS}f}"


def _text(value: str) -> str:
    """A JSON string is a double-quoted YAML scalar."""
    return json.dumps(value, ensure_ascii=False)


# Finer than what TEO's drives count in, 5e-4 deg, and than a tick of a Dextra's encoder.
_BOARD_DECIMALS = 4

_TIME_DECIMALS = 6


def playback_mask(axes: int) -> str:
    """PlaybackThread's option `mask` for a board of so many axes: 0 for the time's column, 1 for each."""
    return f"({' '.join(['mask', '0', *['1'] * axes])})"


def playback_table(motion: SignMotion, limb: str) -> str:
    """The text of the file of a limb's board for TEO's PlaybackThread (roboticslab-uc3m/tools).

    No header; a row for each moment, numbers by spaces: the time [s], then the board's axes in its order and
    units: degrees, and for the fingers of a Dextra hand millimetres of tendon. PlaybackThread plays it with
    `timeIdx 0`, `timeScale 1` and the mask of `playback_mask`.

    Raises:
        DescriptionError: A finger is outside what the device can do ("outside_hand_range").
    """
    columns = _board_units(motion, limb)
    rows = zip(motion.times.tolist(), columns.tolist(), strict=True)
    return "".join(
        " ".join([f"{time:.{_TIME_DECIMALS}f}", *(f"{value + 0.0:.{_BOARD_DECIMALS}f}" for value in row)])
        + "\n"
        for time, row in rows
    )


def save_playback_tables(directory: Path, motion: SignMotion, *, replace: bool = False) -> list[Path]:
    """Write a sign's tables into a folder of its own, all of them or none.

    One file for each control board that moves, and `SIGN.txt` beside them, which says of which language the
    sign is and for which robot: a table has no place for that. A folder is replaced whole: a table of an arm
    that moved in an older version of the sign must not stay.

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
    controllers = load_humanoid(motion.sign.robot).file.controllers
    if controllers is None:
        raise LutError(
            "no_boards",
            f"{motion.sign.gloss}: expected a robot whose robot.yaml names its control boards, got "
            f"{motion.sign.robot}: export its signs for play_motion2, which takes joint angles",
        )
    folder = directory / motion.sign.gloss
    if folder.exists() and not replace:
        raise LutError("exists", f"{folder}: expected a folder that is not there, or --replace")
    tables = {controllers.boards[limb]: playback_table(motion, limb) for limb in motion.limbs}
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


def _board_units(motion: SignMotion, limb: str) -> Array:
    """Positions of a limb in the units of its board, rounded to what the file keeps."""
    humanoid, positions = load_humanoid(motion.sign.robot), motion.limb(limb)
    hands = {f"{side}_hand": setpoint_axes(humanoid, side) for side in SIDES}
    if limb not in hands:
        return np.asarray(np.round(np.degrees(positions), _BOARD_DECIMALS))
    columns = [
        [min(max(axis.setpoint(angle), 0.0), axis.travel) for angle in column]
        for axis, column in zip(hands[limb], positions.T.tolist(), strict=True)
    ]
    return np.round(np.array(columns).T, _BOARD_DECIMALS)
