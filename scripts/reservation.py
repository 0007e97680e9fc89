# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A domain of DDS and a folder that no other run on this machine has meanwhile, so that two do not meet."""

from __future__ import annotations

import errno
import fcntl
import os
import socket
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

# The tests use 20 to 101, people 0 unless they say otherwise.
DOMAINS = range(10, 20)


class OccupiedError(Exception):
    """Another run has it; the message says what, and what to do."""


@contextmanager
def domain() -> Iterator[int]:
    """Reserve a domain while the block runs: that of `ROS_DOMAIN_ID` where it is set, else one of `DOMAINS`.

    Yields:
        The domain's number, also in `ROS_DOMAIN_ID` of this process and those that it starts.

    Raises:
        OccupiedError: Other runs have all of `DOMAINS`.
        ValueError: `ROS_DOMAIN_ID` is no number.
    """
    given = os.environ.get("ROS_DOMAIN_ID", "").strip()
    if given:
        yield int(given)
        return
    for number in DOMAINS:
        with closing(socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)) as held:
            try:
                # A name without a file: one for each network of the machine, as domains are, and whoever dies
                # gives it back.
                held.bind(f"\0teo_domain_{number}")
            except OSError as error:
                if error.errno != errno.EADDRINUSE:
                    raise
                continue
            os.environ["ROS_DOMAIN_ID"] = str(number)
            try:
                yield number
            finally:
                del os.environ["ROS_DOMAIN_ID"]
            return
    raise OccupiedError(
        f"expected a free domain among {DOMAINS[0]} to {DOMAINS[-1]}, other runs have all of them: wait "
        "until one ends, or choose one yourself with ROS_DOMAIN_ID"
    )


@contextmanager
def folder(path: Path) -> Iterator[None]:
    """Reserve a folder while the block runs, and make it if it is not there.

    Raises:
        OccupiedError: Another run has it.
        OSError: It cannot be made.
    """
    path.mkdir(parents=True, exist_ok=True)
    descriptor = os.open(path, os.O_RDONLY | os.O_DIRECTORY)
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise OccupiedError(
                f"expected {path}/ for this run, another one is writing there: choose another --out"
            ) from error
        yield
    finally:
        os.close(descriptor)
