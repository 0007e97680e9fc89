# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The `ros2` command: finds the sub-command that is asked for and loads only that."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Sequence
from typing import TextIO, cast

from teo_ros2cli.cli.dispatch import Entry, choose

COMMANDS = {
    "action": Entry("teo_ros2cli.cli.action", "Various action related sub-commands"),
    "bag": Entry("teo_ros2cli.cli.bag", "Various rosbag related sub-commands"),
    "component": Entry("teo_ros2cli.cli.component", "Various component related sub-commands"),
    "daemon": Entry("teo_ros2cli.cli.daemon", "Various daemon related sub-commands"),
    "doctor": Entry("teo_ros2cli.cli.doctor", "Check ROS setup and other potential issues"),
    "interface": Entry("teo_ros2cli.cli.interface", "Show information about ROS interfaces"),
    "lifecycle": Entry("teo_ros2cli.cli.lifecycle", "Various lifecycle related sub-commands"),
    "multicast": Entry("teo_ros2cli.cli.multicast", "Various multicast related sub-commands"),
    "node": Entry("teo_ros2cli.cli.node", "Various node related sub-commands"),
    "param": Entry("teo_ros2cli.cli.param", "Various param related sub-commands"),
    "pkg": Entry("teo_ros2cli.cli.pkg", "Various package related sub-commands"),
    "run": Entry("teo_ros2cli.cli.run", "Run a package specific executable"),
    "service": Entry("teo_ros2cli.cli.service", "Various service related sub-commands"),
    "topic": Entry("teo_ros2cli.cli.topic", "Various topic related sub-commands"),
    "wtf": Entry("teo_ros2cli.cli.doctor", "Use `wtf` as alias to `doctor`"),
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
        return choose("ros2", "ros2 is a command-line tool for ROS 2.", "command", COMMANDS, words)
    except KeyboardInterrupt:
        return int(signal.SIGINT)
    except BrokenPipeError:
        # Whoever read the output has left: `ros2 topic list | head -1`. Even at exit nothing can be written.
        os.dup2(os.open(os.devnull, os.O_WRONLY), cast(TextIO, sys.stdout).fileno())
        return 128 + int(signal.SIGPIPE)


if __name__ == "__main__":
    sys.exit(main())
