# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A score, or postures in space, as a sign of a robot's arms, hands and head that touches nothing."""

from __future__ import annotations

import datetime
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from teo_common.arrays import Array
from teo_description.clearance import Clearance
from teo_description.humanoid import SIDES, Humanoid, Side
from teo_description.robot import Robot
from teo_sign_authoring.notation.posture_knots import ArmCandidate, ArmSolver, ScoreKnots, cheapest_sequence
from teo_sign_authoring.notation.score_file import inflected_scores
from teo_sign_authoring.notation.score_schema import Hands, Score
from teo_sign_authoring.notation.targets import HandTarget, Posture, postures
from teo_sign_capture.retarget.arm_kinematics import (
    ArmKinematics,
    Bounds,
    arm_bounds,
    mirrored,
    mirrored_hand,
)
from teo_sign_capture.retarget.knots import clearance_mm, least_clearance, limit_margin_deg
from teo_sign_capture.signing_space import MIRROR
from teo_sign_languages import DEFAULT_LANGUAGE
from teo_signs.errors import LutError
from teo_signs.sign import Form, Sign
from teo_signs.sign_schema import Provenance

# [m] Least distance of parts of the robot in a sign: a touch is shown by a gap that nobody sees, and that the
# planner's curves between the knots (0.02 rad, a centimetre at the hand) do not close.
_CLEARANCE = 0.012
# [m] Step by which a hand is moved off what it would go into, and how many: the shapes of TEO's hand reach 8
# cm beyond the middle of its palm.
_PUSH, _MOST_PUSHES = 0.012, 12
# What an arm that touches the body or the other arm costs: as much as a palm that is turned by 60 deg.
_TOUCH = 0.5
# [rad] How far elbows are opened to lead hands round what is in their way: 5, 11, 16 cm off the body.
_OPENED_ELBOWS = np.radians([10.0, 20.0, 30.0])
# [rad] How far upper arms are lifted aside: hands part by 5, 10, 15 cm.
_LIFTED_ARMS = np.radians([0.0, 8.0, 16.0, 24.0])

_OUT = np.array([0.0, -1.0, 0.0])


@dataclass(frozen=True, kw_only=True)
class PostureMotion:
    """How a robot makes postures, and how far it falls short.

    Attributes:
        joints: That it moves.
        times: Of the knots [s]. Shape (n,).
        knots: Positions [rad]. Shape (n, joints).
        place_error: Largest distance of a hand from its place [m].
        palm_error: Largest angle between a palm and the way it should face [rad].
        finger_error: The same of the way the fingers point [rad].
    """

    joints: tuple[str, ...]
    times: Array
    knots: Array
    place_error: float
    palm_error: float
    finger_error: float

    def on(self, humanoid: Humanoid, joints: tuple[str, ...]) -> Array:
        """The knots on the joints of the citation form, at home where this form moves none [rad]."""
        home = np.array([humanoid.home[joint] for joint in joints])
        rows = np.tile(home, (len(self.knots), 1))
        rows[:, [joints.index(joint) for joint in self.joints]] = self.knots
        return rows


def posture_motion(robot: Robot, gloss: str, hands: Hands, moments: list[Posture]) -> PostureMotion:
    """Find the motion of the hands that take part, through moments in order of time; errors name the gloss.

    Raises:
        LutError: "self_collision" if the robot cannot make it without touching itself.
    """
    performance = _Performance(robot, gloss, hands, moments)
    rights, lefts = performance.solve()
    joints, knots = performance.knots.of(hands, moments, rights, lefts)
    times = np.array([moment.time for moment in moments])
    times, knots = performance.round_obstacles(joints, times, knots)
    reached = (*rights, *lefts)
    return PostureMotion(
        joints=joints,
        times=times,
        knots=knots,
        place_error=max(performance.place_errors(rights, lefts)),
        palm_error=max(candidate.palm_error for candidate in reached),
        finger_error=max(candidate.finger_error for candidate in reached),
    )


def posture_figures(robot: Robot, motions: Sequence[PostureMotion]) -> dict[str, float]:
    """What an entry says of motions: the worst of each."""
    humanoid = robot.humanoid
    return {
        "place_error_mm": round(1000.0 * max(motion.place_error for motion in motions), 1),
        "palm_angle_error_deg": round(float(np.degrees(max(motion.palm_error for motion in motions))), 1),
        "finger_angle_error_deg": round(float(np.degrees(max(motion.finger_error for motion in motions))), 1),
        "clearance_mm": min(clearance_mm(robot, motion.joints, motion.knots) for motion in motions),
        "limit_margin_deg": min(
            limit_margin_deg(humanoid, motion.joints, motion.knots) for motion in motions
        ),
    }


