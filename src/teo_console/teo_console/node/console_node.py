# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`console_node`: the page that shows what TEO signs. Closing it neither moves nor stops a robot."""

from __future__ import annotations

import contextlib
import socket
import sys
from collections.abc import Iterable, Sequence
from typing import Any

import segno
from aiohttp import web
from msgspec.structs import replace
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter

from teo_common.errors import CodedError
from teo_common.installed_packages import package_path
from teo_common.node_process import run_node
from teo_common.parameters import declare_parameters
from teo_console.api.routes import all_routes
from teo_console.api.workbench import Folders, Workbench
from teo_console.jobs.commands import Commands
from teo_console.node import messages
from teo_console.node.observer import Observer
from teo_console.node.parameters import PARAMETERS
from teo_console.node.robot_client import RobotClient
from teo_console.protocol import Names, Situation, Welcome, encode, encode_pose
from teo_console.server.access import LOOPBACK_NAMES, Access
from teo_console.server.app import make_app
from teo_console.server.hub import Hub
from teo_console.server.thread import Bridge, ServerThread
from teo_console.situation import SharedSituation
from teo_description.humanoid import load_humanoid
from teo_sign_languages import Language, LanguageError, available_languages, load_language

# How often pages are told what has changed [Hz]: often enough that nothing seems late.
_SITUATION_RATE = 10.0
# How often they are told that nothing has [s], by which a page knows that the node lives.
_REPEAT = 1.0


