# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""The settings are the process's, and so are tried in one of their own."""

from __future__ import annotations

import subprocess
import sys

WAITS = """
import gc, sys
from teo_skeleton_retriever.node.latest_frame_pipeline import SWITCH_INTERVAL, tune_interpreter

tune_interpreter()
assert sys.getswitchinterval() <= SWITCH_INTERVAL * 1.01

assert gc.get_freeze_count() > 1000  # what is loaded is not looked through again
class Node: pass
one, other = Node(), Node()
one.other, other.other = other, one
del one, other
assert gc.collect() >= 2  # garbage of later is still found
"""


def test_others_are_let_in_soon_and_later_garbage_is_still_collected() -> None:
    subprocess.run([sys.executable, "-c", WAITS], check=True, timeout=60)
