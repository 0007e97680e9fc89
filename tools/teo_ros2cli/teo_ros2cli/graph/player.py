# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Playing a bag into a running graph."""

from __future__ import annotations

import time
from collections.abc import Callable, Collection, Mapping
from typing import Any, NamedTuple

from teo_ros2cli.bags.bag import Bag
from teo_ros2cli.bags.metadata import TopicRecord
from teo_ros2cli.bags.playback import ReadAhead, Schedule
from teo_ros2cli.bags.selection import TopicSelection
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.graph.discovery import settle
from teo_ros2cli.interfaces import message_class
from teo_ros2cli.qos import QosRecord, from_record, offer_for

# Longest time in which a signal or a key is not looked at [s].
_STEP = 0.05


class PlayerSettings(NamedTuple):
    """How a bag is played.

    Args:
        selection: Which topics are played.
        remap: New full topic name by old one.
        rate: Seconds of the bag in one second.
        start_offset: Where to begin, from the start of the bag [s].
        duration: How much of the bag to play [s], None for all.
        until: Time at which to end [ns since the epoch], None for the end of the bag.
        delay: Time to wait before playing, in each loop [s].
        loop: Begin again at the end.
        clock: Rate of publishing `/clock` [1/s], 0 for not at all.
        clock_before: Tells by a topic's name in the bag whether `/clock` is published before its messages.
        start_paused: Begin with a pause.
        overrides: Profile to publish with, by topic name in the bag.
        read_ahead: Messages that are read before they are due.
        wait_acknowledged: Longest time to wait for acknowledgements at the end [s].
    """

    selection: TopicSelection
    remap: Mapping[str, str]
    rate: float
    start_offset: float
    duration: float | None
    until: int | None
    delay: float
    loop: bool
    clock: float
    clock_before: Callable[[str], bool]
    start_paused: bool
    overrides: Mapping[str, QosRecord]
    read_ahead: int
    wait_acknowledged: float


