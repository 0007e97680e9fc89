"""How Python shares itself between a node's threads."""

from __future__ import annotations

import gc
import sys

SWITCH_INTERVAL = 0.0005
"""[s] after which a thread that runs lets another one in. MediaPipe's threads call Python eleven times for an
image; at Python's own 5 ms each of these calls may stop a network for as long as another image's second half
or a message takes."""


def tune_interpreter() -> None:
    """Let native threads wait less for Python, and spare the collector what is there to stay.

    For the process of a node, once all is loaded: a full collection stops all threads for 30 ms, nearly all
    of it for modules and classes that never go.
    """
    sys.setswitchinterval(SWITCH_INTERVAL)
    gc.collect()
    gc.freeze()
