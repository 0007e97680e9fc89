# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A score as a sign of a robot's arms, hands and head."""

from __future__ import annotations

import datetime

from teo_description.robot import Robot
from teo_sign_authoring.notation.inflection import inflected_scores
from teo_sign_authoring.notation.posture_motion import PostureMotion, posture_figures, posture_motion
from teo_sign_authoring.notation.score_schema import Score
from teo_sign_authoring.notation.targets import postures
from teo_sign_languages import DEFAULT_LANGUAGE
from teo_signs.sign import Form, Sign
from teo_signs.sign_schema import Provenance


def score_sign(robot: Robot, score: Score, *, language: str = DEFAULT_LANGUAGE) -> Sign:
    """Bring a score onto a robot.

    Args:
        robot: The robot.
        score: The sign.
        language: Code of the sign language whose sign it is.

    Raises:
        LutError: "self_collision" if it cannot make the sign without touching itself.
    """
    citation = _motion(robot, score)
    inflected = {inflection: _motion(robot, form) for inflection, form in inflected_scores(score).items()}
    joints = citation.joints
    every = (citation, *inflected.values())
    return Sign(
        gloss=score.gloss,
        language=language,
        robot=robot.humanoid.name,
        kind=score.kind,
        handedness="right" if score.hands == "right" else "both",
        joints=joints,
        times=citation.times,
        knots=citation.knots,
        forms={
            inflection: Form(times=motion.times, knots=motion.on(robot.humanoid, joints))
            for inflection, motion in inflected.items()
        },
        provenance=_provenance(robot, score),
        # The worst of all forms.
        quality=posture_figures(robot, every),
    )


def _motion(robot: Robot, score: Score) -> PostureMotion:
    return posture_motion(robot, score.gloss, score.hands, postures(robot, score))


def _provenance(robot: Robot, score: Score) -> Provenance:
    notes = [f"Face: {score.face}." if score.face else "", score.notes]
    return Provenance(
        standing=score.standing,
        source=score.source,
        method="written as a score; arms by bounded least squares, hands from the inventory (capture_scores)",
        recorded=None,
        created=datetime.date.today().isoformat(),
        licence="Apache-2.0 (the score; its source is named)",
        description_hash=robot.humanoid.description_hash,
        notes=" ".join(filter(None, notes)),
    )
