# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Who is who from image to image, through crossings and gaps, and who of them is the signer."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import linear_sum_assignment

from teo_skeleton_retriever.arrays import FloatArray, frozen
from teo_skeleton_retriever.errors import RetrieverError

# [m] How far from where a person is expected they may be seen: half the width of two people side by side, and
# more than a torso's depth errs.
_GATE = 0.4
_GATE_GROWTH = 0.8  # [m/s] while a person is not seen: a brisk walk's surprise
_MAX_GATE = 1.2  # [m]
_MEMORY = 3.0  # [s] for which a person who is not seen keeps their id: someone crossing in front takes one
_VELOCITY_TIME = 0.3  # [s] over which the velocity is averaged; shorter follows turns, longer noise
_VELOCITY_MEMORY = 0.7  # [s] after which a person who is not seen is no longer thought to walk on
_NEWCOMER_TIME = 1.0  # [s] within which a newcomer must be seen in enough images
# [m] Two people are no nearer to each other than half a chest's breadth. A detection that seems to be is
# somebody seen twice, or somebody of whom only who hides them is measured.
_APART = 0.2


@dataclass(frozen=True, eq=False)
class TrackedPerson:
    """What is known of where a person is.

    Attributes:
        person_id: Never given to another.
        position: Of the torso when last seen [m]. Shape (3,).
        velocity: Then [m/s]. Shape (3,).
        last_seen: [s].
        images: In which the person was seen.
        first_seen: [s].
    """

    person_id: int
    position: FloatArray
    velocity: FloatArray
    last_seen: float
    images: int
    first_seen: float

    def expected(self, time: float) -> FloatArray:
        """Where the person should be at a time [m]. Shape (3,)."""
        walked: FloatArray = self.position + self.velocity * min(time - self.last_seen, _VELOCITY_MEMORY)
        return walked


class PersonTracker:
    """Assigns detections to people so that the distances to where they were expected are least in all.

    In space, not in the image: who crosses in front of someone is a metre nearer. A person walks on at their
    velocity while they are hidden, and is looked for in a growing ball.
    """

    def __init__(self, newcomer_images: int = 3, *, recorded: bool = False) -> None:
        """Know nobody yet.

        Args:
            newcomer_images: Before an id is given; with fewer flickers of the detector become people.
            recorded: Whether who is in the first image of all gets one at once: recordings begin with whom
                they are of.
        """
        self._newcomer_images = newcomer_images
        self._recorded = recorded
        self._people: dict[int, TrackedPerson] = {}
        self._newcomers: list[TrackedPerson] = []
        self._next_id = 0
        self._time = -math.inf

    @property
    def people(self) -> dict[int, TrackedPerson]:
        """Everybody remembered, by id."""
        return dict(self._people)

    def step(self, time: float, positions: Sequence[FloatArray]) -> list[int | None]:
        """Take one image.

        Args:
            time: Of the image [s]. One before the last forgets everybody (ids are still not given again):
                a bag was set back.
            positions: Of the torso of each detection [m]; not finite where its depth is not known, which is
                nobody. Shape (3,) each, or (k, 3) where it may be in several places, the likeliest first.

        Returns:
            The id of each detection, None while it is nobody or a newcomer on trial.

        Raises:
            RetrieverError: The time is not finite.
        """
        if not math.isfinite(time):
            raise RetrieverError("bad_time", f"expected a finite time [s], got {time}")
        needed = 1 if self._recorded and self._time == -math.inf else self._newcomer_images
        if time < self._time:
            self._people, self._newcomers = {}, []
        self._time = time
        self._forget(time)
        ids: list[int | None] = [None] * len(positions)
        seen = {
            i: np.atleast_2d(np.asarray(p, dtype=np.float64))
            for i, p in enumerate(positions)
            if np.isfinite(p).all()
        }
        for i, person in self._match(time, seen, list(self._people.values())):
            ids[i] = person.person_id
            self._people[person.person_id] = self._moved(person, time, seen.pop(i))
        trials = dict(self._match(time, seen, self._newcomers))
        self._newcomers = [person for person in self._newcomers if person not in trials.values()]
        for i, places in seen.items():
            if i not in trials and self._taken(time, places[0]):
                continue
            newcomer = self._moved(trials[i], time, places) if i in trials else _newcomer(time, places[0])
            ids[i] = self._admit(newcomer, needed)
        return ids

    def _forget(self, time: float) -> None:
        self._people = {
            person_id: person
            for person_id, person in self._people.items()
            if time - person.last_seen <= _MEMORY
        }
        self._newcomers = [person for person in self._newcomers if time - person.first_seen <= _NEWCOMER_TIME]

    def _match(
        self, time: float, seen: dict[int, FloatArray], people: list[TrackedPerson]
    ) -> list[tuple[int, TrackedPerson]]:
        """Pair detections with people: as many as the gates allow, at the least sum of squared distances."""
        if not seen or not people:
            return []
        rows = list(seen)
        expected = np.array([person.expected(time) for person in people])
        distances = np.array(
            [np.linalg.norm(places[:, None] - expected[None], axis=2).min(axis=0) for places in seen.values()]
        )
        hidden = np.array([time - person.last_seen for person in people])
        gates = np.minimum(_GATE + _GATE_GROWTH * hidden, _MAX_GATE)
        # Beyond its gate a pair costs more than all pairs within theirs together, so it is the last resort.
        beyond = len(rows) * len(people) * _MAX_GATE**2 + 1.0
        cost = np.where(distances <= gates, distances**2, beyond)
        pairs = zip(*linear_sum_assignment(cost), strict=True)
        return [(rows[i], people[k]) for i, k in pairs if distances[i, k] <= gates[k]]

    def _taken(self, time: float, place: FloatArray) -> bool:
        """Whether a person who is seen at this time is at this position."""
        return any(
            person.last_seen == time and float(np.linalg.norm(place - person.position)) < _APART
            for person in self._people.values()
        )

    def _moved(self, person: TrackedPerson, time: float, places: FloatArray) -> TrackedPerson:
        expected = person.expected(time)
        position = places[int(np.argmin(np.linalg.norm(places - expected, axis=1)))]
        elapsed = time - person.last_seen
        velocity = person.velocity
        if elapsed > 0.0:
            share = 1.0 - math.exp(-elapsed / _VELOCITY_TIME)
            velocity = velocity + share * ((position - person.position) / elapsed - velocity)
        return replace(
            person,
            position=frozen(position),
            velocity=frozen(velocity),
            last_seen=time,
            images=person.images + 1,
        )

    def _admit(self, newcomer: TrackedPerson, needed: int) -> int | None:
        if newcomer.images < needed:
            self._newcomers.append(newcomer)
            return None
        person_id = self._next_id
        self._next_id += 1
        self._people[person_id] = replace(newcomer, person_id=person_id)
        return person_id


