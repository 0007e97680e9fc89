# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Who is who from image to image, through crossings and gaps, and who of them is the signer."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from scipy.optimize import linear_sum_assignment

from teo_skeleton_retriever.arrays import FloatArray, frozen
from teo_skeleton_retriever.errors import RetrieverError


@dataclass(frozen=True, kw_only=True)
class TrackerSettings:
    """How people are followed.

    Attributes:
        gate: How far from where a person is expected they may be seen [m]: half the width of two people
            side by side, and more than a torso's depth errs.
        gate_growth: By how much the gate grows while a person is not seen [m/s]: a brisk walk's surprise.
        max_gate: And no further than this [m].
        memory: How long a person who is not seen keeps their id [s]: someone crossing in front takes one.
        velocity_time: Over how long the velocity is averaged [s]; shorter follows turns, longer noise.
        velocity_memory: After how long without being seen a person is no longer thought to walk on [s].
        newcomer_images: Images in which someone must be seen to get an id; fewer let flickers of the
            detector become people.
        newcomer_time: Within this time [s].
        apart: Two people are no nearer to each other than this [m]: half a chest's breadth. A detection that
            seems to be nearer is somebody seen twice, or somebody of whom only who hides them is measured.
    """

    gate: float = 0.4
    gate_growth: float = 0.8
    max_gate: float = 1.2
    memory: float = 3.0
    velocity_time: float = 0.3
    velocity_memory: float = 0.7
    newcomer_images: int = 3
    newcomer_time: float = 1.0
    apart: float = 0.2

    def __post_init__(self) -> None:
        positive = (
            self.gate,
            self.memory,
            self.velocity_time,
            self.velocity_memory,
            self.newcomer_time,
            self.apart,
        )
        if not all(math.isfinite(value) and value > 0.0 for value in positive):
            raise RetrieverError("bad_settings", f"expected finite times and lengths above 0, got {positive}")
        if not (0.0 <= self.gate_growth < math.inf and self.gate <= self.max_gate < math.inf):
            raise RetrieverError("bad_settings", "expected gate_growth >= 0 and gate <= max_gate")
        if self.newcomer_images < 1:
            raise RetrieverError("bad_settings", f"expected newcomer_images >= 1, got {self.newcomer_images}")


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

    def expected(self, time: float, velocity_memory: float) -> FloatArray:
        """Where the person should be at a time [m]. Shape (3,)."""
        walked: FloatArray = self.position + self.velocity * min(time - self.last_seen, velocity_memory)
        return walked


class PersonTracker:
    """Assigns detections to people so that the distances to where they were expected are least in all.

    In space, not in the image: who crosses in front of someone is a metre nearer. A person walks on at their
    velocity while they are hidden, and is looked for in a growing ball.
    """

    def __init__(self, settings: TrackerSettings | None = None) -> None:
        self._settings = settings or TrackerSettings()
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
            ids[i] = self._admit(newcomer)
        return ids

    def _forget(self, time: float) -> None:
        self._people = {
            person_id: person
            for person_id, person in self._people.items()
            if time - person.last_seen <= self._settings.memory
        }
        self._newcomers = [
            person for person in self._newcomers if time - person.first_seen <= self._settings.newcomer_time
        ]

    def _match(
        self, time: float, seen: dict[int, FloatArray], people: list[TrackedPerson]
    ) -> list[tuple[int, TrackedPerson]]:
        """Pair detections with people: as many as the gates allow, at the least sum of squared distances."""
        if not seen or not people:
            return []
        rows = list(seen)
        expected = np.array([person.expected(time, self._settings.velocity_memory) for person in people])
        distances = np.array(
            [np.linalg.norm(places[:, None] - expected[None], axis=2).min(axis=0) for places in seen.values()]
        )
        hidden = np.array([time - person.last_seen for person in people])
        gates = np.minimum(self._settings.gate + self._settings.gate_growth * hidden, self._settings.max_gate)
        # Beyond its gate a pair costs more than all pairs within theirs together, so it is the last resort.
        beyond = len(rows) * len(people) * self._settings.max_gate**2 + 1.0
        cost = np.where(distances <= gates, distances**2, beyond)
        pairs = zip(*linear_sum_assignment(cost), strict=True)
        return [(rows[i], people[k]) for i, k in pairs if distances[i, k] <= gates[k]]

    def _taken(self, time: float, place: FloatArray) -> bool:
        """Whether a person who is seen at this time is at this position."""
        return any(
            person.last_seen == time and float(np.linalg.norm(place - person.position)) < self._settings.apart
            for person in self._people.values()
        )

    def _moved(self, person: TrackedPerson, time: float, places: FloatArray) -> TrackedPerson:
        expected = person.expected(time, self._settings.velocity_memory)
        position = places[int(np.argmin(np.linalg.norm(places - expected, axis=1)))]
        elapsed = time - person.last_seen
        velocity = person.velocity
        if elapsed > 0.0:
            share = 1.0 - math.exp(-elapsed / self._settings.velocity_time)
            velocity = velocity + share * ((position - person.position) / elapsed - velocity)
        return replace(
            person,
            position=frozen(position),
            velocity=frozen(velocity),
            last_seen=time,
            images=person.images + 1,
        )

    def _admit(self, newcomer: TrackedPerson) -> int | None:
        if newcomer.images < self._settings.newcomer_images:
            self._newcomers.append(newcomer)
            return None
        person_id = self._next_id
        self._next_id += 1
        self._people[person_id] = replace(newcomer, person_id=person_id)
        return person_id


def _newcomer(time: float, position: FloatArray) -> TrackedPerson:
    return TrackedPerson(-1, frozen(position), frozen(np.zeros(3)), time, 1, time)


# [s] How long a signer who is not seen stays the signer: as long as their id is remembered.
_DEFAULT_PATIENCE = 3.0

Rule = Literal["nearest", "central"]


class SignerChoice:
    """Who signs. A signer stays the signer while seen, however near others come; a locked one always does."""

    def __init__(self, rule: Rule = "nearest", patience: float = _DEFAULT_PATIENCE) -> None:
        """Choose by a rule.

        Args:
            rule: "nearest" to the camera, or "central": closest to its optical axis, by angle.
            patience: How long a signer who is not seen is waited for [s].

        Raises:
            RetrieverError: The rule is not known or the patience is not a time.
        """
        if rule not in ("nearest", "central"):
            raise RetrieverError("unknown_rule", f"expected 'nearest' or 'central', got {rule!r}")
        if not 0.0 <= patience < math.inf:
            raise RetrieverError("bad_settings", f"expected a patience of 0 s or more, got {patience}")
        self._rule = rule
        self._patience = patience
        self._signer: int | None = None
        self._last_seen = -math.inf
        self._locked = False

    @property
    def signer(self) -> int | None:
        """Id of the signer, seen or waited for; None if there is none."""
        return self._signer

    @property
    def locked(self) -> bool:
        """Whether somebody asked for this signer."""
        return self._locked

    def lock(self, person_id: int) -> None:
        """Follow this person and nobody else, whether or not they are seen."""
        self._signer, self._locked = person_id, True

    def unlock(self) -> None:
        """Choose by the rule again once the present signer leaves."""
        self._locked = False

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
