# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Profiles that are asked for and not in force are refused; each judgement in a process of its own.

Fast DDS keeps what a process has loaded, so what is loaded in the tests' own process would hold for later
tests.
"""

from __future__ import annotations

import os
import socket
import subprocess
import sys
from pathlib import Path

import pytest

JUDGE = """
import sys
import time
import rclpy
from teo_common.dds_profiles import ProfileError, require_profile
rclpy.get_rmw_implementation_identifier()  # loads Fast DDS, as in a node
try:
    start = time.process_time()
    print(require_profile("rmw_fastrtps_cpp"), f"{time.process_time() - start:.4f}", sep="|")
except ProfileError as error:
    print(error.code, file=sys.stderr)  # Fast DDS writes to the other, from a thread of its own
"""
NODE = """
import rclpy
from rclpy.node import Node
from teo_common.node_process import run_node

class Brief(Node):
    def __init__(self):
        super().__init__("brief")
        self.create_timer(0.01, lambda: (print("runs", flush=True), rclpy.shutdown()))

run_node(Brief, None)
"""
PROFILE = """<?xml version="1.0"?>
<dds xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles"><profiles>
  <transport_descriptors>
    <transport_descriptor>
      <transport_id>ours</transport_id>
      <type>TCPv4</type>
      {tls}
      <listening_ports><port>{port}</port></listening_ports>
    </transport_descriptor>
  </transport_descriptors>
  <participant profile_name="ours"{default}><rtps>
    <userTransports><transport_id>ours</transport_id></userTransports>
    <useBuiltinTransports>false</useBuiltinTransports>
  </rtps></participant>
</profiles></dds>
"""
DEFAULT = ' is_default_profile="true"'
UNREADABLE = "<tls><cert_chain_file>/nowhere.pem</cert_chain_file></tls>"
PATIENCE = 120.0  # [s] for a Python process to start on a loaded machine


def run(code: str, path: Path, **variables: str) -> subprocess.CompletedProcess[str]:
    environment = os.environ | {"FASTRTPS_DEFAULT_PROFILES_FILE": str(path)} | variables
    return subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        env=environment,
        check=False,
    )


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (None, "profile_missing"),
        (PROFILE.format(tls="", default=DEFAULT, port=0)[:-40], "profile_malformed"),
        (
            PROFILE.format(tls="", default=DEFAULT, port=0).replace("userTransports", "userTransport"),
            "profile_malformed",
        ),
        (PROFILE.format(tls="", default="", port=0), "profile_without_default"),
        (PROFILE.format(tls=UNREADABLE, default=DEFAULT, port=0), "profile_certificate"),
    ],
    ids=["missing", "cut off", "misspelled", "no default", "no certificate"],
)
def test_a_profile_that_fast_dds_would_pass_over_is_refused_by_reason(
    text: str | None, code: str, tmp_path: Path
) -> None:
    path = tmp_path / "profile.xml"
    if text is not None:
        path.write_text(text)
    assert run(JUDGE, path).stderr.splitlines() == [code]


def test_the_profile_of_the_workspace_is_taken_within_ten_milliseconds() -> None:
    judged, seconds = run(JUDGE, Path(os.environ["FASTRTPS_DEFAULT_PROFILES_FILE"])).stdout.split("|")
    assert "udp=True, tcp_ports=None" in judged  # and shared memory
    assert float(seconds) < 0.01


def test_without_the_variable_or_with_another_middleware_nothing_is_asked(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    from teo_common.dds_profiles import require_profile

    monkeypatch.setenv("FASTRTPS_DEFAULT_PROFILES_FILE", "/nowhere.xml")
    assert require_profile("rmw_cyclonedds_cpp") is None
    monkeypatch.delenv("FASTRTPS_DEFAULT_PROFILES_FILE")
    assert require_profile("rmw_fastrtps_cpp") is None


@pytest.mark.usefixtures("domain_id")
def test_a_node_runs_with_what_its_profile_asks_for_and_not_otherwise(tmp_path: Path) -> None:
    path = tmp_path / "profile.xml"
    with socket.socket() as holder:
        holder.bind(("0.0.0.0", 0))
        holder.listen()
        path.write_text(PROFILE.format(tls="", default=DEFAULT, port=holder.getsockname()[1]))
        port_taken = run(NODE, path, ROS_AUTOMATIC_DISCOVERY_RANGE="SUBNET")
    # A range of LOCALHOST makes Fast DDS open UDP ports beside the transports of the profile.
    udp_too = run(NODE, path, ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST")
    for refused, expected in ((port_taken, "to listen at TCP port"), (udp_too, "no UDP port")):
        assert refused.returncode == 1
        assert f"[profile_not_in_force] expected {expected}" in refused.stderr
        assert "runs" not in refused.stdout
        assert "Traceback" not in refused.stderr
    as_asked = run(NODE, path, ROS_AUTOMATIC_DISCOVERY_RANGE="SUBNET")
    assert (as_asked.returncode, as_asked.stdout) == (0, "runs\n"), as_asked.stderr
