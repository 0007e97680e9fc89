# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`executor_node`: sign tokens in, joint trajectories out."""

from __future__ import annotations

import time
from collections.abc import Iterable, Sequence
from typing import Any

from rcl_interfaces.msg import SetParametersResult
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.context import Context
from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger
from teo_sign_msgs.action import ExecuteSentence
from teo_sign_msgs.msg import ExecutorStatus, SignSentence
from teo_sign_msgs.srv import GetSign, ListQueue, ListSigns

from teo_common.diagnostics import DIAGNOSTICS_PERIOD, DiagnosticsPublisher
from teo_common.node_process import run_node
from teo_common.parameters import declare_parameters
from teo_lut_executor.execution.events import (
    Activity,
    Begun,
    DriverReport,
    Event,
    Finished,
    PlanWanted,
    ReturnWanted,
    Sentence,
    Status,
    StopReady,
    TrajectoryReady,
)
from teo_lut_executor.execution.queue import ExecutionQueue
from teo_lut_executor.node.diagnostics import Statistics, diagnose
from teo_lut_executor.node.driver_link import DriverLink
from teo_lut_executor.node.messages import to_sentence, to_status, to_stop, to_trajectory
from teo_lut_executor.node.parameters import PARAMETERS, planner_settings_from, queue_settings_from
from teo_lut_executor.node.sentence_goals import SentenceGoals, never_called
from teo_lut_executor.node.sentence_journal import SentenceJournal
from teo_lut_executor.node.sign_services import get_sign, list_signs
from teo_lut_executor.planning.planning_process import PlanningProcess
from teo_lut_executor.planning.worker import NotPlanned, Opened, Planned
from teo_motion.planner import Planner
from teo_signs.errors import LutError, PlanError
from teo_signs.look_up_table import Lut

# Sentences that DDS keeps while a callback runs: far more than arrive in that time, so that it is our own
# queue that is full first, and that says so.
_TOKENS_DEPTH = 1000

# How often the queue looks at the clock and the robot [Hz], and feedback is sent [Hz].
_STEP_RATE = 50.0
_FEEDBACK_RATE = 10.0


