# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What goes wrong, and how the streams fare, on `diagnostics` and in the log."""

from __future__ import annotations

import time
from typing import Any

from teo_common.diagnostics import Diagnosis, DiagnosticsPublisher, Level
from teo_skeleton_retriever.node.health import Problem, assess
from teo_skeleton_retriever.node.stream_stats import StreamStats

_SAY_AGAIN = 5.0  # [s] after which a problem that goes on is logged again


class ImageDiagnostics:
    """Publishes the state when asked, and at once when a problem is new. May be used by several threads."""

    def __init__(self, node: Any, stats: StreamStats, topics: dict[str, str]) -> None:
        """Create the publisher.

        Args:
            node: To publish and to log with.
            stats: Of its streams.
            topics: Name of the topic of each stream that must come.
        """
        self._node = node
        self._stats = stats
        self._topics = topics
        self._publisher = DiagnosticsPublisher(node, "images")
        self._problem: Problem | None = None
        self._said: dict[str, float] = {}

    def report(self, problem: Problem, details: str = "") -> None:
        """Note a problem for the next diagnostics; tell it at once unless it was told just now.

        Args:
            problem: Why an image was left out.
            details: For the log, which make it an error.
        """
        self._problem = problem
        now = time.monotonic()
        if now - self._said.get(problem.code, -_SAY_AGAIN) < _SAY_AGAIN:
            return
        self._said[problem.code] = now
        sentence = f"image left out, {problem.code}: {problem.sentence}"
        if details:
            self._node.get_logger().error(f"{sentence}\n{details}")
        else:
            self._node.get_logger().warning(sentence)
        self._publish(problem)

    def publish(self) -> None:
        """Publish the state, with the problem that there was since the last time."""
        problem, self._problem = self._problem, None
        diagnosis = self._publish(problem)
        if diagnosis.level is not Level.OK and problem is None:
            self._node.get_logger().warning(diagnosis.message, throttle_duration_sec=_SAY_AGAIN)

    def _publish(self, problem: Problem | None) -> Diagnosis:
        diagnosis = assess(self._stats.report(time.monotonic()), self._topics, problem)
        self._publisher.publish(diagnosis)
        return diagnosis
