# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the execution queue is told, what it answers, and how patient it is."""

from __future__ import annotations

import enum
from dataclasses import dataclass, field

from teo_motion.sentence.plan import Plan, TokenTiming
from teo_motion.sentence.sentence_form import STATEMENT, SentenceForm
from teo_motion.trajectory.ruckig_segment import State
from teo_signs.tokens import Token


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


@dataclass(frozen=True, kw_only=True)
class Sentence:
    """One sentence to sign.

    Attributes:
        tokens: What to sign, in order.
        utterance_id: Names the text that it comes from.
        index: Its place in the text, from 0.
        count: Number of sentences in the text.
        form: Type and negation.
    """

    tokens: tuple[Token, ...]
    utterance_id: str = ""
    index: int = 0
    count: int = 1
    form: SentenceForm = STATEMENT


class Activity(enum.IntEnum):
    """What the executor is doing; the numbers are those of `teo_sign_msgs/ExecutorStatus`."""

    IDLE = 0
    SIGNING = 1
    WAITING = 2
    REFUSED = 3


class Outcome(enum.IntEnum):
    """How a sentence ended; the numbers are those of `teo_sign_msgs/ExecuteSentence`."""

    SUCCESS = 0
    REFUSED = 1
    CANCELED = 2
    NOT_REACHED = 3


@dataclass(frozen=True, kw_only=True, eq=False)
class PlanWanted:
    """Plan this sentence from this state, then call `planned` or `not_planned`."""

    sentence: Sentence
    start: State


@dataclass(frozen=True, kw_only=True, eq=False)
class ReturnWanted:
    """Plan the way to rest from this state, then call `return_planned`; without one the sentence goes on."""

    start: State


@dataclass(frozen=True, kw_only=True, eq=False)
class TrajectoryReady:
    """Send this motion to the robot, now.

    Attributes:
        plan: The motion.
        lead: When its first sample is to be reached [s]; 0: the robot is there.
    """

    plan: Plan
    lead: float = 0.0


@dataclass(frozen=True, kw_only=True, eq=False)
class Status:
    """Tell everybody what the executor is doing.

    Attributes:
        activity: What.
        stamp: Since when [s].
        sentence: Which sentence it is about, if any.
        queued: Sentences that wait behind it.
        plan: Motion of the sentence that is signed.
        code: Stable reason of a refusal, else empty.
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
    timings: tuple[TokenTiming, ...] = field(default=())


Event = PlanWanted | ReturnWanted | TrajectoryReady | Status | Finished


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