class Player:
    """Publishes the messages of a bag as they were recorded, at the times of their reception.

    Args:
        node: The node to publish with.
        bag: The bag.
        settings: How to play it.
        stopped: Asked between messages; True ends the playing.
        command: Called in waiting times with the player, to let keys act on it.
    """

    def __init__(
        self,
        node: Any,
        bag: Bag,
        settings: PlayerSettings,
        *,
        stopped: Callable[[], bool],
        command: Callable[[Player], None],
    ) -> None:
        self._node = node
        self._bag = bag
        self._settings = settings
        self._stopped = stopped
        self._command = command
        self._log = node.get_logger()
        self._schedule = Schedule(0, 0.0, rate=settings.rate, paused=settings.start_paused)
        self._single_steps = 0
        self._next_tick = 0.0
        self._publishers: dict[str, Any] = {}
        for topic, _ in bag.metadata.topics:
            if settings.selection.accepts(topic.name, topic.type):
                self._advertise(topic)
        clocked = settings.clock > 0 or any(map(settings.clock_before, self._publishers))
        self._clock = _ClockPublisher(node) if clocked else None
        self.played = 0

    @property
    def topics(self) -> Collection[str]:
        """Names in the bag of the topics that are played."""
        return self._publishers.keys()

    # What keys do

    def toggle_paused(self) -> None:
        """Pause, or go on."""
        now = time.monotonic()
        if self._schedule.paused:
            self._log.info("Resuming play.")
            self._schedule.resume(now)
        else:
            self._log.info("Pausing play.")
            self._schedule.pause(now)

    def change_rate(self, factor: float) -> None:
        """Play faster or slower."""
        self._schedule.set_rate(self._schedule.rate * factor, time.monotonic())
        self._log.info(f"Set rate to {self._schedule.rate:g}")

    def play_next(self) -> None:
        """In a pause, publish one message."""
        if self._schedule.paused:
            self._single_steps += 1

    # Playing

    def play(self) -> None:
        """Play the bag, again and again if the settings say so, until its end or until stopped.

        It begins when the subscriptions that are there have matched, so that they get the first messages.
        """
        clock = () if self._clock is None else (self._clock.publisher,)
        settle(self._node, publishers=(*self._publishers.values(), *clock), stopped=self._stopped)
        while not self._stopped():
            self._play_once()
            if not self._settings.loop or not self._publishers or not self._bag.metadata.messages:
                break
        self._wait_for_acknowledgements()

    def _play_once(self) -> None:
        settings = self._settings
        beginning = self._bag.metadata.start + round(settings.start_offset * 1e9)
        end = min(
            settings.until if settings.until is not None else 2**63,
            beginning + round(settings.duration * 1e9) if settings.duration is not None else 2**63,
        )
        reader = ReadAhead(
            self._bag.messages(topics=self.topics, start=beginning, on_problem=self._log.warning),
            settings.read_ahead,
        )
        try:
            reader.wait_filled(self._stopped)
            self._pause_for(settings.delay)
            paused = self._schedule.paused
            rate = self._schedule.rate
            self._schedule = Schedule(beginning, time.monotonic(), rate=rate, paused=paused)
            self._next_tick = 0.0
            for message in reader:
                if message.log_time > end:
                    break
                if not self._wait_until_due(message.log_time):
                    return
                if self._clock is not None and self._settings.clock_before(message.topic):
                    self._clock.publish(message.log_time)
                self._publishers[message.topic].publish(message.data)
                self.played += 1
            if settings.duration is not None and end < 2**63:
                self._wait_until_due(min(end, beginning + self._bag.metadata.duration))
        finally:
            reader.close()

    def _wait_until_due(self, moment: int) -> bool:
        """Sleep until a time of the bag is due [ns]; False if playing is to stop."""
        while not self._stopped():
            self._command(self)
            now = time.monotonic()
            self._tick(now, moment)
            if self._schedule.paused:
                if self._single_steps:
                    self._single_steps -= 1
                    return True
                time.sleep(_STEP / 5)
                continue
            left = self._schedule.due(moment) - now
            if left <= 0:
                return True
            wake = min(_STEP, max(self._next_tick - now, 0.0)) if self._settings.clock else _STEP
            time.sleep(min(left, wake))
        return False

    def _pause_for(self, seconds: float) -> None:
        end = time.monotonic() + seconds
        while not self._stopped() and (left := end - time.monotonic()) > 0:
            time.sleep(min(left, _STEP))

    def _tick(self, now: float, moment: int) -> None:
        """Publish the clock if it is time; on a late machine it does not pass what is played next [ns]."""
        if self._clock is not None and self._settings.clock and now >= self._next_tick:
            self._next_tick = max(self._next_tick + 1 / self._settings.clock, now)
            self._clock.publish(min(self._schedule.time_at(now), moment))

    def _advertise(self, topic: TopicRecord) -> None:
        name = self._settings.remap.get(topic.name, topic.name)
        if topic.serialization_format != "cdr":
            self._log.warning(
                f"Ignoring a topic '{topic.name}', reason: its messages are '{topic.serialization_format}', "
                f"not cdr."
            )
            return
        profile = self._settings.overrides.get(topic.name)
        if profile is None:
            profile = offer_for(topic.name, topic.offered_qos, self._log.warning)
        try:
            cls = message_class(topic.type)
            self._publishers[topic.name] = self._node.create_publisher(cls, name, from_record(profile))
        except Ros2CliError as error:
            self._log.warning(f"Ignoring a topic '{topic.name}', reason: {error}.")
        except Exception as error:  # rclpy has no common base: an invalid name, a profile that DDS refuses
            self._log.warning(f"Ignoring a topic '{topic.name}', reason: {type(error).__name__}: {error}.")

    def _wait_for_acknowledgements(self) -> None:
        from rclpy.duration import Duration

        longest = self._settings.wait_acknowledged
        deadline = time.monotonic() + longest
        for name, publisher in self._publishers.items():
            while not self._stopped():
                if publisher.wait_for_all_acked(Duration(seconds=_STEP)):
                    break
                if time.monotonic() > deadline:
                    self._log.warning(
                        f"Not all subscriptions acknowledged the messages of '{name}' in {longest:g} s"
                    )
                    return


class _ClockPublisher:
    def __init__(self, node: Any) -> None:
        from rosgraph_msgs.msg import Clock

        self.publisher = node.create_publisher(Clock, "/clock", 10)
        self._message = Clock()

    def publish(self, nanoseconds: int) -> None:
        stamp = self._message.clock
        stamp.sec, stamp.nanosec = divmod(nanoseconds, 1_000_000_000)
        self.publisher.publish(self._message)
