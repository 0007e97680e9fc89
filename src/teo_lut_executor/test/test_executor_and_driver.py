# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The executor with the simulated driver: its action, refusals, several robots, a simulator's clock."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Time
from sensor_msgs.msg import JointState
from simulated_clock import SECOND, SimulatedClock
from teo_sign_msgs.msg import DriverState, ExecutorStatus, SignSentence, SignToken
from trajectory_msgs.msg import JointTrajectory

from teo_lut_executor.node.executor_node import ExecutorNode
from teo_names import ALL_JOINTS
from teo_signs.sign_file import save_sign
from teo_signs.tokens import parse_printed
from teo_sim_driver.node.driver_node import DriverNode

SIGNING, REFUSED = ExecutorStatus.STATE_SIGNING, ExecutorStatus.STATE_REFUSED
NewLab = Callable[..., "Lab"]


class Lab(Node):
    """An executor and a driver, started as from the command line; publishes sentences, and hears the rest."""

    def __init__(self, domain_id: int, arguments: Sequence[str], labs: Sequence[Lab]) -> None:
        context = Context()
        rclpy.init(context=context, domain_id=domain_id, args=["--ros-args", *arguments])
        super().__init__("lab", context=context)
        self._labs = labs
        signer, self.driver = ExecutorNode(context=context), DriverNode(context=context)
        self._nodes = (self, signer, self.driver)
        self._spinner = SingleThreadedExecutor(context=context)
        self.statuses: list[ExecutorStatus] = []
        self.sources: set[int] = set()
        self.by_topic: list[JointTrajectory] = []
        self.states: list[JointState] = []
        latched = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_subscription(ExecutorStatus, "executor_status", self.statuses.append, latched)
        self.create_subscription(
            DriverState, "driver_state", lambda state: self.sources.add(state.source), latched
        )
        self.create_subscription(JointTrajectory, "joint_trajectory", self.by_topic.append, 10)
        self.create_subscription(JointState, "joint_states", self.states.append, 100)
        self._tokens = self.create_publisher(SignSentence, "sign_tokens", 10)
        for node in self._nodes:
            self._spinner.add_node(node)
        assert signer.start()

    def sign(self, utterance: str, text: str) -> None:
        tokens = [
            SignToken(gloss=token.gloss, kind=int(token.kind), duration_scale=1.0)
            for token in parse_printed(text)
        ]
        self.until(lambda: self._tokens.get_subscription_count() > 0)
        self._tokens.publish(SignSentence(utterance_id=utterance, sentence_count=1, tokens=tokens))

    def until(self, condition: Callable[[], bool], timeout: float = 60.0) -> None:
        deadline = time.monotonic() + timeout
        while not condition():
            assert time.monotonic() < deadline, f"not within {timeout} s"
            self._turn()

    def spin(self, seconds: float) -> None:
        """Let time pass."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self._turn()

    def _turn(self) -> None:
        for lab in self._labs:
            lab._spinner.spin_once(timeout_sec=0.05)

    def close(self) -> None:
        self._spinner.shutdown()
        for node in self._nodes:
            node.destroy_node()
        rclpy.try_shutdown(context=self.context)

    def of(self, state: int) -> list[str]:
        """Which texts were told to be in a state, in order."""
        return [status.utterance_id for status in self.statuses if status.state == state]

    def rest(self, signed: str) -> None:
        """Wait until a text has been signed and all is idle."""
        self.until(lambda: signed in self.of(SIGNING))
        self.until(lambda: self.statuses[-1].state == ExecutorStatus.STATE_IDLE)


@pytest.fixture
def new_lab(domain_id: int, table_directory: Path, make_sign: Callable[..., Any]) -> Iterator[NewLab]:
    """Makes a lab with a table of quick signs; the arguments are ROS arguments."""
    for number, gloss in enumerate(("NOD", "TURN")):
        knots = [[0.1 * number, 0.05], [0.1 * number - 0.05, 0.0]]
        save_sign(table_directory, make_sign(gloss, knots, [0.0, 0.2], joints=("AxialNeck", "FrontalNeck")))
    # Half the driver's usual rate: a lab's three nodes share one thread, and two such labs would need more
    # time than there is.
    common = ("-p", f"lut_directory:={table_directory}", "-p", "journal:=''", "-p", "update_rate:=50")
    labs: list[Lab] = []

    def make(*arguments: str) -> Lab:
        labs.append(Lab(domain_id, (*common, *arguments), labs))
        return labs[-1]

    yield make
    for lab in labs:
        lab.close()


def test_motions_as_goals_of_the_action_sign_sentences_in_a_row(new_lab: NewLab) -> None:
    lab = new_lab("-p", "trajectory_interface:=action")
    lab.sign("one", "NOD TURN")
    lab.sign("two", "TURN NOD")
    lab.rest("two")
    # Not once each: on a machine that is busy a motion may come too late, and its sentence is signed again.
    assert list(dict.fromkeys(lab.of(SIGNING))) == ["one", "two"]
    assert not lab.of(REFUSED)
    assert DriverState.SOURCE_ACTION in lab.sources and DriverState.SOURCE_TOPIC not in lab.sources
    assert not lab.by_topic


def test_what_the_driver_refuses_of_others_is_counted_and_what_it_refuses_of_the_executor_is_named(
    new_lab: NewLab,
) -> None:
    lab = new_lab()
    told: list[DiagnosticArray] = []
    lab.create_subscription(DiagnosticArray, "diagnostics", told.append, 10)
    strangers = lab.create_publisher(JointTrajectory, "joint_trajectory", 10)

    def shout(motion: JointTrajectory) -> None:
        for _ in range(5 if motion.header.frame_id else 0):  # the executor's own have one
            strangers.publish(JointTrajectory(joint_names=["foo"]))

    lab.create_subscription(JointTrajectory, "joint_trajectory", shout, 10)
    lab.sign("one", "NOD TURN")
    lab.rest("one")
    assert {status.code for status in lab.statuses} == {""}

    def counted() -> int:
        values = [pair for array in told for status in array.status for pair in status.values]
        return max((int(v.value) for v in values if v.key == "trajectories of others refused"), default=0)

    lab.until(lambda: counted() >= 5)
    assert lab.driver.set_parameters([Parameter("max_points", value=3)])[0].successful
    lab.sign("two", "NOD")
    lab.until(lambda: lab.of(REFUSED) == ["two"])
    assert {status.code for status in lab.statuses} == {"", "trajectory_refused"}


@pytest.mark.slow
def test_two_robots_in_namespaces_sign_side_by_side_in_simulated_time_and_stand_while_it_does(
    new_lab: NewLab,
) -> None:
    texts = {"ana": "NOD NOD", "eva": "TURN TURN"}
    labs = {name: new_lab("-r", f"__ns:=/{name}", "-p", "use_sim_time:=true") for name in texts}
    ana, eva = labs.values()
    # Not faster than the machine's: what comes late on a busy one would be late by more of its time.
    clock = SimulatedClock(ana.context, rate=1.0)
    try:
        for name, lab in labs.items():
            lab.sign(name, texts[name])
        ana.until(lambda: bool(ana.of(SIGNING)))
        clock.pause()
        ana.spin(1.7)  # longer than the sentence takes, than `joint_state_timeout` and `path_time`
        assert ana.statuses[-1].state == SIGNING, "no time passes: it is not over"
        assert Time.from_msg(ana.states[-1].header.stamp).nanoseconds <= clock.now
        codes = {status.code for lab in (ana, eva) for status in lab.statuses}
        assert not codes & {"stale_joint_states", "not_followed", "not_reached"}, "and nothing is amiss"
        clock.go_on()
        for name, lab in labs.items():
            lab.rest(name)
    finally:
        clock.close()
    for name, lab in labs.items():
        assert {status.utterance_id for status in lab.statuses} <= {name, ""}
        assert not lab.of(REFUSED)
        last = max(index for index, status in enumerate(lab.statuses) if status.state == SIGNING)
        signing, after = lab.statuses[last : last + 2]
        begun, ended = (Time.from_msg(status.header.stamp) for status in (signing, after))
        assert (ended - begun).nanoseconds / SECOND == pytest.approx(signing.duration, abs=1.0)
    # NOD turns the neck by -0.05 rad, TURN by 0.1: each robot has moved as it was told, and no further.
    neck = ALL_JOINTS.index("AxialNeck")
    turned = [[state.position[neck] for state in lab.states] for lab in (ana, eva)]
    assert np.min(turned[0]) == pytest.approx(-0.05, abs=0.01) and np.max(turned[0]) < 0.01
    assert np.max(turned[1]) == pytest.approx(0.1, abs=0.01) and np.min(turned[1]) > -0.01
