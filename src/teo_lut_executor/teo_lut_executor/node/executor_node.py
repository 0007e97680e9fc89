# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`executor_node`: sign tokens in, joint trajectories out."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from rcl_interfaces.msg import SetParametersResult
from rclpy.context import Context
from rclpy.lifecycle import LifecycleState, TransitionCallbackReturn
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import JointState
from teo_sign_msgs.msg import ExecutorStatus

from teo_common.diagnostics import DIAGNOSTICS_PERIOD, Diagnosis, DiagnosticsPublisher, Level
from teo_common.node_process import SelfStartingNode, run_self_starting
from teo_description.errors import DescriptionError
from teo_lut_executor.execution.interface import (
    Activity,
    Begun,
    DriverReport,
    Effect,
    Finished,
    HaltReady,
    PlanWanted,
    ReturnWanted,
    Sentence,
    Status,
    StopReady,
    TrajectoryReady,
)
from teo_lut_executor.execution.queue import ExecutionQueue
from teo_lut_executor.node.diagnostics import Statistics, diagnose
from teo_lut_executor.node.driver_link import DriverLink, claim
from teo_lut_executor.node.messages import to_status, to_stop, to_trajectory
from teo_lut_executor.node.parameters import PARAMETERS, planner_settings_from, queue_settings_from
from teo_lut_executor.node.sentence_intake import SentenceIntake, open_journal
from teo_lut_executor.node.services import Services
from teo_lut_executor.planning_process import PlanningProcess
from teo_lut_executor.planning_worker import NotPlanned, Opened, Planned
from teo_motion.planner import Planner
from teo_signs.errors import LutError, PlanError

# How often the queue looks at the clock and the robot [Hz], and feedback is sent [Hz].
_STEP_RATE = 50.0
_FEEDBACK_RATE = 10.0


