# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the joints do: follow a trajectory, faster or slower, hold, or stop."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection

import numpy as np

from teo_description import JointLimits
from teo_sim_driver.bezier import FloatArray
from teo_sim_driver.errors import DriverError, Refusal, TrajectoryError
from teo_sim_driver.follower_report import FollowerReport, Mode, Source
from teo_sim_driver.message import TrajectoryLike
from teo_sim_driver.path_time import Braking, PathClock, PathPace, fastest_ahead
from teo_sim_driver.reading import MessageFields, Points
from teo_sim_driver.rules import Rules
from teo_sim_driver.step_guard import StepGuard
from teo_sim_driver.trajectory import MotionState, Trajectory
from teo_sim_driver.validation import check, schedule

# Deceleration of a stop [rad/s^2], 300 deg/s^2: about that of signs. No limit of the real joints is public.
DEFAULT_STOP_DECELERATION = 5.2

# Jerk of a stop [rad/s^3], that of the planner's motions: the deceleration builds up in 0.05 s. From 50 deg/s
# a stop takes 0.22 s and at most 0.1 rad.
DEFAULT_STOP_JERK = 105.0
DEFAULT_BRAKING = Braking(DEFAULT_STOP_DECELERATION, DEFAULT_STOP_JERK)

# Modes in which nothing is taken, the first that holds goes first; with the refusal's code and what to do.
_BLOCKING = {
    Mode.INACTIVE: (Refusal.INACTIVE, "activate it (`ros2 lifecycle set ... activate`), then send it again"),
    Mode.FAULT: (Refusal.FAULT, "mend the cause, call `rearm`, then send it again"),
    Mode.STOPPED: (Refusal.STOPPED, "call `rearm`, then send it again"),
    Mode.PAUSED: (Refusal.PAUSED, "resume, or stop and re-arm, then send it again"),
}


