# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Motion between key poses, with or without stops."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicHermiteSpline, CubicSpline
from scipy.spatial.transform import Rotation, Slerp

from teo_skeleton_retriever.arrays import FloatArray
from teo_synthetic_signer.body.hand import OTHER_HAND
from teo_synthetic_signer.body.pose import ArmPose, BodyPose, Poser
from teo_synthetic_signer.body.rig import SIDES
from teo_synthetic_signer.errors import SyntheticError
from teo_synthetic_signer.script.body_avoidance import Clearing
from teo_synthetic_signer.script.keys import ArmKey, Key, KeyResolver


class Path:
    """Smooth in place and speed; at rest at both ends, exactly at each pose at its time."""

    def __init__(self, times: Sequence[float], wrists: Mapping[str, Sequence[FloatArray]]) -> None:
        """Lay the way.

        Args:
            times: At which the poses are passed, the first and last are stops [s].
            wrists: Of each side, at these times [m].
        """
        self._times = np.array(times)
        self._progress = CubicHermiteSpline(self._times, np.arange(len(times)), self._speeds())
        self._wrists = {}
        for side, places in wrists.items():
            # Over the poses, not over time: its shape must not depend on how fast it is gone.
            self._wrists[side] = CubicSpline(np.arange(len(times)), np.array(places))

    def share(self, time: float) -> float:
        """Tell how much of the way from the pose that was passed last to the next is gone, 0 to 1."""
        last = int(np.clip(np.searchsorted(self._times, time, side="right") - 1, 0, len(self._times) - 2))
        return float(np.clip(self._progress(time) - last, 0.0, 1.0))

    def wrist(self, side: str, time: float) -> FloatArray:
        """Tell where a wrist is [m]. Shape (3,)."""
        place: FloatArray = self._wrists[side](self._progress(time))
        return place

    def _speeds(self) -> FloatArray:
        """Give poses a second at each pose: the harmonic mean keeps the order (Fritsch and Butland 1984)."""
        steps = np.diff(self._times)
        speeds = np.zeros(len(self._times))
        speeds[1:-1] = 2.0 / (steps[:-1] + steps[1:])
        return speeds


# How far a foot is lifted for a step [m].
_STEP_HEIGHT = 0.06

# A hand that stays farther than this off its place is at another part of the body [m].
_MOST_SHORT = 0.15

# Nobody stands still: the trunk sways and breathes. Amplitudes [rad] and frequencies [Hz] of quiet standing.
_SWAY = ((0.008, 0.27), (0.006, 0.19), (0.006, 0.23))
_NOD = ((0.012, 0.31), (0.010, 0.43), (0.008, 0.17))
_BLINK_EVERY, _BLINK_FOR = 3.4, 0.2  # [s]


def _minimum_jerk(share: float) -> float:
    """Give how far a movement is along its way after a share of its time.

    Source: Flash and Hogan, The coordination of arm movements, J. Neurosci. 5(7), 1985.
    """
    return min(1.0, share**3 * (10.0 - 15.0 * share + 6.0 * share**2))  # rounding must not overshoot


@dataclass(frozen=True)
class _Stage:
    """A key pose of one person, resolved."""

    key: Key
    start: float  # when the movement to it starts [s]
    arms: dict[str, ArmPose]
    feet: dict[str, tuple[float, float, float]]

    @property
    def arrival(self) -> float:
        return self.start + self.key.move

    @property
    def end(self) -> float:
        return self.arrival + self.key.hold


