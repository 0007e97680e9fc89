# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the execution queue is told, what it answers, and how patient it is."""

from __future__ import annotations

import enum
from dataclasses import dataclass

from teo_motion.sentence.plan import Plan, TokenTiming
from teo_motion.sentence.sentence_form import STATEMENT, SentenceForm
from teo_motion.trajectory.driver_points import Samples
from teo_motion.trajectory.ruckig_segment import State
from teo_signs.tokens import Token


class Preemption(enum.StrEnum):
    """What a new sentence does to those that came before it."""

    QUEUE = "queue"  # it waits its turn
    REPLACE = "replace"  # it takes the place of every sentence of earlier texts


@dataclass(frozen=True, kw_only=True)
class QueueSettings:
    """Limits of waiting and of what counts as reached."""

    # Most sentences that wait [1]: two of the longest texts that the translator takes.
    capacity: int = 200

    # Joint states older than this are stale: no motion begins, one in progress is given up [s]: 50 of TEO's
    # periods, and soon enough to be told within a second.
    joint_state_timeout: float = 0.5

    # How near every joint must come to the end of a sentence [rad]: 1.1 deg, 13 encoder steps of TEO, and
    # seen from in front of the robot nothing.
    goal_tolerance: float = 0.02

    # How long after its planned end a sentence may take to be reached [s].
    goal_time: float = 2.0

    # How far a joint may be from the plan while signing [rad]: 11 deg, which the robot makes good in a
    # quarter of a second. A start and an end at rest look the same if it never moved: this tells.
    path_tolerance: float = 0.2

    # For how long it may be farther, and how late on its path it may be [s].
    path_time: float = 0.5

    # Time for which the hands stay still between two sentences that are joined, beyond the hold of the last
    # sign [s]: with `final_hold` the half second that deaf users ask for at a full stop.
    sentence_pause: float = 0.25

    # How often a sentence is begun before it is given up [1]: a robot that was pushed, or a driver that was
    # restarted, gets a second chance; a sentence that cannot be signed does not hold up the others for long.
    attempts: int = 2

    # What a new sentence does to those before it.
    preemption: Preemption = Preemption.QUEUE


@dataclass(frozen=True, kw_only=True)
class Sentence:
    """One sentence to sign.

    Attributes:
        tokens: What to sign, in order.
        utterance_id: Names the text that it comes from.
        index: Its place in the text, from 0.
        count: Number of sentences in the text.
        form: Type and negation.
        text: As it was typed; empty if not known.
        language: Code of its sign language; empty for that of the executor that takes it.
    """

    tokens: tuple[Token, ...]
    utterance_id: str = ""
    index: int = 0
    count: int = 1
    form: SentenceForm = STATEMENT
    text: str = ""
    language: str = ""


class Activity(enum.IntEnum):
    """What the executor is doing; the numbers are those of `teo_sign_msgs/ExecutorStatus`."""

    IDLE = 0
    SIGNING = 1
    WAITING = 2
    REFUSED = 3
    PAUSED = 4
    STOPPED = 5
    FAULT = 6


class Outcome(enum.IntEnum):
    """How a sentence ended; the numbers are those of `teo_sign_msgs/ExecuteSentence`."""

    SUCCESS = 0
    REFUSED = 1
    CANCELED = 2
    NOT_REACHED = 3


class DriverMode(enum.IntEnum):
    """What the driver is doing; the numbers are those of `teo_sign_msgs/DriverState`."""

    HOLDING = 0
    MOVING = 1
    PAUSED = 2
    STOPPED = 3
    INACTIVE = 4
    FAULT = 5


@dataclass(frozen=True, kw_only=True)
class DriverReport:
    """What the driver says of itself.

    Attributes:
        mode: What it is doing.
        speed_scaling: Trajectory time per time, 0 to 1.
        stamp: When this was true [s].
        remaining: Trajectory time to the end of the trajectory that is executed [s]; None if none is.
        message: A sentence for people: why it does not move.
    """

    mode: DriverMode
    speed_scaling: float = 1.0
    stamp: float = 0.0
    remaining: float | None = None
    message: str = ""


@dataclass(frozen=True, kw_only=True, eq=False)
class PlanWanted:
    """Plan this sentence from this state.

    Answered by `opened` (only if an opening is wanted, and there is one) and then by `planned` or
    `not_planned`.

    Attributes:
        number: Names the request in the answers.
        sentence: What to sign.
        start: State from which to plan; it may be in motion.
        hold: Time for which limbs at rest stay as they are before the first sign [s].
        opening: Whether the robot stands still and waits: a first motion is wanted at once.
    """

    number: int
    sentence: Sentence
    start: State
    hold: float = 0.0
    opening: bool = False


@dataclass(frozen=True, kw_only=True, eq=False)
class ReturnWanted:
    """Plan the way to rest from this state, at a standstill; answered by `planned` or `not_planned`."""

    number: int
    start: State


@dataclass(frozen=True, kw_only=True, eq=False)
class TrajectoryReady:
    """Send this motion to the robot.

    Attributes:
        number: Names the motion in `driver_refused`.
        plan: The motion.
        samples: What the driver is sent: the plan's, or `SentMotion.continued` where it continues a motion.
        start: When the robot is to be at the first sample [s]; None where it stands there: as soon as the
            driver has the motion, which thus is never too late.
    """

    number: int
    plan: Plan
    samples: Samples
    start: float | None


@dataclass(frozen=True, kw_only=True, eq=False)
class StopReady:
    """Have the robot stop.

    Attributes:
        number: Names the motion in `driver_refused`.
        end: Where it is to stand.
        lead: In which time [s].
    """

    number: int
    end: State
    lead: float


@dataclass(frozen=True, kw_only=True, eq=False)
class HaltReady:
    """Have the driver stop the robot by itself, and take nothing until it is re-armed."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Begun:
    """The robot begins to sign a sentence, not for the first time if it was interrupted before."""

    ticket: int


@dataclass(frozen=True, kw_only=True, eq=False)
class Status:
    """Tell everybody what the executor is doing.

    Attributes:
        activity: What.
        stamp: Since when [s].
        sentence: Which sentence it is about, if any.
        queued: Sentences that wait behind it.
        plan: Motion of the sentence that is signed.
        code: Stable reason where something is wrong, else empty.
        message: A sentence for people.
    """

    activity: Activity
    stamp: float
    sentence: Sentence | None = None
    queued: int = 0
    plan: Plan | None = None
    code: str = ""
    message: str = ""


@dataclass(frozen=True, kw_only=True, eq=False)
class Finished:
    """A sentence has ended.

    Attributes:
        ticket: As `submit` gave it.
        outcome: How.
        message: A sentence for people; empty on success.
        timings: As planned; empty if it was not.
    """

    ticket: int
    outcome: Outcome
    message: str = ""
    timings: tuple[TokenTiming, ...] = ()


#: What is to be done.
Effect = PlanWanted | ReturnWanted | TrajectoryReady | StopReady | HaltReady | Begun | Status | Finished


@dataclass(frozen=True, kw_only=True)
class Progress:
    """How far a sentence is.

    Attributes:
        ticket: As `submit` gave it.
        token: Index of the token that is signed, or that is next.
        gloss: Of that token while it is signed; empty in transitions.
        fraction: Of the whole motion, 0 to 1.
        stretch: Of the whole sentence.
    """

    ticket: int
    token: int
    gloss: str
    fraction: float
    stretch: float
