# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Fixtures for every test of the workspace: a DDS domain of its own for each test that asks for one."""

from __future__ import annotations

import fcntl
import gc
import itertools
import os
import signal
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

# Properties are about results, not about time, which a loaded machine stretches; and a failure must come
# again when it is looked into.
settings.register_profile(
    "teo", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("teo")

# A shell starts background jobs with SIGINT ignored, and what they start inherits that: no process could be
# stopped as Ctrl-C does.
signal.signal(signal.SIGINT, signal.default_int_handler)

# rclpy checks the types of message fields only when asked to; a wrong one can end the process.
os.environ["ROS_PYTHON_CHECK_FIELDS"] = "1"

# Nobody's own signs are read or written: each test finds its own table at a place that is not there yet.
_tests = itertools.count()
_data_homes = tempfile.TemporaryDirectory(prefix="teo_test_data_")
os.environ["XDG_DATA_HOME"] = _data_homes.name

# Domain IDs up to 101 keep DDS ports below Linux's ephemeral range (ROS 2 documentation, "The
# ROS_DOMAIN_ID"). 0 to 19 are left to people.
_DOMAINS = range(20, 102)
_calls = itertools.count(1)

_STUDIO = Path(__file__).parent / "studio"
_CONSOLE = Path(__file__).parent / "src" / "teo_console" / "test"

# Signs and tables that tests of several packages use.
pytest_plugins = ["made_signs"]


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark tests by what they take.

    What meets others over DDS runs alone: others' load would make it late. The studio, which makes signs and
    models, changes seldom, and its tests take a third of the time.
    """
    for item in items:
        if {"domain_id", "module_domain_id"} & set(getattr(item, "fixturenames", ())):
            item.add_marker("dds")
        if item.path.is_relative_to(_STUDIO):
            item.add_marker("slow")


@pytest.fixture(scope="module", autouse=True)
def room_to_draw(request: pytest.FixtureRequest) -> Iterator[None]:
    """Keeps the demo from running beside a browser.

    Without a graphics card a browser takes both cores, and the demo's film one: its sentences came too late.
    """
    demo = request.path.name == "test_demo.py"
    if not demo and not request.path.is_relative_to(_CONSOLE):
        yield
        return
    with (Path(tempfile.gettempdir()) / "teo_test_drawing").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX if demo else fcntl.LOCK_SH)
        yield


@pytest.fixture(autouse=True)
def data_home(monkeypatch: pytest.MonkeyPatch) -> Path:
    """A data home of the test's own, in which the user's own table would be."""
    home = Path(_data_homes.name) / str(next(_tests))
    monkeypatch.setenv("XDG_DATA_HOME", str(home))
    return home


@pytest.fixture
def domain_id() -> Iterator[int]:
    """A DDS domain that no other test here uses, confined to localhost; also in the environment."""
    yield from own_domain()


@pytest.fixture(scope="module")
def module_domain_id() -> Iterator[int]:
    """The same for all tests of a module, which share the nodes that they watch."""
    yield from own_domain()


def own_domain() -> Iterator[int]:
    """Take a DDS domain, and name it in the environment."""
    folder = Path(tempfile.gettempdir()) / "teo_test_domains"
    folder.mkdir(exist_ok=True)
    # Start at a place of this process's own, so that a domain is not reused at once by the next test.
    start = (os.getpid() * 7 + next(_calls)) % len(_DOMAINS)
    for offset in range(len(_DOMAINS)):
        domain = _DOMAINS[(start + offset) % len(_DOMAINS)]
        with (folder / str(domain)).open("w") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                continue
            if _inhabited(domain):
                continue
            with pytest.MonkeyPatch.context() as patch:
                patch.setenv("ROS_DOMAIN_ID", str(domain))
                patch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
                yield domain
            # A node that is not collected yet is still there, and the next test in this domain would meet it.
            gc.collect()
            return
    raise RuntimeError(f"expected a free DDS domain in {_DOMAINS}, all are in use by other tests")


def _inhabited(domain: int) -> bool:
    """Tell whether somebody who reserves nothing is in a domain: a port of it is open on this machine."""
    first = 7400 + 250 * domain  # DDSI-RTPS 2.5, 9.6.2.3: port base and domain gain
    rows = Path("/proc/net/udp").read_text(encoding="ascii").splitlines()[1:]
    ports = (int(row.split()[1].rpartition(":")[2], 16) for row in rows)
    return any(first <= port < first + 250 for port in ports)