class ConsoleNode(Node):
    """Shows pages what goes on, and carries out what they ask for."""

    def __init__(
        self, *, context: Context | None = None, parameter_overrides: Iterable[Parameter] = ()
    ) -> None:
        """Listen to the graph and serve the page.

        Args:
            context: The ROS context; the default one if None.
            parameter_overrides: Values in place of the defaults of `parameters.PARAMETERS`.

        Raises:
            ConsoleError: The page cannot be served: the code says why.
            DescriptionError: There is no such robot.
            LanguageError: There is no such language.
        """
        super().__init__("console", context=context, parameter_overrides=list(parameter_overrides))
        declare_parameters(self, PARAMETERS)
        robot = load_humanoid(self._value("robot")).name
        language = load_language(self._value("language"))
        self._commands = Commands(robot=robot, language=language.code)
        self._names = _names(robot, language)
        self._situation = SharedSituation()
        self._client = RobotClient(self, self._situation)
        self._observer = Observer(self, self._situation, now=self._now, changed=self._client.look_at_queue)
        self._bridge = Bridge()
        self._refused: tuple[str, str] | None = None
        self._joints: tuple[str, ...] = ()
        self._robot_known = False
        self._positions: Sequence[float] = ()
        self._pose_sent = self._situation_sent = -_REPEAT
        self._last: Situation | None = None
        asked = self.create_guard_condition(lambda: self._bridge.serve_all(self._client.serve))
        self._bridge.wake = asked.trigger
        self._hub = Hub(self._bridge.ask)
        address = self._value("address")
        self._access = Access.for_address(address, self._host_names())
        self._server = ServerThread(self._make_app, address, self._value("port"))
        self._send_welcome()
        self.create_timer(1.0 / self._value("pose_rate"), self._send_pose)
        self.create_timer(1.0 / _SITUATION_RATE, self._send_situation)
        self._say_where(address)

    @property
    def port(self) -> int:
        """Where the page is served."""
        return self._server.port

    def destroy_node(self) -> None:
        """Send the pages away, then end."""
        self._server.close()
        super().destroy_node()

    def _value(self, name: str) -> Any:
        return self.get_parameter(name).value

    def _now(self) -> float:
        return float(self.get_clock().now().nanoseconds) * 1e-9

    def _make_app(self) -> web.Application:
        workbench = self._workbench = Workbench(Folders.of_user(), self._commands)

        async def clear_up(_: web.Application) -> None:
            await workbench.close()

        app = make_app(
            web_folder=package_path("teo_console", "web"),
            access=self._access,
            hub=self._hub,
            urdf=lambda: self._observer.urdf,
            routes=all_routes(workbench),
        )
        app.on_cleanup.append(clear_up)
        return app

    def _host_names(self) -> frozenset[str]:
        """Names under which others reach this machine, beside its addresses."""
        given = {name.strip().lower() for name in self._value("allowed_hosts").split(",")} - {""}
        return frozenset({socket.gethostname().lower(), *_own_addresses(), *given})

    def _send_welcome(self) -> None:
        self._robot_known = bool(self._observer.urdf)
        welcome = Welcome(names=self._names, joints=self._joints, robot=self._robot_known)
        self._server.call(self._hub.welcome, encode(welcome))

    def _send_pose(self) -> None:
        state = self._observer.take_joint_state()
        if bool(self._observer.urdf) != self._robot_known:
            self._send_welcome()
        if state is None or not self._hub.pages:
            return
        if tuple(state.name) != self._joints:
            self._joints = tuple(state.name)
            self._send_welcome()
        now = self._now()
        if state.position == self._positions and now - self._pose_sent < _REPEAT:
            return
        self._positions, self._pose_sent = state.position, now
        frame = encode_pose(messages.seconds(state.header.stamp), state.position)
        self._server.call(self._hub.pose, frame)

    def _follow(self) -> None:
        """Speak of the robot and the language that run: others may have changed the language."""
        robot = self._observer.robot or self._commands.robot
        language = self._observer.language or self._commands.language
        if (robot, language) in (self._refused, (self._commands.robot, self._commands.language)):
            return
        try:
            load_humanoid(robot)
            names = _names(robot, load_language(language))
        except CodedError as error:
            self._refused = robot, language  # to be said once
            self.get_logger().warning(f"the page goes on as before: [{error.code}] {error}")
            return
        self._commands, self._names = Commands(robot=robot, language=language), names
        self._server.call(self._workbench.use, self._commands)
        self._send_welcome()

    def _send_situation(self) -> None:
        self._follow()
        now = self._now()
        situation = self._situation.snapshot(now, pages=self._hub.pages)
        unchanged = self._last is not None and replace(situation, stamp=self._last.stamp) == self._last
        if unchanged and now - self._situation_sent < _REPEAT:
            return
        self._last, self._situation_sent = situation, now
        self._server.call(self._hub.situation, encode(situation))

    def _say_where(self, address: str) -> None:
        if self._access.token is None:
            self.get_logger().info(f"the page is at {self._access.link(address, self.port)}")
            return
        hosts = sorted(self._access.hosts - LOOPBACK_NAMES)
        link = self._access.link(next(iter(_own_addresses()), hosts[0]), self.port)
        self.get_logger().info(
            f"the page is at {link} (also as {', '.join(hosts)}); whoever has the link can use it"
        )
        segno.make(link).terminal(out=sys.stdout, compact=True)
        sys.stdout.flush()


def _names(robot: str, language: Language) -> Names:
    """What pages call them, and the languages to choose from."""
    languages = {language.code: language.names.short}
    for code in available_languages():
        with contextlib.suppress(LanguageError):  # of a broken one the page need not know
            other = load_language(code)
            if robot in other.robots:
                languages[code] = other.names.short
    return Names(
        robot=robot.upper(),
        signs=language.names.short,
        spoken=language.spoken.code,
        example=language.sentences[0],
        language=language.code,
        languages=languages,
    )


def _own_addresses() -> list[str]:
    """IPv4 addresses under which others reach this machine; none without a network."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            # Nothing is sent: the system only chooses the interface that leads out (an address of RFC 5737).
            probe.connect(("192.0.2.1", 9))
        except OSError:
            return []
        return [str(probe.getsockname()[0])]


def main(arguments: Sequence[str] | None = None) -> None:
    """Serve the page until told to end."""
    try:
        run_node(ConsoleNode, arguments, PARAMETERS)
    except CodedError as error:
        sys.exit(f"console: [{error.code}] {error}")
