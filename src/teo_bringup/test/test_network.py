# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What `network` writes is taken by Fast DDS and does what it says; all else is refused by reason."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from typed_page import blocks_of

from teo_bringup.graph import executable_of
from teo_bringup.network import main

Network = Callable[..., dict[str, str]]

PAGE = Path(__file__).parents[3] / "docs" / "machines.md"
PATIENCE = 120.0  # [s] for Python processes to start and find each other on a loaded machine
# Says its own name, and whether it has heard another's, until that has heard it too; then for a second more,
# so that the other knows.
TALKER = """
import sys, time
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from teo_common.node_process import run_node
from teo_common.dds_profiles import own_sockets

class Talker(Node):
    def __init__(self):
        super().__init__(sys.argv[1])
        self.texts = self.create_publisher(String, "names", 10)
        self.create_subscription(String, "names", self.hear, 10)
        self.create_timer(0.1, self.say)
        self.heard = self.ends = False

    def say(self):
        self.texts.publish(String(data=sys.argv[1] + (" heard" if self.heard else "")))

    def hear(self, message):
        name, *heard = message.data.split()
        if name == sys.argv[1]:
            return
        if not self.heard:
            self.heard = True
            print("hears", name, "udp", sorted(own_sockets().udp), flush=True)
        if heard and not self.ends:
            self.ends = True
            self.create_timer(1.0, rclpy.shutdown)

run_node(Talker, None)
"""


@pytest.fixture
def network(capsys: pytest.CaptureFixture[str]) -> Network:
    """Runs `network`; gives what a shell has that sources the printed lines."""

    def run(*arguments: str | Path) -> dict[str, str]:
        with pytest.raises(SystemExit) as ended:
            main([*map(str, arguments)])
        assert ended.value.code == 0
        shell = ["sh", "-c", f"{capsys.readouterr().out}\nenv -0"]
        said = subprocess.run(shell, capture_output=True, text=True, check=True, timeout=PATIENCE)
        return dict(item.split("=", 1) for item in said.stdout.split("\0") if item)

    return run


@pytest.fixture(scope="module")
def certificates(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with an authority and a machine that it vouches for, by the page's commands."""
    folder = tmp_path_factory.mktemp("certificates")
    (block,) = (block.text for block in blocks_of(PAGE) if "openssl" in block.text)
    subprocess.run(["sh", "-ec", block], cwd=folder, check=True, capture_output=True, timeout=PATIENCE)
    return folder


def tls(folder: Path) -> list[str]:
    names = {"--authority": "teo-ca.pem", "--certificate": "robot.pem", "--key": "robot.key"}
    return [str(item) for option, name in names.items() for item in (option, folder / name)]


@pytest.mark.usefixtures("domain_id")
@pytest.mark.slow
def test_nodes_that_meet_by_a_server_over_tls_have_no_udp_port(
    network: Network, certificates: Path, tmp_path: Path
) -> None:
    endpoint = f"127.0.0.1:{15000 + int(os.environ['ROS_DOMAIN_ID'])}"
    made = {
        kind: network(kind, endpoint, "--output", tmp_path / f"{kind}.xml", *tls(certificates))
        for kind in ("server", "client")
    }
    with subprocess.Popen(
        [str(executable_of("teo_bringup", "discovery_server"))], env=os.environ | made["server"]
    ) as server:
        talkers = [
            subprocess.Popen(
                [sys.executable, "-c", TALKER, name],
                env=os.environ | made["client"],
                stdout=subprocess.PIPE,
                text=True,
            )
            for name in ("ana", "luis")
        ]
        try:
            said = [talker.communicate(timeout=PATIENCE)[0] for talker in talkers]
        finally:
            for process in (*talkers, server):
                process.kill()
    assert said == ["hears luis udp []\n", "hears ana udp []\n"]


def test_peers_come_by_what_ros_2_has_and_no_multicast_is_asked_for(network: Network, tmp_path: Path) -> None:
    output = tmp_path / "peers.xml"
    made = network("peers", "10.0.0.1", "10.0.0.2", "--output", output)
    assert made["ROS_AUTOMATIC_DISCOVERY_RANGE"] == "LOCALHOST"
    assert made["ROS_STATIC_PEERS"] == "10.0.0.1;10.0.0.2"
    assert made["FASTRTPS_DEFAULT_PROFILES_FILE"] == str(output)
    assert "<maxInitialPeersRange>16</maxInitialPeersRange>" in output.read_text()


@pytest.mark.parametrize(
    ("command", "variable"), [("peers", "ROS_STATIC_PEERS"), ("client", "ROS_DISCOVERY_SERVER")]
)
def test_the_pages_lines_leave_a_shell_that_finds_other_machines(
    command: str, variable: str, tmp_path: Path
) -> None:
    (block,) = (
        b.text for b in blocks_of(PAGE) if b.where == "on each machine" and f"network {command}" in b.text
    )
    done = subprocess.run(
        ["bash", "-ec", f"{block}\necho ${variable}"],
        cwd=PAGE.parents[1],
        env=os.environ | {"HOME": str(tmp_path)},
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=True,
    )
    assert "192.168.10.3" in done.stdout


def test_a_client_without_certificates_needs_no_profile(network: Network) -> None:
    made = network("client", "10.0.0.2:11811")
    assert (made["ROS_DISCOVERY_SERVER"], made["ROS_SUPER_CLIENT"]) == ("10.0.0.2:11811", "TRUE")


@pytest.mark.parametrize(
    ("arguments", "code"),
    [
        (["peers", "10.0.0", "--output", "x.xml"], "bad_address"),
        (["peers", "10.0.0.1", "--output", "/nowhere/x.xml"], "not_written"),
        (["server", "10.0.0.1", "--output", "x.xml"], "bad_endpoint"),
        (["server", "10.0.0.1:70000", "--output", "x.xml"], "bad_endpoint"),
        (["client", "10.0.0.1:1", "--output", "x.xml", "--key", "k.pem"], "no_certificate"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_what_cannot_be_made_is_refused_by_reason_and_leaves_no_file(
    arguments: list[str],
    code: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit, match=rf"^network: \[{code}\] expected"):
        main(arguments)
    assert capsys.readouterr().out == ""
    assert not list(tmp_path.iterdir())
