# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`executor_node`: sign tokens in, joint trajectories out."""

from __future__ import annotations

import time
from collections.abc import Iterable, Sequence
from typing import Any

import rclpy
from rcl_interfaces.msg import SetParametersResult
from rclpy.action import ActionServer, CancelResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import JointState
from teo_sign_msgs.action import ExecuteSentence
from teo_sign_msgs.msg import ExecutorStatus, SignSentence
from teo_sign_msgs.srv import GetSign, ListSigns
from trajectory_msgs.msg import JointTrajectory

from teo_common.node_process import run_node
from teo_common.parameters import declare_parameters
from teo_description.robot import Robot
from teo_lut_executor.execution.events import (
    Activity,
    Event,
    Finished,
    PlanWanted,
    ReturnWanted,
    Status,
    TrajectoryReady,
)
from teo_lut_executor.execution.queue import ExecutionQueue
from teo_lut_executor.node.messages import (
    to_sentence,
    to_status,
    to_trajectory,
)
from teo_lut_executor.node.parameters import (
    PARAMETERS,
    Value,
    left_handed_from,
    limits_from,
    queue_settings_from,
    standing_from,
    style_from,
)
from teo_lut_executor.node.sentence_goals import SentenceGoals, never_called
from teo_lut_executor.node.sign_services import get_sign, list_signs
from teo_motion.planner import Planner
from teo_motion.sentence.plan import Plan
from teo_signs.errors import LutError, PlanError
from teo_signs.look_up_table import Lut
from teo_signs.mirroring import MirroredSigns

# Sentences of a whole text can wait here while one is planned.
_TOKENS_DEPTH = 100

# How often the queue looks at the clock and the robot [Hz], and feedback is sent [Hz].
_STEP_RATE = 50.0
_FEEDBACK_RATE = 10.0


