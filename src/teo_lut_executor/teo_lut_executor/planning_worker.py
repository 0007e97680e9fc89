# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The process that plans, and the settings that travel to it.

It reads `PlannerSettings`, `PlanWanted` and `ReturnWanted` from a socket, answers with what is below, in
order, and ends when the socket is closed: also when the process at its other end was killed.
"""

from __future__ import annotations

import gc
import sys
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from pathlib import Path

from teo_description.humanoid import DEFAULT_ROBOT, load_humanoid
from teo_description.robot import Robot
from teo_lut_executor.execution.interface import PlanWanted, ReturnWanted, Sentence
from teo_motion.planner import DEFAULT_CLEARANCE, DEFAULT_MAX_DURATION, DEFAULT_PERIOD, Planner
from teo_motion.sentence.plan import Plan
from teo_motion.sentence.signing_style import DEFAULT_REST, RestPosture, SigningStyle
from teo_motion.trajectory.limits import DEFAULT_ACCELERATION, DEFAULT_JERK, MotionLimits
from teo_motion.trajectory.ruckig_segment import State
from teo_sign_languages import DEFAULT_LANGUAGE, Language
from teo_signs.errors import LutError, PlanError
from teo_signs.lexicon import DEFAULT_STANDING
from teo_signs.look_up_table import Lut
from teo_signs.mirroring import MirroredSigns
from teo_signs.sign import Sign
from teo_signs.sign_schema import Standing
from teo_signs.tokens import Token


@dataclass(frozen=True, kw_only=True)
class PlannerSettings:
    """See `Planner` for the meaning of each.

    Attributes:
        robot: Name of the robot.
        language: Code of the sign language that is signed where a sentence names none.
        lut_directory: Of the look-up table; None for the user's own and the language's.
        left_handed: Whether signs are mirrored.
        acceleration: Greatest of the body's joints [rad/s^2].
        jerk: Greatest of the body's joints [rad/s^3].
        hand_drive: Gearmotors of the hands, one of the robot's; empty for its default.
    """

    robot: str = DEFAULT_ROBOT
    language: str = DEFAULT_LANGUAGE
    lut_directory: Path | None = None
    left_handed: bool = False
    least_standing: Standing = DEFAULT_STANDING
    style: SigningStyle = field(default_factory=SigningStyle)
    acceleration: float = DEFAULT_ACCELERATION
    jerk: float = DEFAULT_JERK
    hand_drive: str = ""
    least_clearance: float = DEFAULT_CLEARANCE
    period: float = DEFAULT_PERIOD
    max_duration: float = DEFAULT_MAX_DURATION
    rest_posture: RestPosture = DEFAULT_REST

    def table(self, language: str = "") -> Lut:
        """Open the look-up table of a language; by default of its own.

        Raises:
            LutError: See `Lut.open`.
        """
        return Lut.open(self.lut_directory, language=language or self.language, robot=self.robot)

    def planner(
        self, lut: Mapping[str, Sign], robot: Robot | None, language: Language | None = None
    ) -> Planner:
        """Make the planner.

        Args:
            lut: The look-up table.
            robot: For distances between its parts, and to mirror signs; None does neither: enough to see
                whether these settings go together, and whether a sentence can be looked up.
            language: The table's; None for the default language.

        Raises:
            PlanError: They do not ("bad_limits", "bad_period").
            DescriptionError: There is no such robot.
        """
        return Planner(
            MirroredSigns(lut, robot) if self.left_handed and robot is not None else lut,
            limits=MotionLimits.of_robot(
                load_humanoid(self.robot),
                acceleration=self.acceleration,
                jerk=self.jerk,
                hand_drive=self.hand_drive,
            ),
            style=self.style,
            robot=robot,
            least_clearance=self.least_clearance,
            period=self.period,
            max_duration=self.max_duration,
            least_standing=self.least_standing,
            rest_posture=self.rest_posture,
            language=language,
        )


# Time that a sentence's plan is given while its opening is under way [s], and the same for each token: about
# three times the median on two loaded cores. A sentence that is not planned by then begins from a standstill.
_PLANNING_TIME = 0.25
_PLANNING_TIME_OF_TOKEN = 0.03


@dataclass(frozen=True, kw_only=True)
class Ready:
    """The planner is loaded."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Opened:
    """The first motion of a sentence; its plan follows."""

    number: int
    plan: Plan