class JointFollower:
    """Executes trajectories, one at a time. Owns no clock: every call says what time it is [ns]."""

    def __init__(
        self,
        *,
        limits: JointLimits,
        start: FloatArray,
        period: float,
        held: Collection[str] = (),
        rules: Rules | None = None,
        braking: Braking = DEFAULT_BRAKING,
    ) -> None:
        """Stand still, ready to move.

        Args:
            limits: Of the joints that are commanded.
            start: Their positions now [rad]. Shape (joints,).
            period: Usual time between two steps [s].
            held: Names of joints that the robot has and that are never moved.
            rules: Limits on messages; may be exchanged later.
            braking: What slowing down and speeding up may add; may be exchanged later.

        Raises:
            DriverError: ``start_outside_limits``.
        """
        outside = [
            n
            for n, p, a, b in zip(limits.names, start, limits.lower, limits.upper, strict=True)
            if not a <= p <= b
        ]
        if outside:
            raise DriverError(
                "start_outside_limits", f"expected a start within the joint limits; not so: {outside}"
            )
        self.rules = rules or Rules()
        self.braking = braking
        self.limits = limits
        self._held = held
        self._guard = StepGuard(limits)
        self._clock = PathClock(period)
        self.step_duration = 0.0
        """Of the last step [s]."""
        self._pace = PathPace()
        self._scaling = 1.0
        self._paused = False
        self._blocks: dict[Mode, str] = {}  # modes in which nothing moves until they are released, and why
        self._sent = self._rest = MotionState.at_rest(np.array(start, dtype=np.float64))
        self._trajectory, self._time = Trajectory.hold(self._rest.positions), 0.0
        self._following = self._ending = False
        self._source = Source.NONE
        self._accepted = 0
        self._refused: Counter[str] = Counter()
        self._last_refusal: TrajectoryError | None = None
        self._limited_steps = 0
        self._limited_joints: tuple[str, ...] = ()

    @property
    def trajectory(self) -> Trajectory | None:
        """What is being executed; None when holding."""
        return self._trajectory if self._following else None

    @property
    def mode(self) -> Mode:
        """What it is doing."""
        for mode in _BLOCKING:
            if mode in self._blocks:
                return mode
        if self._paused or self._scaling == 0.0:
            return Mode.PAUSED
        return Mode.MOVING if self._following else Mode.HOLDING

    def step(self, now: int) -> MotionState:
        """Move on to this time and return what is sent to the joints."""
        self.step_duration = duration = self._clock.advance(now)
        asked = self._advance(duration)
        if asked.positions is self._sent.positions:  # holding still
            return self._sent
        guarded = self._guard.limit(asked.positions, self._sent.positions, duration)
        if guarded.limited:
            self._limited_steps += 1
            self._limited_joints = guarded.limited
            moved = guarded.positions - self._sent.positions
            velocities = moved / duration if duration > 0.0 else np.zeros_like(moved)
            asked = MotionState(guarded.positions, velocities, np.zeros_like(moved))
        self._sent = asked
        return asked

    def accept(self, message: TrajectoryLike, now: int) -> Trajectory:
        """Check a message and take its trajectory: `check` and `take` in one.

        Raises:
            TrajectoryError: refused; whatever was going on goes on.
        """
        try:
            points = check(MessageFields(message), limits=self.limits, rules=self.rules, held=self._held)
        except TrajectoryError as refusal:
            self.count_refusal(refusal)
            raise
        return self.take(points, now)

    def take(self, points: Points, now: int, source: Source = Source.NONE) -> Trajectory:
        """Take a checked trajectory in place of the present one, from its start time on.

        Args:
            points: As `validation.check` returned them.
            now: [ns].
            source: Who gave it.

        Raises:
            TrajectoryError: refused; whatever was going on goes on.
        """
        self.step(now)
        try:
            self._check_free()
            delay, trajectory = schedule(
                points, limits=self.limits, rules=self.rules, now=now, state_in=self._path_state_in
            )
        except TrajectoryError as refusal:
            self.count_refusal(refusal)
            raise
        if delay > 0.0:
            trajectory = self._trajectory.cut(self._time, self._time + self._pace.progress(delay)).then(
                trajectory
            )
        self._accepted += 1
        self._trajectory, self._time, self._following, self._source = trajectory, 0.0, True, source
        return trajectory

    def count_refusal(self, refusal: TrajectoryError) -> None:
        """Enter a refusal into the report."""
        self._refused[refusal.code] += 1
        self._last_refusal = refusal

    def cancel(self, now: int) -> float:
        """Slow down on the path until the robot stands still, and hold there; then trajectories are taken.

        Returns:
            Time until it stands still [s]; 0 when it holds already.
        """
        self.step(now)
        if self._following and not self._ending:
            self._ending = True
            self._turn()
            self._advance(0.0)
        return self._pace.remaining if self._following else 0.0

    def block(self, mode: Mode, reason: str, now: int) -> float:
        """Stop, be deactivated, or be in fault: `cancel`, and take nothing until it is released.

        Args:
            mode: STOPPED, INACTIVE or FAULT. A pause ends with it, as there is nothing left to go on with.
            reason: A sentence for people.
            now: [ns].

        Returns:
            Time until the robot stands still [s].
        """
        self._blocks.setdefault(mode, reason)
        self._paused = False
        return self.cancel(now)

    def release(self, mode: Mode) -> None:
        """Take trajectories again, as far as this mode is concerned.

        Raises:
            DriverError: ``moving``: the robot is still slowing down.
        """
        if mode in self._blocks and self._following and self._ending:
            raise DriverError(
                "moving", f"the robot is at rest in {self._pace.remaining:.2f} s: call again then"
            )
        self._blocks.pop(mode, None)

    def pause(self, now: int) -> float:
        """Slow down on the path, and stay on it.

        Returns:
            Time until the robot stands still [s].
        """
        self.step(now)
        self._paused = True
        self._turn()
        return self._pace.remaining if self._following else 0.0

    def resume(self, now: int) -> bool:
        """Go on after a pause; False if there was none."""
        self.step(now)
        paused, self._paused = self._paused, False
        self._turn()
        return paused

    def scale(self, factor: float, now: int) -> None:
        """Execute at this part of the speed that was asked for, 0..1, from now on; 0 pauses.

        Raises:
            DriverError: ``bad_factor``.
        """
        if not 0.0 <= factor <= 1.0:
            raise DriverError("bad_factor", f"expected a speed scaling factor within 0 .. 1, got {factor}")
        self.step(now)
        self._scaling = factor
        self._turn()

    def move_rest(self, positions: FloatArray) -> None:
        """Hold somewhere else from now on: where joints are that did not follow, as their drives go on again.

        Args:
            positions: [rad]. Shape (joints,). What is outside the limits is brought to them.
        """
        self._hold(np.clip(positions, self.limits.lower, self.limits.upper))
        self._sent = self._rest

    def state_at(self, delay: float) -> MotionState:
        """Where the joints are to be in so many seconds, if nothing new comes [rad], [rad/s], [rad/s^2]."""
        return self._path_state_in(delay) if self._following else self._rest

    def report(self) -> FollowerReport:
        """What goes on, and what has happened."""
        mode = self.mode
        return FollowerReport(
            mode=mode,
            at_rest=not self._following or (self._pace.rate == 0.0 and self._pace.remaining == 0.0),
            source=self._source,
            speed_scaling=self._pace.rate,
            path_time=self._time if self._following else 0.0,
            path_duration=self._trajectory.duration if self._following else 0.0,
            reason=self._reason(mode),
            accepted=self._accepted,
            refused=dict(self._refused),
            last_refusal=self._last_refusal,
            limited_steps=self._limited_steps,
            limited_joints=self._limited_joints,
            clock_jumps=self._clock.jumps,
        )

    def _check_free(self) -> None:
        mode = self.mode
        if mode in _BLOCKING:
            code, remedy = _BLOCKING[mode]
            raise TrajectoryError(code, f"{self._reason(mode)}: {remedy}")
        if self._ending:
            raise TrajectoryError(
                Refusal.STOPPING, "the robot slows down and is not at rest yet: send it again when it is"
            )

    def _reason(self, mode: Mode) -> str:
        """Why it is paused, stopped, inactive or in fault; empty in the other modes."""
        if mode is Mode.PAUSED:
            return "paused" if self._paused else "the speed scaling factor is 0"
        return self._blocks.get(mode, "")

    def _path_state_in(self, delay: float) -> MotionState:
        """State on the path, at full pace: what a trajectory that takes over begins with, at any pace."""
        return self._trajectory.sample(self._time + self._pace.progress(delay))

    def _turn(self) -> None:
        """Let the pace become what it should be now."""
        target = 0.0 if self._ending or self._paused else self._scaling
        if not self._following:
            self._pace.jump(target)
            return
        fastest = fastest_ahead(self._trajectory, self._time, self.limits.velocity, self.braking)
        self._pace.turn(target, fastest, self.braking)

    def _advance(self, duration: float) -> MotionState:
        """Let time pass and return where the joints should be."""
        if not self._following:
            return self._rest
        self._time += self._pace.advance(duration)
        state = self._trajectory.sample(self._time)
        rate, change = self._pace.rate, self._pace.acceleration
        if self._time >= self._trajectory.duration or (self._ending and rate == 0.0 == self._pace.remaining):
            self._hold(state.positions)
            return self._rest
        return MotionState(
            state.positions,
            rate * state.velocities,
            rate**2 * state.accelerations + change * state.velocities,
        )

    def _hold(self, positions: FloatArray) -> None:
        self._rest = MotionState.at_rest(positions)
        self._trajectory, self._time = Trajectory.hold(positions), 0.0
        self._following, self._ending, self._source = False, False, Source.NONE
        self._turn()