class ExecutorNode(LifecycleNode):
    """Signs sentences in the order in which they come: see `ExecutionQueue` for when, `Planner` for how.

    Unconfigured: nothing. Inactive: it takes sentences and answers about the table, and does not move the
    robot. Active: it signs.
    """

    def __init__(
        self, *, context: Context | None = None, parameter_overrides: Iterable[Parameter] = ()
    ) -> None:
        """Declare the parameters; the transitions do the rest.

        Args:
            context: The ROS context; the default one if None.
            parameter_overrides: Values in place of the defaults of `parameters.PARAMETERS`.
        """
        super().__init__("executor", context=context, parameter_overrides=list(parameter_overrides))
        declare_parameters(self, PARAMETERS)
        self._configured = self._active = False
        self._diagnostics = DiagnosticsPublisher(self, "sentences")
        self.add_on_set_parameters_callback(self._check_parameters)
        self.add_post_set_parameters_callback(self._apply_parameters)

    def start(self) -> bool:
        """Configure and activate without a manager; tell whether both succeeded."""
        success = TransitionCallbackReturn.SUCCESS
        return bool(self.trigger_configure() == success and self.trigger_activate() == success)

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:  # noqa: ARG002 - the API's
        """Open the table, start the process that plans, and listen."""
        try:
            settings = planner_settings_from(self._values())
            self._lut = Lut.open(settings.lut_directory)
            self._checker: Planner = settings.planner(self._lut, None)
            queue_settings = queue_settings_from(self._values())
        except (LutError, PlanError) as error:
            self.get_logger().error(f"cannot be configured: [{error.code}] {error}")
            return TransitionCallbackReturn.FAILURE
        self._queue = ExecutionQueue(self._checker.limits, queue_settings)
        self._goals = SentenceGoals()
        self._statistics = Statistics()
        self._journal = SentenceJournal(self, folder=self._value("journal"))
        answered = self.create_guard_condition(self._on_answers)
        self._planning = PlanningProcess(settings, answered.trigger)
        self._communicate()
        self._entities.append(answered)
        self._configured = True
        self._take_over_journal()
        self.get_logger().info(f"ready with {len(self._lut)} signs of {self._lut.place}")
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Sign."""
        self._active = True
        return super().on_activate(state)

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Slow down and hold; what waits is kept."""
        self._active = False
        self._carry_out(self._queue.deactivate(self._now()))
        return super().on_deactivate(state)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:  # noqa: ARG002 - the API's
        """Name what is not signed, and let go of everything."""
        self._let_go()
        return TransitionCallbackReturn.SUCCESS

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Slow down, name what is not signed, and let go of everything."""
        self._let_go()
        return super().on_shutdown(state)

    def destroy_node(self) -> None:
        """Name what is not signed, then end."""
        self._goals = SentenceGoals()  # nobody runs callbacks any more: clients see the server go
        self._let_go()
        super().destroy_node()

    def _communicate(self) -> None:
        """Create what others see of the node."""
        reliable = ReliabilityPolicy.RELIABLE
        latched = QoSProfile(depth=1, reliability=reliable, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self._driver = DriverLink(
            self,
            interface=self._value("trajectory_interface"),
            on_report=self._on_driver_report,
            on_refused=self._on_driver_refused,
        )
        self._statuses = self.create_publisher(ExecutorStatus, "executor_status", latched)
        tokens = QoSProfile(depth=_TOKENS_DEPTH, reliability=reliable)
        # Best effort takes reliable publishers as well as those of sensor data; only the latest state counts.
        sensor = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
        self._entities: list[Any] = [
            self._statuses,
            self.create_subscription(SignSentence, "sign_tokens", self._on_tokens, tokens),
            self.create_subscription(JointState, "joint_states", self._on_joint_states, sensor),
            self.create_service(ListSigns, "list_signs", self._on_list_signs),
            self.create_service(GetSign, "get_sign", self._on_get_sign),
            self.create_service(ListQueue, "list_queue", self._on_list_queue),
            self.create_service(Trigger, "clear_queue", self._on_clear_queue),
            self.create_timer(1.0 / _STEP_RATE, self._step),
            self.create_timer(1.0 / _FEEDBACK_RATE, self._give_feedback),
            self.create_timer(DIAGNOSTICS_PERIOD, self._publish_diagnostics),
        ]
        self._action = ActionServer(
            self,
            ExecuteSentence,
            "execute_sentence",
            execute_callback=never_called,
            goal_callback=self._on_goal_request,
            handle_accepted_callback=self._on_goal,
            cancel_callback=self._on_cancel,
        )

    def _let_go(self) -> None:
        if not self._configured:
            return
        self._configured = self._active = False
        self._carry_out(self._queue.deactivate(self._now()))
        self._carry_out(self._queue.clear(self._now()))
        self._planning.close()
        self._journal.close()
        self._driver.close()
        self._action.destroy()
        for entity in self._entities:
            for destroy in (
                self.destroy_publisher,
                self.destroy_subscription,
                self.destroy_service,
                self.destroy_timer,
                self.destroy_guard_condition,
            ):
                if destroy(entity):
                    break

    def _on_tokens(self, message: SignSentence) -> None:
        sentence = to_sentence(message)
        if self._accepts(sentence):
            self._submit(sentence)

    def _accepts(self, sentence: Sentence) -> bool:
        """Whether a sentence is one, as far as that is known without planning it; if not, that is told."""
        self._refresh_lut()
        try:
            self._checker.check(sentence.tokens, form=sentence.form)
        except PlanError as error:
            self._carry_out(self._queue.refuse(sentence, error, self._now()))
            return False
        return True

    def _submit(self, sentence: Sentence, *, attempts: int = 0) -> int:
        ticket, events = self._queue.submit(sentence, self._now(), attempts=attempts)
        self._journal.accepted(ticket, sentence, attempts)
        self._carry_out(events)
        self._step()
        return ticket

    def _take_over_journal(self) -> None:
        """Sign what an executor before this one was killed with, or name it."""
        for kept in self._journal.left:
            age = time.time() - kept.accepted
            if kept.attempts >= self._queue.settings.attempts:
                error = PlanError("interrupted", "the executor ended while it signed it: send it again")
            elif age > self._value("journal_age"):
                error = PlanError("expired", f"it waited for {age:.0f} s: send it again")
            else:
                self._submit(kept.sentence, attempts=kept.attempts)
                continue
            self._carry_out(self._queue.refuse(kept.sentence, error, self._now()))

    def _on_joint_states(self, message: JointState) -> None:
        problem = self._queue.joint_states(message.name, message.position, message.velocity, self._now())
        if problem:
            self.get_logger().warning(f"joint state not taken: {problem}", throttle_duration_sec=5.0)

    def _on_driver_report(self, report: DriverReport) -> None:
        self._carry_out(self._queue.driver_state(report, self._now()))

    def _on_driver_refused(self, number: int, reason: str) -> None:
        self._carry_out(self._queue.driver_refused(number, reason, self._now()))

    def _on_goal_request(self, goal: ExecuteSentence.Goal) -> GoalResponse:
        accepted = self._accepts(to_sentence(goal.sentence))
        return GoalResponse.ACCEPT if accepted else GoalResponse.REJECT

    def _on_goal(self, goal: ServerGoalHandle) -> None:
        sentence = to_sentence(goal.request.sentence)
        ticket, events = self._queue.submit(sentence, self._now())
        self._goals.add(ticket, goal)
        self._journal.accepted(ticket, sentence)
        self._carry_out(events)
        self._step()

    def _on_cancel(self, goal: ServerGoalHandle) -> CancelResponse:
        ticket = self._goals.ticket(goal)
        if ticket is None:
            return CancelResponse.REJECT  # it has just ended
        self._carry_out(self._queue.cancel(ticket, self._now()))
        return CancelResponse.ACCEPT

    def _step(self) -> None:
        self._carry_out(self._queue.step(self._now(), obstacle=self._obstacle()))

    def _obstacle(self) -> str:
        """Why no motion may begin, as far as the node knows; empty if it may."""
        if not self._active:
            return "the executor is not active"
        if not self._planning.ready:
            return "waiting for the planner to load"
        return "" if self._driver.listening else "waiting for a driver to take joint_trajectory"

    def _carry_out(self, events: Sequence[Event]) -> None:
        for event in events:
            match event:
                case PlanWanted() | ReturnWanted():
                    self._planning.ask(event)
                case TrajectoryReady():
                    names = self._queue.limits.names
                    trajectory = to_trajectory(names, event.samples, start=event.start)
                    self._driver.send(event.number, trajectory)
                case StopReady():
                    stop = to_stop(self._queue.limits.names, event.end, event.lead)
                    self._driver.send(event.number, stop)
                case Begun():
                    self._journal.begun(event.ticket)
                case Status():
                    self._publish(event)
                case Finished():
                    self._journal.ended(event.ticket)
                    self._statistics.ended[event.outcome] += 1
                    self._goals.finish(event)

    def _on_answers(self) -> None:
        """Take what the process that plans has answered."""
        for answer in self._planning.answers():
            now = self._now()
            match answer:
                case Opened():
                    self._carry_out(self._queue.opened(answer.number, answer.plan, now))
                case Planned():
                    plan = answer.plan
                    self._statistics.add_plan(answer.took)
                    self.get_logger().info(
                        f"{len(plan.timings)} signs in {plan.duration:.1f} s, stretch {plan.stretch:.2f} "
                        f"(planned in {answer.took * 1000.0:.0f} ms)"
                    )
                    self._carry_out(self._queue.planned(answer.number, plan, now, after=answer.after))
                case NotPlanned():
                    error = PlanError(answer.code, answer.message)
                    self._carry_out(self._queue.not_planned(answer.number, error, now))
        self._step()

    def _publish(self, status: Status) -> None:
        self._statistics.add_status(status)
        self._statuses.publish(to_status(status))
        if status.code:
            named = "" if status.sentence is None else f" (utterance {status.sentence.utterance_id})"
            self.get_logger().warning(f"{status.activity.name}: [{status.code}] {status.message}{named}")
        elif status.activity == Activity.WAITING:
            self.get_logger().info(status.message)

    def _give_feedback(self) -> None:
        progress = self._queue.progress(self._now())
        if progress is not None:
            self._goals.give_feedback(progress)

    def _publish_diagnostics(self) -> None:
        self._diagnostics.publish(
            diagnose(
                self._statistics,
                active=self._active,
                queued=self._queue.queued,
                planner_restarts=self._planning.restarts,
            )
        )

    def _on_list_signs(self, request: ListSigns.Request, response: ListSigns.Response) -> ListSigns.Response:
        self._refresh_lut()
        for problem in list_signs(self._lut, request, response):
            self.get_logger().warning(problem)
        return response

    def _on_get_sign(self, request: GetSign.Request, response: GetSign.Response) -> GetSign.Response:
        self._refresh_lut()
        get_sign(self._lut, request, response)
        return response

    def _on_list_queue(self, _: ListQueue.Request, response: ListQueue.Response) -> ListQueue.Response:
        sentences, response.current = self._queue.sentences()
        response.utterance_ids = [sentence.utterance_id for sentence in sentences]
        response.sentence_indices = [sentence.index for sentence in sentences]
        response.texts = [sentence.text for sentence in sentences]
        return response

    def _on_clear_queue(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        before = self._queue.queued
        self._carry_out(self._queue.clear(self._now()))
        response.success, response.message = True, f"{before} sentences forgotten"
        return response

    def _refresh_lut(self) -> None:
        problem = self._lut.refresh()
        if problem:
            self.get_logger().error(f"look-up table not read again: {problem}", throttle_duration_sec=5.0)

    def _check_parameters(self, parameters: Sequence[Parameter]) -> SetParametersResult:
        values = self._values() | {item.name: item.value for item in parameters}
        try:
            queue_settings_from(values)
            planner_settings_from(values).planner({}, None)
        except PlanError as error:
            return SetParametersResult(successful=False, reason=f"[{error.code}] {error}")
        return SetParametersResult(successful=True)

    def _apply_parameters(self, _: Sequence[Parameter]) -> None:
        if not self._configured:  # configuring reads them
            return
        settings = planner_settings_from(self._values())
        self._checker = settings.planner(self._lut, None)
        self._planning.configure(settings)
        self._queue.configure(self._checker.limits, queue_settings_from(self._values()))

    def _values(self) -> dict[str, Any]:
        return {row.name: self._value(row.name) for row in PARAMETERS}

    def _value(self, name: str) -> Any:
        return self.get_parameter(name).value

    def _now(self) -> float:
        return float(self.get_clock().now().nanoseconds) * 1e-9


def _started_node() -> ExecutorNode:
    node = ExecutorNode()
    if node.get_parameter("autostart").value and not node.start():
        node.destroy_node()
        raise SystemExit(1)  # the log has said why
    return node


def main(arguments: list[str] | None = None) -> None:
    """Run the node until it is told to end."""
    run_node(_started_node, arguments)


if __name__ == "__main__":
    main()