@dataclass(frozen=True, kw_only=True, eq=False)
class Planned:
    """A plan.

    Attributes:
        number: Of the request.
        plan: The motion.
        after: Time from the start of the opening at which it takes over [s]; 0 without opening.
        took: How long planning took [s].
    """

    number: int
    plan: Plan
    after: float
    took: float


@dataclass(frozen=True, kw_only=True)
class NotPlanned:
    """Why there is no plan: code and sentence of the `PlanError`."""

    number: int
    code: str
    message: str


Answer = Ready | Opened | Planned | NotPlanned


class _Worker:
    """Plans what is asked for, each sentence by the table of its own language."""

    def __init__(self, settings: PlannerSettings) -> None:
        self._robot = Robot.load(settings.robot)
        self._tables: dict[str, Lut] = {}
        self.configure(settings)

    def configure(self, settings: PlannerSettings) -> None:
        """Plan with other settings from now on."""
        self._settings = settings
        self._planners: dict[str, Planner] = {}
        self._planner(settings.language)

    def _planner(self, language: str) -> Planner:
        """The planner of a language; its table is opened when it is first needed."""
        if language not in self._planners:
            if language not in self._tables:
                self._tables[language] = self._settings.table(language)
            table = self._tables[language]
            self._planners[language] = self._settings.planner(table, self._robot, table.language)
        self._tables[language].refresh()  # the node says what is wrong with a table that cannot be read
        return self._planners[language]

    def warm_up(self) -> None:
        """Plan something: the first plan of a process takes several times as long as the next."""
        gloss = next(iter(self._tables[self._settings.language].glosses()), None)
        if gloss is None:
            return
        sentence, rest = Sentence(tokens=(Token(gloss=gloss),)), State.still(self._robot.humanoid.ready)
        wanted = PlanWanted(number=0, sentence=sentence, start=rest, opening=True)
        for _ in self.answers(wanted):
            pass
        # What is loaded stays: no collection is to walk it while somebody waits for a plan.
        gc.collect()
        gc.freeze()

    def answers(self, wanted: PlanWanted | ReturnWanted) -> Iterator[Answer]:
        """Answer a request, as soon as each part of the answer is known."""
        began = time.perf_counter()
        after, start = 0.0, wanted.start
        try:
            if isinstance(wanted, ReturnWanted):
                plan = self._planner(self._settings.language).plan_to_rest(start)
            else:
                planner = self._planner(wanted.sentence.language or self._settings.language)
                opened = _opening(planner, wanted)
                if opened is not None:
                    opening, after = opened
                    yield Opened(number=wanted.number, plan=opening)
                    start = opening.at(after)
                sentence = wanted.sentence
                plan = planner.plan(sentence.tokens, start, form=sentence.form, hold=wanted.hold)
        except (PlanError, LutError) as error:
            yield NotPlanned(number=wanted.number, code=error.code, message=str(error))
            return
        yield Planned(number=wanted.number, plan=plan, after=after, took=time.perf_counter() - began)


def _opening(planner: Planner, wanted: PlanWanted) -> tuple[Plan, float] | None:
    if not wanted.opening:
        return None
    tokens = wanted.sentence.tokens
    lasting = _PLANNING_TIME + _PLANNING_TIME_OF_TOKEN * len(tokens)
    return planner.plan_opening(tokens, wanted.start, lasting=lasting)


def serve(connection: Connection) -> None:
    """Answer what comes, until `None` comes or the other end is closed."""
    worker: _Worker | None = None
    while True:
        try:
            request = connection.recv()
        except EOFError:
            return
        if request is None:
            return
        try:
            if worker is None:
                worker = _Worker(request)
                worker.warm_up()
                connection.send(Ready())
            elif isinstance(request, PlannerSettings):
                worker.configure(request)
            else:
                for answer in worker.answers(request):
                    connection.send(answer)
        except (BrokenPipeError, ConnectionResetError):
            return


def main() -> None:
    """Serve the socket whose descriptor is the argument."""
    try:
        serve(Connection(int(sys.argv[1])))
    except LutError as error:
        sys.exit(f"planner: [{error.code}] {error}")
    finally:
        gc.unfreeze()  # else bindings complain of leaks at the end
