# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the joints do: follow a trajectory, faster or slower, hold, or stop.

The last line of defence: whatever was computed, no step is faster than the robot or outside its limits.
"""

from __future__ import annotations

from collections import deque

import numpy as np

from teo_description import JointLimits
from teo_sim_driver.checking.reading import Points
from teo_sim_driver.checking.scheduling import schedule
from teo_sim_driver.follower_report import FollowerReport, Gate, Mode, Source, Tally
from teo_sim_driver.motion.bezier import FloatArray
from teo_sim_driver.motion.commanded_path import Command, CommandedPath
from teo_sim_driver.motion.path_time import DEFAULT_BRAKING, PathClock, PathPace, fastest_ahead
from teo_sim_driver.motion.trajectory import MotionState, Trajectory
from teo_sim_driver.rules import (
    POSITION_TOLERANCE,
    VELOCITY_TOLERANCE,
    DriverError,
    Refusal,
    Rules,
    TrajectoryError,
)

# Rounding of one step [rad].
_ROUNDING = 1e-9

# How many times as fast as it was sent a path is followed after a late step [1], the greatest that keeps the
# limits of velocity: twice as fast, what was lost in 0.3 s is made good in 0.3 s, and no part is left out.
_CATCHING_UP = (2.0, 1.5, 1.25)

# Steps that tell how fast they come [1]: more than come late in a row by chance.
_USUAL = 20

# Most that is made good [s]; what is later is lost to the path, which ends so much later. At its limit of
# velocity a joint is then less behind than the executor's `path_tolerance`.
_MOST_LATE = 0.2


class JointFollower:
    """Executes trajectories, of all joints or of some. Owns no clock: every call says what time it is [ns].

    What is being executed is one trajectory of all joints (`CommandedPath`): all of them slow down together
    when the pace changes.
    """

    def __init__(self, *, limits: JointLimits, start: FloatArray, period: float) -> None:
        """Stand still, ready to move.

        Args:
            limits: Of the joints that are commanded.
            start: Their positions now [rad]. Shape (joints,).
            period: Usual time between two steps [s].

        Raises:
            DriverError: ``start_outside_limits``.
        """
        inside = (start >= limits.lower) & (start <= limits.upper)
        outside = [name for name, good in zip(limits.names, inside, strict=True) if not good]
        if outside:
            raise DriverError(
                "start_outside_limits", f"expected a start within the joint limits; not so: {outside}"
            )
        self.rules = Rules()
        """Limits on messages; may be exchanged at any time."""
        self.braking = DEFAULT_BRAKING
        """What slowing down and speeding up may add; may be exchanged at any time."""
        self.limits = limits
        self._clock = PathClock(period)
        self._period = period
        self._since = 0.0  # the last step [s]
        self._gaps = deque([period] * _USUAL, maxlen=_USUAL)  # between the last steps [s]
        self._late = 0.0  # by which the joints are behind their path: less than a step, but after a late one
        self.step_duration = 0.0
        """Of the last step [s]."""
        self._pace = PathPace()
        self._gate = Gate()
        self._sent = self._rest = MotionState.at_rest(np.array(start, dtype=np.float64))
        self._path = CommandedPath(self._rest.positions, limits.velocity)
        self._following = self._ending = False
        self._tally = Tally()

    @property
    def trajectory(self) -> Trajectory | None:
        """What is being executed; None when holding."""
        return self._path.trajectory if self._following else None

    @property
    def mode(self) -> Mode:
        """What it is doing."""
        return self._gate.mode(self._following)

    @property
    def _at_rest(self) -> bool:
        return not self._following or (self._pace.rate == 0.0 and self._pace.remaining == 0.0)

    @property
    def slows_down(self) -> bool:
        """Whether it comes to a standstill, to hold there."""
        return self._following and self._ending

    def step(self, now: int) -> MotionState:
        """Move on to this time [ns] and return what is sent to the joints.

        After a late step they catch up with their path in several: none goes farther than the limits of
        velocity allow in a period, as that is when the drives expect to be there. Where all the last steps
        came more slowly, by a coarse clock or on a machine that is too slow, the shortest of them counts.
        """
        self._pass(now)
        self.step_duration, self._since = self._since, 0.0
        duration = min(self.step_duration, max(self._period, min(self._gaps)))
        self._gaps.append(self.step_duration)
        asked = self._advance(duration)
        if asked.positions is self._sent.positions:  # holding still
            return self._sent
        self._sent = self._guarded(asked, duration)
        return self._sent

    def take(self, points: Points, now: int, source: Source = Source.NONE, group: str = "") -> Command:
        """Take a checked trajectory in place of what its joints do at present, from its start time on.

        A command that loses joints to it is over: the joints that it keeps slow down on their path and hold.
        What other commands do goes on.

        Args:
            points: As `validation.check` returned them.
            now: [ns].
            source: Who gave it.
            group: Of joints, whose topic or action it came by; empty for the whole body.

        Raises:
            TrajectoryError: refused; whatever was going on goes on.
        """
        self._pass(now)
        try:
            self._gate.check(self._following)
            if self._ending:
                sentence = "the robot slows down and is not at rest yet: send it again when it is"
                raise TrajectoryError(Refusal.STOPPING, sentence)
            delay, trajectory = schedule(
                points, limits=self.limits, rules=self.rules, now=now, state_in=self._path_state_in
            )
        except TrajectoryError as refusal:
            self.count_refusal(refusal)
            raise
        self._tally.accepted += 1
        command = Command(points.columns, source, group)
        self._path.take(trajectory, command, self._pace.progress(self._late + delay), self.braking)
        self._following = True
        return command

    def count_refusal(self, refusal: TrajectoryError) -> None:
        """Enter a refusal into the report."""
        self._tally.refused[refusal.code] += 1
        self._tally.refusals.append(refusal)

    def cancel(self, now: int, command: Command | None = None) -> float:
        """Slow down on the path until the joints stand still, and hold there.

        Args:
            now: [ns].
            command: Whose joints are to stop while others go on; all joints without.

        Returns:
            Time until all of them stand still, at full pace [s]; 0 when they hold already.
        """
        self._pass(now)
        if command is not None and self._path.commands != (command,):
            if command.over:
                return 0.0
            return self._path.slow_down(command, None if self._at_rest else self.braking)
        if self._following and not self._ending:
            self._ending = True
            self._turn()
            self._move(0.0)
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
        self._gate.blocks.setdefault(mode, reason)
        self._gate.paused = False
        return self.cancel(now)

    def release(self, mode: Mode) -> None:
        """Take trajectories again, as far as this mode is concerned.

        Raises:
            DriverError: ``moving``: the robot is still slowing down.
        """
        if mode in self._gate.blocks and self.slows_down:
            raise DriverError(
                "moving", f"the robot is at rest in {self._pace.remaining:.2f} s: call again then"
            )
        self._gate.blocks.pop(mode, None)

    def pause(self, now: int) -> float:
        """Slow down on the path, and stay on it.

        Returns:
            Time until the robot stands still [s].
        """
        self._pass(now)
        self._gate.paused = True
        self._turn()
        return self._pace.remaining if self._following else 0.0

    def resume(self, now: int) -> bool:
        """Go on after a pause; False if there was none."""
        self._pass(now)
        paused, self._gate.paused = self._gate.paused, False
        self._turn()
        return paused

    def scale(self, factor: float, now: int) -> None:
        """Execute at this part of the speed that was asked for, 0..1, from now on; 0 pauses.

        Raises:
            DriverError: ``bad_factor``.
        """
        if not 0.0 <= factor <= 1.0:
            raise DriverError("bad_factor", f"expected a speed scaling factor within 0 .. 1, got {factor}")
        self._pass(now)
        self._gate.scaling = factor
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
        newest = self._path.commands[-1] if self._path.commands else None
        return FollowerReport(
            mode=mode,
            at_rest=self._at_rest,
            commands=tuple(command.name for command in self._path.commands),
            source=newest.source if newest else Source.NONE,
            speed_scaling=self._pace.rate,
            path_time=self._path.time + self._pace.progress(self._late) if self._following else 0.0,
            path_duration=self._path.trajectory.duration if self._following else 0.0,
            reason=self._gate.reason(mode),
            accepted=self._tally.accepted,
            refused=dict(self._tally.refused),
            refusals=tuple(self._tally.refusals),
            limited_steps=self._tally.limited_steps,
            limited_joints=self._tally.limited_joints,
            clock_jumps=self._clock.jumps,
        )

    def _guarded(self, asked: MotionState, duration: float) -> MotionState:
        """The last line of defence: whatever was computed, no step is too fast or leaves the limits.

        Trajectories are checked before, so a step that is limited here is a fault of this driver.

        Args:
            asked: A joint asked to go to NaN stays.
            duration: Since the last step, a period at most [s].

        Returns:
            The nearest positions to those asked that can be reached.
        """
        last, positions = self._sent.positions, asked.positions
        reach = self.limits.velocity * (1.0 + VELOCITY_TOLERANCE) * duration + _ROUNDING
        low = np.maximum(self.limits.lower - POSITION_TOLERANCE, last - reach)
        high = np.minimum(self.limits.upper + POSITION_TOLERANCE, last + reach)
        inside = (positions >= low) & (positions <= high)
        if inside.all():
            return asked
        self._tally.limited_steps += 1
        self._tally.limited_joints = tuple(
            name for name, good in zip(self.limits.names, inside, strict=True) if not good
        )
        sent = np.where(np.isnan(positions), last, np.clip(positions, low, high))
        moved = sent - last
        still = np.zeros_like(moved)
        return MotionState(sent, moved / duration if duration > 0.0 else still, still)

    def _path_state_in(self, delay: float) -> MotionState:
        """State on the path, at full pace: what a trajectory that takes over begins with, at any pace."""
        return self._path.sample(self._pace.progress(self._late + delay))

    def _pass(self, now: int) -> None:
        """Let time pass until now [ns]; the joints move with the next step."""
        passed = self._clock.advance(now)
        self._since += passed
        self._late = min(self._late + passed, _MOST_LATE) if self._following else 0.0

    def _turn(self) -> None:
        """Let the pace become what it should be now; what was lost before is not made good."""
        self._late = 0.0
        target = 0.0 if self._ending else self._gate.pace
        if not self._following:
            self._pace.jump(target)
            return
        fastest = fastest_ahead(self._path.trajectory, self._path.time, self.limits.velocity, self.braking)
        self._pace.turn(target, fastest, self.braking)

    def _advance(self, duration: float) -> MotionState:
        """Where the joints should be after a step of so much time [s]."""
        if not self._following:
            return self._rest
        passed = min(self._late, duration)
        if self._late > duration > 0.0:
            reach = self.limits.velocity * duration
            for pace in _CATCHING_UP:
                ahead = min(self._late, pace * duration)
                there = self._path.sample(self._pace.progress(ahead))
                moved = np.abs(there.positions - self._sent.positions)
                if (moved <= reach).all() and (pace * np.abs(there.velocities) <= self.limits.velocity).all():
                    passed = ahead
                    break
        self._late -= passed
        return self._move(passed, passed / duration if duration > 0.0 else 1.0)

    def _move(self, passed: float, pace: float = 1.0) -> MotionState:
        """Let time pass on the path [s], by a step that is shorter by this factor [1]."""
        state = self._path.advance(self._pace.advance(passed))
        rate, change = self._pace.rate * pace, self._pace.acceleration
        ended = self._path.time >= self._path.trajectory.duration
        if ended or (self._ending and self._pace.rate == 0.0 == self._pace.remaining):
            self._hold(state.positions)
            return self._rest
        return state.at_pace(rate, change)

    def _hold(self, positions: FloatArray) -> None:
        self._rest = MotionState.at_rest(positions)
        self._path.hold(positions)
        self._following, self._ending = False, False
        self._turn()
