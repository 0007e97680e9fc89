# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Requests of pages: re-arming is given up when the robot is stopped again; refusals have their reason."""

from __future__ import annotations

import pytest
from std_srvs.srv import Trigger

from teo_console.node.messages import to_answer
from teo_console.node.robot_client import Rearming, Reply
from teo_console.protocol import Answer, Command, Order

REARM = Command(id=7, order=Order.REARM)
SWITCH = Answer(id=7, success=False, code="limit_switch", message="pressed")
DONE = Answer(id=7, success=True)


class Driver:
    """Takes commands, and answers when the test says so."""

    def __init__(self) -> None:
        self.asked: list[tuple[Order, Reply]] = []

    def call(self, command: Command, reply: Reply) -> None:
        self.asked.append((command.order, reply))

    @property
    def orders(self) -> list[Order]:
        return [order for order, _ in self.asked]

    def answer(self, answer: Answer) -> None:
        self.asked[-1][1](answer)


@pytest.fixture
def driver() -> Driver:
    return Driver()


@pytest.fixture
def rearming(driver: Driver) -> Rearming:
    return Rearming(driver.call)


@pytest.mark.parametrize("answer", [DONE, SWITCH])
def test_a_robot_at_rest_is_asked_once_and_its_answer_passed_on(
    driver: Driver, rearming: Rearming, answer: Answer
) -> None:
    told: list[Answer] = []
    rearming.ask(REARM, told.append)
    driver.answer(answer)
    assert (driver.orders, told) == ([Order.REARM], [answer])


def test_a_robot_that_was_rearmed_although_a_stop_came_is_stopped_again(
    driver: Driver, rearming: Rearming
) -> None:
    told: list[Answer] = []
    rearming.ask(REARM, told.append)
    rearming.give_up()
    driver.answer(DONE)  # the driver had the stop first
    assert driver.orders == [Order.REARM, Order.STOP]
    assert [answer.code for answer in told] == ["stopped_again"]


def test_two_pages_are_both_answered(driver: Driver, rearming: Rearming) -> None:
    told: list[Answer] = []
    for _ in range(2):
        rearming.ask(REARM, told.append)
    for _, reply in driver.asked:
        reply(DONE)
    assert told == [DONE, DONE]


@pytest.mark.parametrize(
    ("success", "said", "code", "sentence"),
    [
        (False, "moving: at rest in 0.19 s: call again then", "moving", "at rest in 0.19 s: call again then"),
        (False, "it does not say why", "not_done", "it does not say why"),
        (False, "Two words: not a code", "not_done", "Two words: not a code"),
        (False, "", "not_done", ""),
        (True, "stopped: at rest", "", "stopped: at rest"),
    ],
)
def test_a_service_that_refuses_says_why_by_a_code_where_it_has_one(
    success: bool, said: str, code: str, sentence: str
) -> None:
    answer = to_answer(7, Trigger.Response(success=success, message=said))
    assert answer == Answer(id=7, success=success, code=code, message=sentence)