class _Performance:
    """Arms for all moments, moved off what they would go into."""

    def __init__(self, robot: Robot, gloss: str, hands: Hands, moments: list[Posture]) -> None:
        self._robot, self._humanoid = robot, robot.humanoid
        self._gloss, self._hands, self._moments = gloss, hands, moments
        self._chain = ArmKinematics(robot)
        self._solver = ArmSolver(robot, self._chain)
        self.knots = ScoreKnots(robot, self._chain)
        self._known: dict[tuple[object, ...], list[ArmCandidate]] = {}
        self._left_bounds = arm_bounds(self._humanoid, "left")
        self._right_bounds = arm_bounds(self._humanoid, "both" if hands == "mirrored" else "right")

    def solve(self) -> tuple[list[ArmCandidate], list[ArmCandidate]]:
        """Right and left arms for every moment; the left ones are empty where the left arm takes no part.

        Raises:
            LutError: "self_collision".
        """
        # How far each moment's hands are moved off the body, and off each other [m].
        pushes = np.zeros((len(self._moments), 2))
        for _ in range(_MOST_PUSHES + 1):
            rights, lefts = self._arms(pushes)
            joints, knots = self.knots.of(self._hands, self._moments, rights, lefts)
            near = [self.clearance(joints, row) for row in knots]
            touching = [index for index, found in enumerate(near) if found.distance < _CLEARANCE]
            if not touching:
                return rights, lefts
            for index in touching:
                both = all(
                    any(self._robot.carried_by(link, self._humanoid.arm(side)) for link in near[index][1:3])
                    for side in SIDES
                )
                pushes[index, int(both)] += _PUSH
            # While a joint wiggles the hand keeps its place.
            for index in range(1, len(pushes)):
                if (
                    self._moments[index].swings
                    and self._moments[index].right is self._moments[index - 1].right
                ):
                    pushes[index - 1 : index + 1] = pushes[index - 1 : index + 1].max(axis=0)
        found, moment = near[touching[0]], self._moments[touching[0]]
        raise LutError(
            "self_collision",
            f"{self._gloss}: expected a posture that {self._humanoid.name} can take at {moment.time:.2f} s, "
            f"got one in which {found.first} touches {found.second} even {100 * pushes.max():.0f} cm off its "
            "place: move the place",
        )

    def place_errors(self, rights: list[ArmCandidate], lefts: list[ArmCandidate]) -> list[float]:
        """How far the parts of the hands are from their places, moved off or not [m]."""
        wanted: list[tuple[HandTarget, ArmCandidate]] = []
        for index, (moment, right) in enumerate(zip(self._moments, rights, strict=True)):
            target = moment.right
            if lefts and moment.left is not None:
                target = self._resolved(target, moment.left, lefts[index])
                wanted.append((moment.left, lefts[index]))
            wanted.append((target, right))
        return [self._solver.distance(target, candidate.positions) for target, candidate in wanted]

    def clearance(self, joints: tuple[str, ...], row: Array) -> Clearance:
        """Smallest distance between parts of the robot in a pose."""
        pose = dict(zip(joints, row.tolist(), strict=True))
        return self._robot.clearance(self._robot.configuration(pose))

    def _arms(self, pushes: Array) -> tuple[list[ArmCandidate], list[ArmCandidate]]:
        if self._hands != "both":
            targets = [
                _pushed(moment.right, push) for moment, push in zip(self._moments, pushes, strict=True)
            ]
            rights = cheapest_sequence(self._candidates(targets, self._right_bounds, "right"))
            return rights, []
        left_targets = [moment.left for moment in self._moments if moment.left is not None]
        # Where the right hand is on the left one, the right hand gives way.
        stays = [bool(moment.right.other) for moment in self._moments]
        left_targets = [
            target if stay else _pushed(target, push)
            for target, stay, push in zip(left_targets, stays, pushes, strict=True)
        ]
        lefts = cheapest_sequence(self._candidates(left_targets, self._left_bounds, "left"))
        targets = [
            _pushed(self._resolved(moment.right, left, candidate), push)
            for moment, left, candidate, push in zip(self._moments, left_targets, lefts, pushes, strict=True)
        ]
        choices = [
            self._beside(target, candidates, moment, left)
            for target, candidates, moment, left in zip(
                targets,
                self._candidates(targets, self._right_bounds, "right"),
                self._moments,
                lefts,
                strict=True,
            )
        ]
        return cheapest_sequence(choices), lefts

    def _resolved(self, right: HandTarget, left: HandTarget, candidate: ArmCandidate) -> HandTarget:
        """A target on the left hand, in ``base_link``; away from the left palm is its way out."""
        if not right.other:
            return right
        point = MIRROR * self._solver.hand_point(candidate.positions, left, right.other)
        wanted = point + right.point
        away = wanted - MIRROR * self._solver.palm(candidate.positions)[1]
        # The hand comes from where its own palm does not look.
        outward = away / max(float(np.linalg.norm(away)), 1e-6) - right.palm
        return replace(right, point=wanted, outward=outward / max(float(np.linalg.norm(outward)), 1e-6))

    def _candidates(self, targets: list[HandTarget], bounds: Bounds, side: Side) -> list[list[ArmCandidate]]:
        """Arms for each target; those that were sought before are known."""
        keys = [_key(target, side) for target in targets]
        new = {key: target for key, target in zip(keys, targets, strict=True) if key not in self._known}
        if new:
            found = self._solver.candidates(list(new.values()), bounds)
            for (key, target), candidates in zip(new.items(), found, strict=True):
                self._known[key] = [
                    replace(candidate, cost=candidate.cost + self._touch(target, candidate, side))
                    for candidate in candidates
                ]
        return [self._known[key] for key in keys]

    def _beside(
        self, target: HandTarget, candidates: list[ArmCandidate], moment: Posture, left: ArmCandidate
    ) -> list[ArmCandidate]:
        """Right arms, those that touch the left one at a higher cost."""
        assert moment.left is not None
        other = self._as_left(left.positions, moment.left.shape)
        joints = self._limb("right") + self._limb("left")
        return [
            replace(candidate, cost=candidate.cost + _TOUCH)
            if self.clearance(joints, np.concatenate([candidate.positions, target.shape, other])).distance
            < _CLEARANCE
            else candidate
            for candidate in candidates
        ]

    def _touch(self, target: HandTarget, candidate: ArmCandidate, side: Side) -> float:
        """What it costs that an arm, the other at rest, touches the body."""
        arm, hand = candidate.positions, target.shape
        limb = self._as_left(arm, hand) if side == "left" else np.concatenate([arm, hand])
        return _TOUCH if self.clearance(self._limb(side), limb).distance < _CLEARANCE else 0.0

    def _limb(self, side: Side) -> tuple[str, ...]:
        return self._humanoid.arm(side) + self._humanoid.hand(side)

    def _as_left(self, arm: Array, hand: Array) -> Array:
        """Joints of a left arm and hand that are seen as right ones."""
        return np.concatenate([mirrored(self._humanoid, arm), mirrored_hand(self._humanoid, hand)])

    def round_obstacles(self, joints: tuple[str, ...], times: Array, knots: Array) -> tuple[Array, Array]:
        """Leave out moments without time, and add a knot where the straight way between two would touch.

        Raises:
            LutError: "self_collision" where no way round is found.
        """
        kept_times, kept = [float(times[0])], [knots[0]]
        for (start, first), (end, second) in pairwise(zip(times, knots, strict=True)):
            if end <= start:
                continue
            if least_clearance(self._robot, joints, [first, second]) < _CLEARANCE / 2.0:
                middle = self._way_round(joints, first, second, float(start))
                kept.append(self.knots.with_clear_thumbs(joints, middle))
                kept_times.append(float(start + end) / 2.0)
            kept.append(second)
            kept_times.append(float(end))
        return np.array(kept_times), np.array(kept)

    def _way_round(self, joints: tuple[str, ...], first: Array, second: Array, start: float) -> Array:
        """Half-way between two knots: elbows opened, arms aside until nothing touches, or one arm first."""
        limits = self._humanoid.limits(joints)
        opening, aside = np.zeros(len(joints)), np.zeros(len(joints))
        right = {self._humanoid.arm("right")[self._chain.elbow]: self._chain.opens}
        for direction, shares in ((opening, right), (aside, self._humanoid.file.detour.sideways)):
            for joint, share in shares.items():
                other, sign = self._humanoid.mirrored_name(joint), self._humanoid.mirror_signs((joint,))[0]
                for name, turn in ((joint, share), (other, sign * share)):
                    if name in joints:
                        direction[joints.index(name)] = turn
        left = np.array([joint in self._limb("left") for joint in joints])
        middle: Array
        together = [
            np.clip((first + second) / 2.0 + opened * opening + lifted * aside, limits.lower, limits.upper)
            for lifted in _LIFTED_ARMS
            for opened in (0.0, *_OPENED_ELBOWS)
        ]
        for middle in (*together[1:], np.where(left, first, second), np.where(left, second, first)):
            if least_clearance(self._robot, joints, [first, middle, second]) >= _CLEARANCE / 2.0:
                return middle
        raise LutError(
            "self_collision",
            f"{self._gloss}: expected a way that {self._humanoid.name} can go from {start:.2f} s on, got one "
            "that touches: add a step that leads round",
        )


def _key(target: HandTarget, side: str) -> tuple[object, ...]:
    arrays = (target.shape, target.point, target.palm, target.fingers)
    return (side, target.part, target.meets, *(np.round(array, 6).tobytes() for array in arrays))


def _pushed(target: HandTarget, push: Array) -> HandTarget:
    """A target off the body, and off the other hand: out to its own side, or away from what it is on."""
    if not push.any():
        return target
    aside = target.outward if target.other else _OUT
    return replace(target, point=target.point + push[0] * target.outward + push[1] * aside)


def score_sign(robot: Robot, score: Score, *, language: str = DEFAULT_LANGUAGE) -> Sign:
    """Bring a score, a sign of the language of a code, onto a robot.

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
