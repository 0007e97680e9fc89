# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A stop wins over every request to re-arm that came before it. Knows no ROS."""

from __future__ import annotations

from collections.abc import Callable

from teo_console.protocol import Answer, Command, Order

Reply = Callable[[Answer], None]


class Rearming:
    """Has the driver re-arm the robot, which it does at rest, unless the robot is stopped meanwhile."""

    def __init__(self, call: Callable[[Command, Reply], None]) -> None:
        """Begin without a request.

        Args:
            call: Has a command carried out and calls back with the answer, once, now or later.
        """
        self._call = call
        self._waiting: dict[object, tuple[Command, Reply]] = {}

    def ask(self, request: Command, reply: Reply) -> None:
        """Re-arm the robot; reply when that is done, refused or given up."""
        key = object()
        self._waiting[key] = request, reply
        self._call(request, lambda answer: self._on_answer(key, request, answer))

    def give_up(self) -> None:
        """The robot is about to be stopped: answer what waits."""
        sentence = "expected the robot to come to rest, it was told to stop again: call `rearm` once more"
        for request, reply in self._waiting.values():
            reply(Answer(id=request.id, success=False, code="stopped_again", message=sentence))
        self._waiting.clear()

    def _on_answer(self, key: object, request: Command, answer: Answer) -> None:
        waiting = self._waiting.pop(key, None)
        if waiting is not None:
            waiting[1](answer)
        elif answer.success:  # the driver may have had the stop before the request
            self._call(Command(id=request.id, order=Order.STOP), lambda _: None)
