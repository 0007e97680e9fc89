# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A node for the time of one command, and calling services with it."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from teo_common.dds_profiles import ProfileError, own_sockets, requested_profile
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.packages import package_prefix

# Begins the name of the node of a command; an underscore hides it.
_NODE_NAME_PREFIX = "_ros2cli"
# Longest time in which a signal is not looked at [s].
_STEP = 0.05


@contextmanager
def cli_node(
    name: str | None = None, *, use_sim_time: bool = False, rosout: bool = True, own_signals: bool = False
) -> Iterator[Any]:
    """Yield a node (rclpy.node.Node) with a context of its own; both end with the block.

    Args:
        name: Name of the node; a hidden one that holds the process's number unless given.
        use_sim_time: Take the time from `/clock`.
        rosout: Let the node publish its log on `/rosout`.
        own_signals: Leave SIGINT and SIGTERM to the caller instead of ending the context with them.

    Raises:
        Ros2CliError: `no_rclpy`, `invalid_name` for the node, or the reason for which the Fast DDS profiles
            that the environment asks for are not in force (`teo_common.dds_profiles`).
    """
    chosen = _prompt_discovery()
    try:
        import rclpy
        from rclpy.context import Context
        from rclpy.exceptions import InvalidNodeNameException
        from rclpy.executors import ExternalShutdownException
        from rclpy.parameter import Parameter
        from rclpy.signals import SignalHandlerOptions
    except ImportError as error:
        raise Ros2CliError(
            "no_rclpy", f"ROS 2 cannot be loaded ({error}): source the workspace, or install it, first"
        ) from error

    try:
        profile = requested_profile(rclpy.get_rmw_implementation_identifier()) if chosen else None
    except ProfileError as error:
        raise Ros2CliError(error.code, str(error)) from error
    sockets = own_sockets()
    context = Context()
    # No arguments: the command line is the command's own, not a node's.
    handlers = SignalHandlerOptions.NO if own_signals else SignalHandlerOptions.ALL
    rclpy.init(args=[], context=context, signal_handler_options=handlers)
    try:
        node = rclpy.create_node(
            name or f"{_NODE_NAME_PREFIX}_{os.getpid()}",
            context=context,
            enable_rosout=rosout,
            start_parameter_services=False,
            parameter_overrides=[Parameter("use_sim_time", value=True)] if use_sim_time else None,
        )
        try:
            if profile is not None:
                profile.check(sockets)
            yield node
        finally:
            node.destroy_node()
    except ProfileError as error:
        raise Ros2CliError(error.code, str(error)) from error
    except InvalidNodeNameException as error:
        raise Ros2CliError("invalid_name", str(error)) from error
    except Exception as error:
        if context.ok():
            raise
        # A signal came between two looks at the context: whatever fails now, fails for that.
        raise ExternalShutdownException from error
    finally:
        rclpy.try_shutdown(context=context)


def _prompt_discovery() -> bool:
    """Let this process announce itself and ask for acknowledgements often, unless the user set it up.

    Returns:
        Whether the user did.
    """
    names = ("FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE")
    if any(os.environ.get(name) for name in names):
        return True
    try:
        profile = package_prefix("teo_ros2cli") / "share" / "teo_ros2cli" / "config" / "fastdds.xml"
    except Ros2CliError:
        return False  # not installed as a package: slower, that is all
    if profile.is_file():
        os.environ[names[0]] = str(profile)
    return False


@contextmanager
def executor_of(node: Any) -> Iterator[Any]:
    """Yield an rclpy.executors.SingleThreadedExecutor that spins a node; it lets go of it after the block."""
    from rclpy.executors import SingleThreadedExecutor

    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    try:
        yield executor
    finally:
        executor.remove_node(node)


def wait_for(node: Any, future: Any, timeout: float | None = None) -> Any:
    """Spin a node until a future is done, and return its result.

    Args:
        node: The node that the future belongs to.
        future: An rclpy future.
        timeout: Longest time [s], None for no limit.

    Raises:
        Ros2CliError: `no_answer`, the time is over.
    """
    deadline = None if timeout is None else time.monotonic() + timeout
    with executor_of(node) as executor:
        while not future.done():
            if deadline is not None and time.monotonic() >= deadline:
                raise Ros2CliError("no_answer", f"No answer within {timeout} s")
            # In steps: while the middleware waits, Python does not see a signal.
            executor.spin_once(timeout_sec=_STEP)
    return future.result()


def call(
    node: Any,
    service_class: Any,
    name: str,
    *,
    timeout: float,
    answer_timeout: float | None = None,
    **request: Any,
) -> Any:
    """Call a service that is expected to be there, and return its response.

    Args:
        node: Who calls.
        service_class: Type of the service.
        name: Of the service.
        timeout: How long the service may take to appear [s].
        answer_timeout: How long it may then take to answer [s]; as long without.
        **request: Fields of the request.

    Raises:
        Ros2CliError: `service_unavailable`, it did not appear in time; `no_answer`.
    """
    client = node.create_client(service_class, name)
    try:
        if not client.wait_for_service(timeout_sec=timeout):
            raise Ros2CliError("service_unavailable", f"Service '{name}' is not available")
        return wait_for(node, client.call_async(service_class.Request(**request)), answer_timeout or timeout)
    finally:
        node.destroy_client(client)
