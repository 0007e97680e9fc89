# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import os
import signal
import sys
import threading
from types import ModuleType

import pytest
from rclpy.executors import ExternalShutdownException

from teo_ros2cli.cli.dispatch import Entry, Group, choose


def end_from_outside(_: object) -> int:
    raise ExternalShutdownException


def test_a_context_that_ends_before_the_interruption_is_told_is_interrupted(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    module = ModuleType("ended")
    module.__dict__["run"] = end_from_outside
    monkeypatch.setitem(sys.modules, "teo_ros2cli.cli.ended", module)
    group = Group("all", {"ended": Entry("ends", "ended")})
    assert choose("ros2", "command", group, ["ended"]) == 128 + signal.SIGTERM
    threading.Timer(0.01, os.kill, (os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        choose("ros2", "command", group, ["ended"])
