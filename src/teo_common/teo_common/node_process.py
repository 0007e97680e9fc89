# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A node's life as a process."""

from __future__ import annotations

import gc
import os
import signal
import socket
import sys
import threading
from collections.abc import Callable, Sequence

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.signals import uninstall_signal_handlers

from teo_common.dds_profiles import ProfileError, own_sockets, requested_profile

# A signal is noticed within this time, where nothing else happens [s].
_LOOK = 0.1


def tell_supervisor(state: str) -> None:
    """Tell whoever started us what we have come to, by systemd's protocol (sd_notify(3)), if it listens.

    Args:
        state: An assignment, as `READY=1`.
    """
    address = os.environ.get("NOTIFY_SOCKET", "")
    if not address:
        return
    try:
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as notes:
            notes.sendto(state.encode(), address.replace("@", "\0", 1) if address[0] == "@" else address)
    except OSError as error:  # a supervisor that is gone: the node serves without it
        print(f"expected a supervisor at NOTIFY_SOCKET={address}: {error.strerror}", file=sys.stderr)


def run_node(make_node: Callable[[], Node], arguments: Sequence[str] | None) -> None:
    """Make a node and run it until it is told to end (SIGINT, SIGTERM, a shutdown of its context).

    A supervisor that asks for it is told when the node is made: it can serve then.

    Args:
        make_node: Makes the node, once ROS is there. What it raises passes through, with ROS ended.
        arguments: Of the command line; None for the process's own.

    Raises:
        SystemExit: The Fast DDS profile that the environment asks for is not in force.
    """
    node: Node | None = None
    try:
        profile, sockets = requested_profile(rclpy.get_rmw_implementation_identifier()), own_sockets()
        rclpy.init(args=arguments)
        # Before the node: an executor that is told to end while it is being made leaves a half-made
        # object, whose destructor writes a traceback.
        executor = SingleThreadedExecutor()
        # What is loaded stays: a collection meanwhile, 50 ms where much is imported, finds next to nothing.
        gc.disable()
        node = make_node()
        if profile is not None:
            profile.check(sockets)
        # Models and tables are there to stay: a collection that walked them all would hold up a callback
        # for a tenth of a second.
        gc.collect()
        gc.freeze()
        gc.enable()
        tell_supervisor("READY=1")
        _spin(node, executor)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    except ProfileError as error:
        raise SystemExit(f"[{error.code}] {error}") from error
    except rclpy_implementation.RCLError:
        if rclpy.ok():
            raise  # else it was told to end before it had begun to spin
    finally:
        gc.enable()
        gc.unfreeze()  # else what is loaded is never taken down, and bindings complain of leaks
        if node is not None:
            node.destroy_node()
        rclpy.try_shutdown()


def _spin(node: Node, executor: SingleThreadedExecutor) -> None:
    """Run callbacks until told to end; the node can still publish then.

    The handlers of rclpy shut ROS down at once: what a node has to say at its end would reach nobody.
    """
    told = threading.Event()
    uninstall_signal_handlers()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: told.set())
    executor.add_node(node)
    while not told.is_set() and node.context.ok():
        executor.spin_once(timeout_sec=_LOOK)
