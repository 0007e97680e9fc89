# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""One executor moves a robot: two that hear the same sentences would both send their motions to it."""

from __future__ import annotations

import socket

from teo_signs.errors import PlanError


def claim(topic: str, domain: int) -> socket.socket:
    """Claim a topic for this process, among those of the machine.

    Args:
        topic: Its full name.
        domain: Of DDS.

    Returns:
        What holds the claim until it is closed, or the process ends, however that comes about.

    Raises:
        PlanError: Another executor sends to it ("other_executor").
    """
    # A name that is no file: Linux forgets it with the process, also with one that is killed.
    held = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
    try:
        held.bind(f"\0teo_lut_executor.{domain}.{topic}")
    except OSError as error:
        held.close()
        raise PlanError(
            "other_executor",
            f"expected no other executor to send to {topic}, one does, and this one signs nothing: end one "
            "of them, or give it a namespace of its own",
        ) from error
    return held
