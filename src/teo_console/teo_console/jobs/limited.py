# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Starts a command within limits: `python limited.py CPU_S MEMORY_B FILE_B COMMAND ...`.

A process of its own sets them and then becomes the command, so that they hold for all that it starts, too.
"""

from __future__ import annotations

import os
import resource
import sys

# Less urgent than what signs, which has deadlines; more would starve them beside other work.
_NICENESS = 5


def main(arguments: list[str]) -> None:
    """Set the limits of this process and become the command.

    Args:
        arguments: Processor time [s], address space [B], largest file written [B], then the command.
    """
    seconds, memory, file = map(int, arguments[:3])
    for which, limit in (
        (resource.RLIMIT_CPU, seconds),
        (resource.RLIMIT_AS, memory),
        (resource.RLIMIT_FSIZE, file),
        (resource.RLIMIT_CORE, 0),
    ):
        hard = resource.getrlimit(which)[1]
        within = limit if hard == resource.RLIM_INFINITY else min(limit, hard)
        resource.setrlimit(which, (within, within))
    os.nice(_NICENESS)
    os.execvp(arguments[3], arguments[3:])


if __name__ == "__main__":
    main(sys.argv[1:])
