# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Carries out what pages ask for: publishes, and calls the services of executor and driver."""

from __future__ import annotations

import uuid
from collections.abc import Callable
from typing import Any

from control_msgs.msg import SpeedScalingFactor
from rcl_interfaces.srv import SetParameters
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.task import Future
from std_msgs.msg import String
from std_srvs.srv import Trigger
from teo_sign_msgs.msg import SignSentence, SignToken
from teo_sign_msgs.srv import GetSign, ListQueue

from teo_console.errors import ConsoleError
from teo_console.node import messages
from teo_console.protocol import (
    Answer,
    Command,
    ConfirmSpoken,
    DiscardSpoken,
    FetchSign,
    FromPage,
    Order,
    SetLanguage,
    SetSpeed,
    SignGlosses,
    SignText,
)
from teo_console.situation import SharedSituation

Reply = Callable[[Answer], None]


class RobotClient:
    """Answers requests of pages. A service's answer comes when it comes: `reply` is called then."""

    def __init__(self, node: Node, situation: SharedSituation) -> None:
        """Connect.

        Args:
            node: Owns publishers and clients.
            situation: Whose speech and speed the requests change.
        """
        self._node = node
        self._situation = situation
        self._texts = node.create_publisher(String, "text", 10)
        # Kept, as the translator's are: the executor asks for that, and knows what it has signed already.
        kept = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self._sentences = node.create_publisher(SignSentence, "sign_tokens", kept)
        self._speeds = node.create_publisher(SpeedScalingFactor, "speed_scaling_input", 10)
        self._orders = {order: node.create_client(Trigger, order.value) for order in Order}
        self._get_sign = node.create_client(GetSign, "get_sign")
        self._list_queue = node.create_client(ListQueue, "list_queue")
        # In this order: what the executor has no signs of is not to be translated.
        self._parameters = [
            node.create_client(SetParameters, f"{name}/set_parameters") for name in ("executor", "translator")
        ]
        self._rearming = Rearming(self._order)

    def serve(self, asked: FromPage, reply: Reply) -> None:
        """Carry out a request, and reply once."""
        try:
            self._serve(asked, reply)
        except ConsoleError as error:
            reply(Answer(id=asked.id, success=False, code=error.code, message=str(error)))

    def look_at_queue(self) -> None:
        """Ask the executor for its queue."""
        if self._list_queue.service_is_ready():
            called = self._list_queue.call_async(ListQueue.Request())
            called.add_done_callback(self._on_queue)

    def _serve(self, asked: FromPage, reply: Reply) -> None:
        done = Answer(id=asked.id, success=True)
        match asked:
            case SignText():
                self._sign(asked.text)
                reply(done)
            case ConfirmSpoken():
                self._expect_listener(self._texts, "translator")
                self._situation.spoken.take(asked.spoken)
                self._sign(asked.text)
                reply(done)
            case DiscardSpoken():
                self._situation.spoken.take(asked.spoken)
                reply(done)
            case SignGlosses():
                self._sign_glosses(asked.glosses)
                reply(done)
            case SetSpeed():
                self._expect_listener(self._speeds, "driver")
                self._speeds.publish(SpeedScalingFactor(factor=asked.factor))
                self._situation.speed_wanted(asked.factor)
                reply(done)
            case Command(order=Order.REARM):
                self._rearming.ask(asked, reply)
            case Command():
                if asked.order is Order.STOP:
                    self._rearming.give_up()
                self._order(asked, reply)
            case FetchSign():
                request = GetSign.Request(gloss=asked.gloss)
                self._call(
                    asked,
                    self._get_sign,
                    request,
                    reply,
                    lambda number, found: messages.to_answer_of_sign(number, asked.gloss, found),
                )
            case SetLanguage():
                self._set_language(asked, self._parameters, reply)

    def _order(self, asked: Command, reply: Reply) -> None:
        """Call the service that carries out a command, and reply once."""
        self._call(asked, self._orders[asked.order], Trigger.Request(), reply, messages.to_answer)

    def _set_language(self, asked: SetLanguage, clients: list[Any], reply: Reply) -> None:
        """Set the language of one node after the other, as long as none refuses; reply once."""
        client, *others = clients

        def go_on(answer: Answer) -> None:
            if answer.success and others:
                self._set_language(asked, others, reply)
            else:
                reply(answer)

        value = Parameter("language", value=asked.language).to_parameter_msg()
        request = SetParameters.Request(parameters=[value])
        self._call(asked, client, request, go_on, messages.to_answer_of_set)

    def _sign(self, text: str) -> None:
        self._expect_listener(self._texts, "translator")
        self._texts.publish(String(data=text))

    def _sign_glosses(self, glosses: tuple[str, ...]) -> None:
        self._expect_listener(self._sentences, "executor")
        message = SignSentence(
            utterance_id=f"console-{uuid.uuid4().hex}",
            sentence_count=1,
            text=" ".join(glosses),
            confidence=1.0,
        )
        message.header.stamp = self._node.get_clock().now().to_msg()
        message.tokens = [
            SignToken(
                gloss=gloss, kind=SignToken.KIND_LEXICAL, confidence=1.0, duration_scale=1.0, word_index=place
            )
            for place, gloss in enumerate(glosses)
        ]
        self._sentences.publish(message)

    def _expect_listener(self, publisher: Any, node: str) -> None:
        # The console itself listens to sign_tokens: to that topic one more is wanted.
        own = 1 if publisher is self._sentences else 0
        if publisher.get_subscription_count() <= own:
            raise ConsoleError(
                f"no_{node}",
                f"expected the {node} to listen on {publisher.topic_name}, nobody does: start it",
            )

    def _call(
        self, asked: FromPage, client: Any, request: Any, reply: Reply, answer: Callable[[int, Any], Answer]
    ) -> None:
        """Call a service, and reply with what `answer` makes of the request's number and the response."""
        if client.service_is_ready():
            called = client.call_async(request)
            called.add_done_callback(lambda done: reply(answer(asked.id, done.result())))
            return
        sentence = f"expected a node that serves {client.srv_name}, there is none: start it"
        reply(Answer(id=asked.id, success=False, code="no_service", message=sentence))

    def _on_queue(self, done: Future) -> None:
        response = done.result()
        if response is not None:
            self._situation.queue(messages.to_queue(response))


class Rearming:
    """Has the driver re-arm the robot, which it does at rest, unless the robot is stopped meanwhile.

    A stop wins over every request to re-arm that came before it.
    """

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
