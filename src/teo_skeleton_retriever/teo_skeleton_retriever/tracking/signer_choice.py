# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The one person whose signing is followed: chosen once, then kept."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Literal

import numpy as np

from teo_skeleton_retriever.arrays import FloatArray
from teo_skeleton_retriever.errors import RetrieverError

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
