# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Re-arms the robot as soon as it is at rest. Knows no ROS: time and the way to the driver are arguments."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from teo_console.protocol import Answer, Command, Order

Reply = Callable[[Answer], None]

# How long a request is kept [s]: the robot brakes within 0.22 s by the driver's defaults, and the page is
# answered within 3 s.
PATIENCE = 2.0

# With this code the driver refuses to be re-armed before the robot is at rest.
_BRAKING = "moving"


@dataclass(eq=False)
class _Kept:
    """A request that is not answered yet.

    Attributes:
        request: To re-arm.
        reply: Takes the answer.
        until: When it is given up [s].
        refusal: What the driver answered, if it is to be asked again.
    """

    request: Command
    reply: Reply
    until: float
    refusal: Answer | None = None


class Rearming:
    """Keeps a request that comes while the robot brakes, and asks the driver again until it is at rest.

    The driver alone decides: what it publishes of its state may come before or after its refusal. A stop wins
    over every request that came before it.
    """

    def __init__(self, call: Callable[[Command, Reply], None]) -> None:
        """Begin without a request.

        Args:
            call: Has a command carried out and calls back with the answer, once, now or later.
        """
        self._call = call
        self._kept: list[_Kept] = []

    def ask(self, request: Command, reply: Reply, now: float) -> None:
        """Re-arm the robot, at once or as soon as it is at rest; reply when that is done or given up."""
        kept = _Kept(request, reply, now + PATIENCE)
        self._kept.append(kept)
        self._try(kept)

    def step(self, now: float) -> None:
        """Ask again for what was refused while the robot braked."""
        for kept in tuple(self._kept):
            if kept.refusal is not None and now < kept.until:
                self._try(kept)
            elif kept.refusal is not None:
                self._answer(kept, kept.refusal)

    def give_up(self) -> None:
        """The robot is about to be stopped: answer what is kept, and do it no more."""
        sentence = "expected the robot to come to rest, it was told to stop again: call `rearm` once more"
        for kept in tuple(self._kept):
            refused = Answer(id=kept.request.id, success=False, code="stopped_again", message=sentence)
            self._answer(kept, refused)

    def _try(self, kept: _Kept) -> None:
        kept.refusal = None
        self._call(kept.request, lambda answer: self._on_answer(kept, answer))

    def _on_answer(self, kept: _Kept, answer: Answer) -> None:
        if kept not in self._kept:
            # Given up while the driver was asked: it may have stopped the robot before it re-armed it.
            if answer.success:
                self._call(Command(id=kept.request.id, order=Order.STOP), lambda _: None)
        elif answer.code == _BRAKING:
            kept.refusal = answer
        else:
            self._answer(kept, answer)

    def _answer(self, kept: _Kept, answer: Answer) -> None:
        self._kept.remove(kept)
        kept.reply(answer)
