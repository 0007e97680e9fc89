# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A profile that is asked for and not in force is refused."""

from __future__ import annotations

import os
import socket
import subprocess
import sys
from pathlib import Path

import pytest

from teo_common.dds_profiles import ProfileError, requested_profile

VARIABLE = "FASTRTPS_DEFAULT_PROFILES_FILE"
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


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (None, "profile_missing"),
        (PROFILE.format(tls="", default=DEFAULT, port=0)[:-40], "profile_malformed"),
        (PROFILE.format(tls="", default=DEFAULT, port="any"), "profile_malformed"),
        (PROFILE.format(tls="", default="", port=0), "profile_without_default"),
        (PROFILE.format(tls=UNREADABLE, default=DEFAULT, port=0), "profile_certificate"),
    ],
    ids=["missing", "cut off", "no number", "no default", "no certificate"],
)
def test_a_profile_that_fast_dds_would_pass_over_is_refused_by_reason(
    text: str | None, code: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "profile.xml"
    if text is not None:
        path.write_text(text)
    monkeypatch.setenv(VARIABLE, str(path))
    with pytest.raises(ProfileError) as refused:
        requested_profile("rmw_fastrtps_cpp")
    assert refused.value.code == code


def test_without_the_variable_or_with_another_middleware_nothing_is_asked(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv(VARIABLE, "/nowhere.xml")
    assert requested_profile("rmw_cyclonedds_cpp") is None
    monkeypatch.delenv(VARIABLE)
    assert requested_profile("rmw_fastrtps_cpp") is None


@pytest.mark.usefixtures("domain_id")
def test_a_node_runs_with_what_its_profile_asks_for_and_not_otherwise(tmp_path: Path) -> None:
    path = tmp_path / "profile.xml"

    def run() -> subprocess.CompletedProcess[str]:
        # A range of LOCALHOST makes Fast DDS open UDP ports beside the transports of the profile.
        environment = os.environ | {VARIABLE: str(path), "ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}
        command = [sys.executable, "-c", NODE]
        return subprocess.run(
            command, capture_output=True, text=True, timeout=PATIENCE, env=environment, check=False
        )

    with socket.socket() as holder:
        holder.bind(("0.0.0.0", 0))
        holder.listen()
        path.write_text(PROFILE.format(tls="", default=DEFAULT, port=holder.getsockname()[1]))
        port_taken = run()
    as_asked = run()
    # A file with an element that Fast DDS does not know is left aside whole.
    path.write_text(path.read_text().replace("userTransports", "userTransport"))
    misspelled = run()
    for refused, expected in ((port_taken, "to listen at TCP port"), (misspelled, "no UDP port")):
        assert refused.returncode == 1
        assert f"[profile_not_in_force] expected {expected}" in refused.stderr
        assert "runs" not in refused.stdout.splitlines()
        assert "Traceback" not in refused.stderr
    assert (as_asked.returncode, as_asked.stdout) == (0, "runs\n"), as_asked.stderr
