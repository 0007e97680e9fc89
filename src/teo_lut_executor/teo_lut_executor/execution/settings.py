"""How patient the execution queue is."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class QueueSettings:
    """Limits of waiting and of what counts as reached."""

    # Most sentences that wait [1]: two of the longest texts that the translator takes.
    capacity: int = 200

    # A start is not planned from joint states older than this [s]: 50 of TEO's periods.
    joint_state_timeout: float = 0.5

    # How near every joint must come to the end of a sentence [rad]: 1.1 deg, 13 encoder steps of TEO, and
    # seen from in front of the robot nothing.
    goal_tolerance: float = 0.02

    # How long after its planned end a sentence may take to be reached [s].
    goal_time: float = 2.0

    # How far a joint may be from the plan while signing [rad]: 11 deg, which the robot makes good in a
    # quarter of a second. A start and an end at rest look the same if it never moved: this tells.
    path_tolerance: float = 0.2

    # For how long it may be farther [s].
    path_time: float = 0.5
