# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`capture_node`: the service `capture_sign`, which records one sign live and saves it in the table."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from concurrent.futures import Future as Work
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from rcl_interfaces.msg import SetParametersResult
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.task import Future
from std_msgs.msg import String
from teo_sign_msgs.msg import SkeletonArray
from teo_sign_msgs.srv import CaptureSign

from teo_common.errors import CodedError
from teo_common.node_process import run_node
from teo_common.parameters import declare_parameters
from teo_description.robot import Robot
from teo_sign_capture.entries.bag_capture import (
    Saved,
    Settings,
    check_free,
    default_recordings,
    keep_and_capture,
)
from teo_sign_capture.node.parameters import CAPTURE_PARAMETERS
from teo_sign_capture.recordings.live_take import LiveTake, Phase
from teo_sign_languages import LanguageError, load_language
from teo_signs.errors import LutError
from teo_signs.look_up_table import user_lut_directory
from teo_signs.sign_schema import SOURCE_STANDINGS

_STEP_RATE = 10.0  # [Hz] at which the countdown is looked at
_CAPTURING, _IDLE = "capturing", "idle"


class CaptureNode(Node):
    """Records a sign when asked to. Knows no geometry: see `LiveTake` and `capture_bags`."""

    def __init__(
        self, *, context: Context | None = None, parameter_overrides: Iterable[Parameter] = ()
    ) -> None:
        """Serve.

        Args:
            context: Of rclpy; None for the global one.
            parameter_overrides: Parameters beside those of the command line.

        Raises:
            DescriptionError: There is no such robot.
            LanguageError: There is no such language.
        """
        super().__init__("capture", context=context, parameter_overrides=list(parameter_overrides))
        declare_parameters(self, CAPTURE_PARAMETERS)
        load_language(self._value("language"))  # one that is not there is refused now
        self.add_on_set_parameters_callback(self._check_parameters)
        self._robot = Robot.load(self._value("robot"))  # used by the worker alone
        self._worker = ThreadPoolExecutor(1)
        self._request: CaptureSign.Request | None = None
        self._take: LiveTake | None = None
        self._work: Work[Saved] | None = None
        self._answer: Future | None = None
        self._told = ""
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self._state = self.create_publisher(String, "capture_state", latched)
        self.create_subscription(SkeletonArray, "skeletons", self._on_skeletons, 10)
        # An answer that is waited for must hold up neither the clock nor the next request.
        group = ReentrantCallbackGroup()
        self.create_service(CaptureSign, "capture_sign", self._on_capture, callback_group=group)
        self.create_timer(1.0 / _STEP_RATE, self._step)
        self._tell(_IDLE)

    def destroy_node(self) -> None:
        """Let the worker finish what it writes, then go."""
        self._worker.shutdown(cancel_futures=True)
        super().destroy_node()

    def _on_skeletons(self, message: SkeletonArray) -> None:
        if self._take is not None:
            self._take.add(message, self._now())

    async def _on_capture(
        self, request: CaptureSign.Request, response: CaptureSign.Response
    ) -> CaptureSign.Response:
        try:
            self._begin(request)
            assert self._answer is not None
            saved: Saved = await self._answer
        except LutError as error:
            response.code, response.message = error.code, str(error)
            self.get_logger().warning(f"not captured: [{error.code}] {error}")
            return response
        sign = saved.captured.sign
        response.success, response.path = True, str(saved.path)
        response.picture = str(saved.pictures[0]) if saved.pictures else ""
        response.quality = "\n".join(f"{name} {figure:g}" for name, figure in sign.quality.items())
        response.message = " ".join((f"{sign.gloss} is captured.", *saved.warnings))
        self.get_logger().info(f"captured {sign.gloss}: {saved.path}")
        return response

    def _begin(self, request: CaptureSign.Request) -> None:
        if self._request is not None:
            raise LutError(
                "busy", f"expected one sign at a time, got {request.gloss!r} while another is made"
            )
        check_free(request.gloss, self._settings(request.replace))
        self._take = LiveTake(
            started=self._now(), countdown=request.countdown, longest=self._value("longest_wait")
        )
        self._request, self._answer = request, Future(executor=self.executor)

    def _step(self) -> None:
        if self._work is not None:
            self._finish_work(self._work)
        elif self._take is not None and self._request is not None:
            state = self._take.step(self._now())
            if state.phase is Phase.COUNTDOWN:
                self._tell(f"{state.phase.value} {state.remaining:.0f}")
            elif state.phase is Phase.SIGN:
                self._tell(state.phase.value)
            elif state.phase is Phase.DONE:
                self._tell(_CAPTURING)
                request, messages = self._request, self._take.messages
                self._work = self._worker.submit(
                    keep_and_capture,
                    self._robot,
                    request.gloss,
                    messages,
                    Path(self._value("recordings_directory") or default_recordings()),
                    self._settings(request.replace),
                )
            else:
                self._end(problem=state.problem)

    def _finish_work(self, work: Work[Saved]) -> None:
        if not work.done():
            return
        problem = work.exception()
        if problem is not None and not isinstance(problem, LutError):
            self.get_logger().error(f"capture failed by a mistake of the program: {problem!r}")
            problem = LutError(
                "crashed", f"expected a capture that ends well, got {problem!r}: please report it"
            )
        self._end(saved=None if problem is not None else work.result(), problem=problem)

    def _end(self, *, saved: Saved | None = None, problem: LutError | None = None) -> None:
        answer = self._answer
        self._request = self._take = self._work = self._answer = None
        self._tell(_IDLE)
        assert answer is not None
        if problem is not None:
            answer.set_exception(problem)
        else:
            answer.set_result(saved)

    def _tell(self, state: str) -> None:
        if state != self._told:
            self._told = state
            self._state.publish(String(data=state))
            self.get_logger().info(state)

    def _settings(self, replace: bool) -> Settings:
        robot = self._robot.humanoid.name
        language = load_language(self._value("language")).code
        table = Path(self._value("lut_directory") or user_lut_directory(language, robot))
        return Settings(
            table=table,
            robot=robot,
            language=language,
            replace=replace,
            standing=self._value("standing"),
            licence=self._value("licence"),
            pictures=Path(self._value("pictures_directory") or table),
        )

    def _check_parameters(self, parameters: list[Parameter]) -> SetParametersResult:
        for parameter in parameters:
            if parameter.name == "standing" and parameter.value not in SOURCE_STANDINGS:
                reason = f"standing: expected one of {', '.join(SOURCE_STANDINGS)}, got {parameter.value!r}"
                return SetParametersResult(successful=False, reason=reason)
            if parameter.name == "language":
                try:
                    load_language(parameter.value)
                except LanguageError as error:
                    return SetParametersResult(successful=False, reason=f"[{error.code}] {error}")
            if parameter.name == "licence" and not parameter.value:
                return SetParametersResult(successful=False, reason="licence: expected a text, got none")
        return SetParametersResult(successful=True)

    def _value(self, name: str) -> Any:
        return self.get_parameter(name).value

    def _now(self) -> float:
        return float(self.get_clock().now().nanoseconds) * 1e-9


def main(arguments: list[str] | None = None) -> None:
    """Run the node until it is told to end."""
    try:
        run_node(CaptureNode, arguments, CAPTURE_PARAMETERS)
    except CodedError as error:
        sys.exit(f"capture: [{error.code}] {error}")


if __name__ == "__main__":
    main()
