# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The `ros2` command: finds the sub-command that is asked for and loads only that."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Mapping, Sequence
from typing import TextIO, cast

from teo_ros2cli.cli.dispatch import Entry, Group, choose

# Command, verb, and the functions that do it.
COMMANDS: Mapping[str, Group | Entry] = {
    "action": Group(
        "Various action related sub-commands",
        {
            "info": Entry("Print information about an action", "action:info"),
            "list": Entry("Output a list of action names", "action:list"),
            "send_goal": Entry("Send an action goal", "action:send_goal"),
            "type": Entry("Print an action's type", "action:type"),
        },
    ),
    "bag": Group(
        "Various rosbag related sub-commands",
        {
            "convert": Entry("Write bags anew: merged, filtered, in another layout", "bag.stored:convert"),
            "info": Entry("Print information about a bag to the screen", "bag.stored:info"),
            "play": Entry("Play back ROS data from a bag", "bag.play"),
            "reindex": Entry("Repair a bag that was not finished, and its metadata", "bag.stored:reindex"),
            "record": Entry("Record ROS data to a bag", "bag.record"),
        },
    ),
    "component": Group(
        "Various component related sub-commands",
        {
            "list": Entry("Output a list of running containers and components", "component:list"),
            "load": Entry("Load a component into a container node", "component:load"),
            "types": Entry("Output a list of components registered in the ament index", "component:types"),
            "unload": Entry("Unload a component from a container node", "component:unload"),
        },
    ),
    "daemon": Group(
        "Various daemon related sub-commands",
        {
            "start": Entry("Start the daemon: there is none to start", "discovery:daemon_start"),
            "status": Entry("Output the status of the daemon", "discovery:daemon_status"),
            "stop": Entry("Stop the daemon: there is none to stop", "discovery:daemon_status"),
        },
    ),
    "doctor": Entry("Check ROS setup and other potential issues", "doctor"),
    "interface": Group(
        "Show information about ROS interfaces",
        {
            "list": Entry("List all interface types available", "interface:list"),
            "package": Entry(
                "Output a list of available interface types within one package", "interface:package"
            ),
            "packages": Entry("Output a list of packages that provide interfaces", "interface:packages"),
            "proto": Entry("Output an interface prototype", "interface:proto"),
            "show": Entry("Output the interface definition", "interface:show"),
        },
    ),
    "lifecycle": Group(
        "Various lifecycle related sub-commands",
        {
            "get": Entry("Get lifecycle state for one or more nodes", "lifecycle:get"),
            "list": Entry("Output a list of available transitions", "lifecycle:list"),
            "nodes": Entry("Output a list of nodes with lifecycle", "lifecycle:nodes"),
            "set": Entry("Trigger lifecycle state transition", "lifecycle:set"),
        },
    ),
    "multicast": Group(
        "Various multicast related sub-commands",
        {
            "receive": Entry("Receive a single UDP multicast packet", "discovery:receive"),
            "send": Entry("Send a single UDP multicast packet", "discovery:send"),
        },
    ),
    "node": Group(
        "Various node related sub-commands",
        {
            "info": Entry("Output information about a node", "node:info"),
            "list": Entry("Output a list of available nodes", "node:list"),
        },
    ),
    "param": Group(
        "Various param related sub-commands",
        {
            "delete": Entry("Delete parameter", "param:delete"),
            "describe": Entry("Show descriptive information about declared parameters", "param:describe"),
            "dump": Entry("Show all of the parameters of a node in a YAML file format", "param:dump"),
            "get": Entry("Get parameter", "param:get"),
            "list": Entry("Output a list of available parameters", "param:list"),
            "load": Entry("Load parameter file for a node", "param:load"),
            "set": Entry("Set parameter", "param:set"),
        },
    ),
    "pkg": Group(
        "Various package related sub-commands",
        {
            "executables": Entry("Output a list of package specific executables", "pkg:executables"),
            "list": Entry("Output a list of available packages", "pkg:list"),
            "prefix": Entry("Output the prefix path of a package", "pkg:prefix"),
            "xml": Entry("Output the XML of the package manifest or a specific tag", "pkg:xml"),
        },
    ),
    "run": Entry("Run a package specific executable", "pkg:run"),
    "service": Group(
        "Various service related sub-commands",
        {
            "call": Entry("Call a service", "service:call"),
            "echo": Entry("Echo a service", "service:echo"),
            "find": Entry("Output a list of available services of a given type", "service:find"),
            "info": Entry("Print information about a service", "service:info"),
            "list": Entry("Output a list of available services", "service:list"),
            "type": Entry("Output a service's type", "service:type"),
        },
    ),
    "topic": Group(
        "Various topic related sub-commands",
        {
            "bw": Entry("Display bandwidth used by topic", "topic.measuring:bw"),
            "delay": Entry("Display delay of topic from timestamp in header", "topic.measuring:delay"),
            "echo": Entry("Output messages from a topic", "topic.echo"),
            "find": Entry("Output a list of available topics of a given type", "topic.listing:find"),
            "hz": Entry("Print the average receiving rate to screen", "topic.measuring:hz"),
            "info": Entry("Print information about a topic", "topic.listing:info"),
            "list": Entry("Output a list of available topics", "topic.listing:list"),
            "pub": Entry("Publish a message to a topic", "topic.pub"),
            "type": Entry("Print a topic's type", "topic.listing:type"),
        },
    ),
    "wtf": Entry("Use `wtf` as alias to `doctor`", "doctor"),
}
# The shell sets it when TAB is pressed.
_COMPLETING = "_ARGCOMPLETE"
_BUFFERING = "--use-python-default-buffering"


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return the exit status.

    Args:
        arguments: What follows `ros2`; the process's own arguments unless given.
    """
    try:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])  # that waits since `bin/ros2`
        if _COMPLETING in os.environ:
            from teo_ros2cli.cli.completion import complete

            complete(COMMANDS)
        words = list(sys.argv[1:] if arguments is None else arguments)
        if words[:1] == [_BUFFERING]:
            words.pop(0)
        else:
            # A line that is printed is seen at once, by a pipe as well.
            for stream in (sys.stdout, sys.stderr):
                if hasattr(stream, "reconfigure"):
                    stream.reconfigure(line_buffering=True)
        return choose("ros2", "command", Group("ros2 is a command-line tool for ROS 2.", COMMANDS), words)
    except KeyboardInterrupt:
        return int(signal.SIGINT)
    except BrokenPipeError:
        # Whoever read the output has left: `ros2 topic list | head -1`. Even at exit nothing can be written.
        os.dup2(os.open(os.devnull, os.O_WRONLY), cast(TextIO, sys.stdout).fileno())
        return 128 + int(signal.SIGPIPE)


if __name__ == "__main__":
    sys.exit(main())
