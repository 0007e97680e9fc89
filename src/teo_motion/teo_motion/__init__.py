# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""From signs to motion: composition, timing, collision avoidance and the head, within the robot's limits."""

from teo_motion.planner import Planner, sign_motion
from teo_motion.sentence.plan import HeadGesture, NearestApproach, Plan, TokenTiming
from teo_motion.sentence.sentence_form import STATEMENT, SentenceForm, SentenceType, printed_form
from teo_motion.sentence.signing_style import SigningStyle
from teo_motion.trajectory.driver_points import Samples
from teo_motion.trajectory.joint_motion import JointMotion
from teo_motion.trajectory.limits import MotionLimits
from teo_motion.trajectory.ruckig_segment import State

__all__ = [
    "STATEMENT",
    "HeadGesture",
    "JointMotion",
    "MotionLimits",
    "NearestApproach",
    "Plan",
    "Planner",
    "Samples",
    "SentenceForm",
    "SentenceType",
    "SigningStyle",
    "State",
    "TokenTiming",
    "printed_form",
    "sign_motion",
]