def _newcomer(time: float, position: FloatArray) -> TrackedPerson:
    return TrackedPerson(-1, frozen(position), frozen(np.zeros(3)), time, 1, time)


class SignerChoice:
    """Who signs. A signer stays the signer while seen, however near others come; a locked one always does."""

    def __init__(self, rule: str, patience: float) -> None:
        """Choose by a rule.

        Args:
            rule: "nearest" to the camera, or "central": closest to its optical axis, by angle.
            patience: How long a signer who is not seen is waited for [s].
        """
        self._rule = rule
        self._patience = patience
        self._signer: int | None = None
        self._last_seen = -math.inf
        self._locked = False

    @property
    def signer(self) -> int | None:
        """Id of the signer, seen or waited for; None if there is none."""
        return self._signer

    def lock(self, person_id: int | None) -> None:
        """Follow this person and nobody else, whether or not they are seen.

        None chooses by the rule again once the present signer leaves.
        """
        self._signer = self._signer if person_id is None else person_id
        self._locked = person_id is not None

    def step(self, time: float, seen: Mapping[int, FloatArray]) -> int | None:
        """Take one image.

        Args:
            time: Of the image [s]; one before the last starts the waiting anew.
            seen: Position of each person who is seen, by id [m]. Shape (3,) each.

        Returns:
            The signer's id if the signer is seen, else None.
        """
        if self._signer in seen:
            self._last_seen = time
            return self._signer
        self._last_seen = min(self._last_seen, time)
        if self._locked or (self._signer is not None and time - self._last_seen <= self._patience):
            return None
        self._signer = min(seen, key=lambda person_id: self._rank(seen[person_id]), default=None)
        self._last_seen = time
        return self._signer

    def _rank(self, position: FloatArray) -> float:
        if self._rule == "nearest":
            return float(np.linalg.norm(position))
        return math.atan2(math.hypot(float(position[0]), float(position[1])), float(position[2]))
