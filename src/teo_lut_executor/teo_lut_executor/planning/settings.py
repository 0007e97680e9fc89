# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What a planner is made of, as it travels to the process that plans."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from teo_description.humanoid import DEFAULT_ROBOT, load_humanoid
from teo_description.robot import Robot
from teo_motion.planner import DEFAULT_CLEARANCE, DEFAULT_MAX_DURATION, DEFAULT_PERIOD, Planner
from teo_motion.sentence.signing_style import DEFAULT_REST, RestPosture, SigningStyle
from teo_motion.trajectory.limits import DEFAULT_ACCELERATION, DEFAULT_JERK, MotionLimits
from teo_sign_languages import DEFAULT_LANGUAGE, Language
from teo_signs.lexicon import DEFAULT_STANDING
from teo_signs.look_up_table import Lut
from teo_signs.mirroring import MirroredSigns
from teo_signs.sign import Sign
from teo_signs.sign_schema import Standing


@dataclass(frozen=True, kw_only=True)
class PlannerSettings:
    """See `Planner` for the meaning of each.

    Attributes:
        robot: Name of the robot.
        language: Code of the sign language that is signed where a sentence names none.
        lut_directory: Of the look-up table; None for the user's own and the language's.
        left_handed: Whether signs are mirrored.
        acceleration: Greatest of every joint [rad/s^2].
        jerk: Greatest of every joint [rad/s^3].
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