class Motion:
    """A script played by one person: the pose at any time."""

    def __init__(self, poser: Poser, keys: Sequence[Key]) -> None:
        """Resolve key poses; the first is where the person starts and must name both arms.

        Raises:
            SyntheticError: A place, point or shape that does not exist; in keys that keep out of the body,
                "out_of_reach".
        """
        self._poser = poser
        self._resolver = resolver = KeyResolver(poser)
        self._stages: list[_Stage] = []
        now = 0.0
        for key in keys:
            before = self._stages[-1] if self._stages else None
            arms = dict(before.arms) if before else {}
            wanted: dict[str, ArmKey | None] = {"R": key.right, "L": key.left}
            # The arm that refers to the other is resolved after it.
            for side in sorted(SIDES, key=lambda side: (wanted[side] or ArmKey()).at in OTHER_HAND):
                arm = wanted[side]
                if arm is not None:
                    other = arms.get("L" if side == "R" else "R")
                    arms[side] = resolver.arm(side, arm, other, outside=key.keep_out)
            if key.keep_out and resolver.shortfall > _MOST_SHORT:
                raise SyntheticError(
                    "out_of_reach",
                    f"expected places within reach, got one {100.0 * resolver.shortfall:.0f} cm beyond it at "
                    f"{now + key.move:.2f} s",
                )
            stage = _Stage(key, now - (0.0 if before else key.move), arms, self._feet(poser, key))
            self._stages.append(stage)
            now = stage.end
        self.shortfall = resolver.shortfall
        """By how much a hand stays off its place at most, as it is out of reach [m]."""
        self.duration = now
        """How long the script is [s]."""
        self._starts = [stage.start for stage in self._stages]
        self._clearing = Clearing(poser) if any(key.keep_out for key in keys) else None
        self._paths = self._laid()

    def _laid(self) -> dict[int, Path]:
        """Lay the ways through poses without a stop, by the stages that go them."""
        paths: dict[int, Path] = {}
        first = 0
        for index, stage in enumerate(self._stages):
            if stage.key.through and index + 1 < len(self._stages):
                continue
            if index > first + 1:
                run = self._stages[first : index + 1]
                times = [run[1].start, *(passed.arrival for passed in run[1:])]
                path = Path(times, {side: [at.arms[side].wrist for at in run] for side in SIDES})
                paths |= dict.fromkeys(range(first + 1, index + 1), path)
            first = index
        return paths

    @staticmethod
    def _feet(poser: Poser, key: Key) -> dict[str, tuple[float, float, float]]:
        cosine, sine = math.cos(key.heading), math.sin(key.heading)
        return {
            side: (key.place[0] + cosine * x - sine * y, key.place[1] + sine * x + cosine * y, z)
            for side, (x, y, z) in poser.standing_feet().items()
        }

    def pose(self, time: float) -> BodyPose:
        """Give the pose at a time after the start [s]; before and after the script, its first and last."""
        index = max(1, min(bisect_right(self._starts, time) - 1, len(self._stages) - 1))
        before, stage = self._stages[index - 1], self._stages[index]
        share, arms = self._arms(index, before, stage, time)
        if self._clearing and stage.key.keep_out:
            arms = self._clearing.cleared(arms)
        mix = _Mix(share)
        face = dict.fromkeys([*before.key.face, *stage.key.face], 0.0)
        for name in face:
            face[name] = mix(before.key.face.get(name, 0.0), stage.key.face.get(name, 0.0))
        blink = _blink(time)
        if blink > 0.0:
            face |= {"eyeBlinkLeft": blink, "eyeBlinkRight": blink}
        feet = {}
        for side in SIDES:
            lifted = _STEP_HEIGHT * math.sin(math.pi * share) if stage.key.step == side else 0.0
            foot = mix.all(before.feet[side], stage.feet[side])
            feet[side] = (foot[0], foot[1], foot[2] + lifted)
        lean = mix.all(before.key.lean, stage.key.lean)
        head = mix.all(before.key.head, stage.key.head)
        place = mix.all(before.key.place, stage.key.place)
        return BodyPose(
            arms=arms,
            place=(place[0], place[1]),
            heading=mix(before.key.heading, stage.key.heading),
            lean=_swayed(lean, _SWAY, time),
            head=_swayed(head, _NOD, time),
            feet=feet,
            face=face,
        )

    def _arms(
        self, index: int, before: _Stage, stage: _Stage, time: float
    ) -> tuple[float, dict[str, ArmPose]]:
        """Give how much of the way to a stage is gone, and the arms."""
        if index in self._paths and stage.start <= time < stage.arrival:
            path = self._paths[index]
            share = path.share(time)
            return share, {
                side: self._between(side, before.arms[side], stage.arms[side], share, path.wrist(side, time))
                for side in SIDES
            }
        share = _minimum_jerk(min(1.0, max(0.0, (time - stage.start) / stage.key.move)))
        return share, {
            side: self._arm(side, before.arms[side], stage.arms[side], share, stage.key) for side in SIDES
        }

    def _arm(self, side: str, start: ArmPose, end: ArmPose, share: float, key: Key) -> ArmPose:
        """Go from one pose of an arm to another; the forearm rolls and the wrist bends as joints do."""
        if share in (0.0, 1.0) or start is end:
            return end if share else start
        way: FloatArray = end.wrist - start.wrist
        forwards = np.array([key.arc * float(np.linalg.norm(way)), 0.0, 0.0])
        bulge = 4.0 * share * (1.0 - share) * (forwards + self._resolver.swung_out(side, key.bulge))
        return self._between(side, start, end, share, start.wrist + share * way + bulge)

    def _between(self, side: str, start: ArmPose, end: ArmPose, share: float, wrist: FloatArray) -> ArmPose:
        arm, poser = self._poser.arms[side], self._poser
        rolls, swings = zip(
            *(arm.wrist_joint(*poser.limb(side, at.wrist, at.swivel), at.hand) for at in (start, end)),
            strict=True,
        )
        mix = _Mix(share)
        swivel = mix(start.swivel, end.swivel)
        swing = Slerp([0.0, 1.0], Rotation.from_matrix(np.array(swings)))(share).as_matrix()
        hand = arm.hand_at(*poser.limb(side, wrist, swivel), mix(*rolls), swing)
        return ArmPose(wrist, hand, swivel, start.shape.blend(end.shape, share))


class _Mix:
    """Goes from one number to another."""

    def __init__(self, share: float) -> None:
        self._share = share

    def __call__(self, start: float, end: float) -> float:
        return (1.0 - self._share) * start + self._share * end

    def all(self, start: Sequence[float], end: Sequence[float]) -> tuple[float, ...]:
        return tuple(self(a, b) for a, b in zip(start, end, strict=True))


def _swayed(
    angles: tuple[float, ...], waves: tuple[tuple[float, float], ...], time: float
) -> tuple[float, float, float]:
    a, b, c = (
        angle + size * math.sin(2.0 * math.pi * rate * time)
        for angle, (size, rate) in zip(angles, waves, strict=True)
    )
    return a, b, c


def _blink(time: float) -> float:
    since = (time + 1.0) % _BLINK_EVERY
    return math.sin(math.pi * since / _BLINK_FOR) ** 2 if since < _BLINK_FOR else 0.0