class ExecutorNode(SelfStartingNode):
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
        super().__init__("executor", PARAMETERS, context=context, parameter_overrides=parameter_overrides)
        self._configured = self._active = False
        self._yields = False  # whether another executor signs
        self._diagnostics = DiagnosticsPublisher(self, "sentences")
        self.add_on_set_parameters_callback(self._check_parameters)
        self.add_post_set_parameters_callback(self._apply_parameters)

    def start(self) -> bool:
        """Configure and activate; where another executor signs, stay as it is and say so."""
        return super().start() or self._yields

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:  # noqa: ARG002 - the API's
        """Open the table, start the process that plans, and listen."""
        try:
            settings = planner_settings_from(self._values())
            self._lut = settings.table()
            self._checker: Planner = settings.planner(self._lut, None, self._lut.language)
            queue_settings = queue_settings_from(self._values())
        except (LutError, PlanError, DescriptionError) as error:
            self.get_logger().error(f"cannot be configured: [{error.code}] {error}")
            return TransitionCallbackReturn.FAILURE
        try:
            domain = self.context.get_domain_id()
            self._claim = claim(self.resolve_topic_name("joint_trajectory"), domain)
        except PlanError as error:
            self._yield(error)
            return TransitionCallbackReturn.FAILURE
        self._queue = ExecutionQueue(self._checker.limits, queue_settings)
        self._statistics = Statistics()
        self._journal = open_journal(self, self._value("journal"))
        answered = self.create_guard_condition(self._on_answers)
        self._planning = PlanningProcess(settings, answered.trigger)
        self._communicate()
        self._entities.append(answered)
        self._configured = True
        self._intake.take_over_journal()
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
        if self._configured:
            self._intake.forget_goals()  # nobody runs callbacks any more: clients see the server go
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
        # Best effort takes reliable publishers as well as those of sensor data; only the latest state counts.
        sensor = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
        self._entities: list[Any] = [
            self._statuses,
            self.create_subscription(JointState, "joint_states", self._on_joint_states, sensor),
            self.create_timer(1.0 / _STEP_RATE, self._step),
            self.create_timer(1.0 / _FEEDBACK_RATE, self._give_feedback),
            self.create_timer(DIAGNOSTICS_PERIOD, self._publish_diagnostics),
        ]
        self._offered = Services(
            self,
            self._lut,
            self._queue,
            makes=lambda sign: self._checker.makes(sign),
            now=self._now,
            carry_out=self._carry_out,
        )
        self._intake = SentenceIntake(
            self,
            self._queue,
            self._journal,
            journal_age=self._value("journal_age"),
            check=self._check_sentence,
            now=self._now,
            carry_out=self._take,
            own_language=lambda: self._lut.language.code,
        )

    def _yield(self, error: PlanError) -> None:
        """Say that another executor signs, from now on."""
        message = f"[{error.code}] {error}"
        self.get_logger().error(f"cannot be configured: {message}")
        if not self._yields:
            self._yields = True
            self.create_timer(DIAGNOSTICS_PERIOD, lambda: self._publish_yielding(message))

    def _publish_yielding(self, message: str) -> None:
        if not self._configured:
            self._diagnostics.publish(Diagnosis(Level.ERROR, message, {}))

    def _let_go(self) -> None:
        if not self._configured:
            return
        self._configured = self._active = False
        self._carry_out(self._queue.deactivate(self._now()))
        self._carry_out(self._queue.clear(self._now()))
        self._planning.close()
        self._claim.close()
        self._intake.close()
        self._driver.close()
        self._offered.close()
        for entity in self._entities:
            for destroy in (
                self.destroy_publisher,
                self.destroy_subscription,
                self.destroy_timer,
                self.destroy_guard_condition,
            ):
                if destroy(entity):
                    break

    def _check_sentence(self, sentence: Sentence) -> None:
        """See whether a sentence is one, as far as that is known without planning it.

        Raises:
            PlanError: It is none, or of another language ("other_language").
        """
        language = self._lut.language
        if sentence.language not in ("", language.code):
            raise PlanError(
                "other_language",
                f"expected a sentence of {language.names.short} ({language.code}), the language in use, got "
                f"one of {sentence.language!r}; give executor and translator the same parameter language",
            )
        self._offered.refresh()
        self._checker.check(sentence.tokens, form=sentence.form)

    def _take(self, events: Sequence[Effect]) -> None:
        """A sentence was taken or refused: begin with it now if nothing is before it."""
        self._carry_out(events)
        self._step()

    def _on_joint_states(self, message: JointState) -> None:
        stamp = message.header.stamp
        problem = self._queue.joint_states(
            message.name,
            message.position,
            message.velocity,
            self._now(),
            stamp=stamp.sec + stamp.nanosec * 1e-9,
        )
        if problem:
            self.get_logger().warning(f"joint state not taken: {problem}", throttle_duration_sec=5.0)

    def _on_driver_report(self, report: DriverReport) -> None:
        self._carry_out(self._queue.driver_state(report, self._now()))

    def _on_driver_refused(self, number: int, reason: str) -> None:
        self._carry_out(self._queue.driver_refused(number, reason, self._now()))

    def _step(self) -> None:
        self._carry_out(self._queue.step(self._now(), obstacle=self._obstacle()))

    def _obstacle(self) -> str:
        """Why no motion may begin, as far as the node knows; empty if it may."""
        if not self._active:
            return "the executor is not active"
        if not self._planning.ready:
            return "waiting for the planner to load"
        return "" if self._driver.listening else "waiting for a driver to take joint_trajectory"

    def _carry_out(self, events: Sequence[Effect]) -> None:
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
                case HaltReady():
                    self._driver.halt()
                case Begun():
                    self._journal.begun(event.ticket)
                case Status():
                    self._publish(event)
                case Finished():
                    self._statistics.ended[event.outcome] += 1
                    self._intake.finish(event)

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
        if self.context.ok():  # not where it was told to end before it had begun to spin
            self._statuses.publish(to_status(status))
        if status.code:
            named = "" if status.sentence is None else f" (utterance {status.sentence.utterance_id})"
            self.get_logger().warning(f"{status.activity.name}: [{status.code}] {status.message}{named}")
        elif status.activity == Activity.WAITING:
            self.get_logger().info(status.message)

    def _give_feedback(self) -> None:
        progress = self._queue.progress(self._now())
        if progress is not None:
            self._intake.give_feedback(progress)

    def _publish_diagnostics(self) -> None:
        if self._journal.problem:
            self.get_logger().warning(
                f"the journal is not written: {self._journal.problem}", throttle_duration_sec=60.0
            )
        self._diagnostics.publish(
            diagnose(
                self._statistics,
                active=self._active,
                queued=self._queue.queued,
                planner_restarts=self._planning.restarts,
                others_refused=self._driver.others_refused,
                journal=self._journal,
            )
        )

    def _check_parameters(self, parameters: Sequence[Parameter]) -> SetParametersResult:
        asked = {item.name: item.value for item in parameters}
        values = self._values() | asked
        try:
            queue_settings_from(values)
            settings = planner_settings_from(values)
            settings.planner({}, None)
            if "language" in asked:
                self._next_lut = settings.table()
        except (PlanError, LutError) as error:
            return SetParametersResult(successful=False, reason=f"[{error.code}] {error}")
        return SetParametersResult(successful=True)

    def _apply_parameters(self, parameters: Sequence[Parameter]) -> None:
        if not self._configured:  # configuring reads them
            return
        settings = planner_settings_from(self._values())
        if "language" in {item.name for item in parameters}:
            self._lut = self._offered.lut = self._next_lut
            self.get_logger().info(f"{len(self._lut)} signs of {self._lut.place}")
        self._checker = settings.planner(self._lut, None, self._lut.language)
        self._planning.configure(settings)
        self._queue.configure(self._checker.limits, queue_settings_from(self._values()))

    def _now(self) -> float:
        return float(self.get_clock().now().nanoseconds) * 1e-9


def main(arguments: list[str] | None = None) -> None:
    """Run the node until it is told to end."""
    run_self_starting(ExecutorNode, arguments, PARAMETERS)


if __name__ == "__main__":
    main()