class ExecutorNode(Node):
    """Signs sentences in the order in which they come: see `ExecutionQueue` for when, `Planner` for how."""

    def __init__(
        self, *, context: Context | None = None, parameter_overrides: Iterable[Parameter] = ()
    ) -> None:
        """Open the look-up table and the robot description, then listen.

        Args:
            context: The ROS context; the default one if None.
            parameter_overrides: Values in place of the defaults of `parameters.PARAMETERS`.

        Raises:
            LutError: The look-up table cannot be opened.
            PlanError: The parameters do not go together.
        """
        super().__init__("executor", context=context, parameter_overrides=list(parameter_overrides))
        declare_parameters(self, PARAMETERS)
        self._lut = Lut.open(self._value("lut_directory") or None)
        self._robot = Robot.load()
        self._planner = self._make_planner(self._values())
        self._queue = ExecutionQueue(self._planner.limits, queue_settings_from(self._values()))
        self._goals = SentenceGoals()
        self.add_on_set_parameters_callback(self._check_parameters)
        self.add_post_set_parameters_callback(self._apply_parameters)

        reliable = ReliabilityPolicy.RELIABLE
        latched = QoSProfile(depth=10, reliability=reliable, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self._trajectories = self.create_publisher(
            JointTrajectory, "joint_trajectory", QoSProfile(depth=10, reliability=reliable)
        )
        self._statuses = self.create_publisher(ExecutorStatus, "executor_status", latched)
        self.create_subscription(
            SignSentence,
            "sign_tokens",
            self._on_tokens,
            QoSProfile(depth=_TOKENS_DEPTH, reliability=reliable),
        )
        # Best effort takes reliable publishers as well as those of sensor data; only the latest state counts.
        self.create_subscription(
            JointState,
            "joint_states",
            self._on_joint_states,
            QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT),
        )
        self.create_service(ListSigns, "list_signs", self._on_list_signs)
        self.create_service(GetSign, "get_sign", self._on_get_sign)
        self._action = ActionServer(
            self,
            ExecuteSentence,
            "execute_sentence",
            execute_callback=never_called,
            handle_accepted_callback=self._on_goal,
            cancel_callback=self._on_cancel,
        )
        self.create_timer(1.0 / _STEP_RATE, self._step)
        self.create_timer(1.0 / _FEEDBACK_RATE, self._give_feedback)
        self.get_logger().info(f"ready with {len(self._lut)} signs of {self._lut.place}")
        self._step()

    def _on_tokens(self, message: SignSentence) -> None:
        _, events = self._queue.submit(to_sentence(message), self._now())
        self._carry_out(events)
        self._step()

    def _on_joint_states(self, message: JointState) -> None:
        problem = self._queue.joint_states(message.name, message.position, message.velocity, self._now())
        if problem:
            self.get_logger().warning(f"joint state not taken: {problem}", throttle_duration_sec=5.0)

    def _on_goal(self, goal: ServerGoalHandle) -> None:
        ticket, events = self._queue.submit(to_sentence(goal.request.sentence), self._now())
        self._goals.add(ticket, goal)
        self._carry_out(events)
        self._step()

    def _on_cancel(self, goal: ServerGoalHandle) -> CancelResponse:
        ticket = self._goals.ticket(goal)
        if ticket is None:
            return CancelResponse.REJECT  # it has just ended
        self._carry_out(self._queue.cancel(ticket, self._now()))
        return CancelResponse.ACCEPT

    def _step(self) -> None:
        listening = self._trajectories.get_subscription_count() > 0
        self._carry_out(self._queue.step(self._now(), listening=listening))

    def _carry_out(self, events: Sequence[Event]) -> None:
        to_do = list(events)
        while to_do:
            event = to_do.pop(0)
            match event:
                case PlanWanted():
                    to_do += self._plan(event)
                case ReturnWanted():
                    to_do += self._plan_return(event)
                case TrajectoryReady():
                    self._trajectories.publish(to_trajectory(event.plan, lead=event.lead))
                case Status():
                    self._publish(event)
                case Finished():
                    self._goals.finish(event)

    def _plan(self, wanted: PlanWanted) -> list[Event]:
        self._refresh_lut()
        began = time.perf_counter()
        try:
            plan = self._planner.plan(wanted.sentence.tokens, wanted.start, form=wanted.sentence.form)
        except PlanError as error:
            return self._queue.not_planned(error, self._now())
        took = (time.perf_counter() - began) * 1000.0
        self.get_logger().info(
            f"{len(plan.timings)} signs in {plan.duration:.1f} s, stretch {plan.stretch:.2f} "
            f"(planned in {took:.0f} ms)"
        )
        return self._queue.planned(plan, self._now())

    def _plan_return(self, wanted: ReturnWanted) -> list[Event]:
        try:
            plan: Plan = self._planner.plan_to_rest(wanted.start)
        except PlanError as error:
            self.get_logger().warning(f"cannot turn back, the sentence goes on to its end: {error}")
            return []
        return self._queue.return_planned(plan, self._now())

    def _publish(self, status: Status) -> None:
        self._statuses.publish(to_status(status))
        if status.activity == Activity.REFUSED:
            self.get_logger().warning(f"not signed: [{status.code}] {status.message}")
        elif status.activity == Activity.WAITING:
            self.get_logger().info(status.message)

    def _give_feedback(self) -> None:
        progress = self._queue.progress(self._now())
        if progress is not None:
            self._goals.give_feedback(progress)

    def _on_list_signs(self, request: ListSigns.Request, response: ListSigns.Response) -> ListSigns.Response:
        self._refresh_lut()
        for problem in list_signs(self._lut, request, response):
            self.get_logger().warning(problem)
        return response

    def _on_get_sign(self, request: GetSign.Request, response: GetSign.Response) -> GetSign.Response:
        self._refresh_lut()
        get_sign(self._lut, request, response)
        return response

    def _refresh_lut(self) -> None:
        problem = self._lut.refresh()
        if problem:
            self.get_logger().error(f"look-up table not read again: {problem}", throttle_duration_sec=5.0)

    def _check_parameters(self, parameters: Sequence[Parameter]) -> SetParametersResult:
        try:
            self._make_planner(self._values() | {item.name: item.value for item in parameters})
        except PlanError as error:
            return SetParametersResult(successful=False, reason=f"[{error.code}] {error}")
        return SetParametersResult(successful=True)

    def _apply_parameters(self, _: Sequence[Parameter]) -> None:
        values = self._values()
        self._planner = self._make_planner(values)
        self._queue.limits, self._queue.settings = self._planner.limits, queue_settings_from(values)

    def _make_planner(self, values: dict[str, Value]) -> Planner:
        return Planner(
            MirroredSigns(self._lut, self._robot) if left_handed_from(values) else self._lut,
            limits=limits_from(values),
            style=style_from(values),
            robot=self._robot,
            least_clearance=float(values["least_clearance"]),
            period=float(values["period"]),
            max_duration=float(values["max_duration"]),
            least_standing=standing_from(values),
        )

    def _values(self) -> dict[str, Value]:
        return {row.name: self._value(row.name) for row in PARAMETERS}

    def _value(self, name: str) -> Any:
        return self.get_parameter(name).value

    def _now(self) -> float:
        return float(self.get_clock().now().nanoseconds) * 1e-9


def main(arguments: list[str] | None = None) -> None:
    """Run the node until it is told to end."""
    try:
        run_node(ExecutorNode, arguments)
    except (LutError, PlanError) as error:
        rclpy.logging.get_logger("executor").fatal(f"[{error.code}] {error}")
        raise SystemExit(1) from None


if __name__ == "__main__":
    main()
