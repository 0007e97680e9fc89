# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Three machines as docs/machines.md sets them up, word for word: late, lossy, cut off, with an intruder."""

from __future__ import annotations

import json
import subprocess
import time
from collections.abc import Iterator
from fnmatch import fnmatchcase
from pathlib import Path

import pytest
from hosts import missing
from intruder import TURN
from laboratory import PAGE, PROGRAMS, ROOT, Laboratory
from typed_page import blocks_of

from teo_bringup.access import read_table

REASON = missing(*PROGRAMS)
pytestmark = [pytest.mark.skipif(bool(REASON), reason=REASON), pytest.mark.slow]

PATIENCE = 300.0  # [s] for the robot to come to rest on a loaded machine
CUT = 5.0  # [s]
ATTEMPT = 6  # [s] that the intruder tries: two trajectories, each with time to be executed
GRAPH = """
import json, time
import rclpy
rclpy.init()
node = rclpy.create_node("visitor")
names = ("translator", "executor", "teo_sim_driver")
found, changed, end = {}, time.monotonic(), time.monotonic() + 30.0

def seen(name):
    kinds = (node.get_publisher_names_and_types_by_node, node.get_subscriber_names_and_types_by_node)
    return [[topic for topic, _ in kind(name, "/", no_demangle=True)] for kind in kinds]

# A node is known before what it has open is: until all have something, and nothing is new for a second.
while time.monotonic() < end:
    rclpy.spin_once(node, timeout_sec=0.1)
    now = {name: seen(name) for name in node.get_node_names() if name in names}
    if now != found:
        found, changed = now, time.monotonic()
    elif len(found) == len(names) and all(map(all, found.values())) and time.monotonic() > changed + 1.0:
        break
print("graph", json.dumps(found), flush=True)
"""


@pytest.fixture(scope="module")
def laboratory(module_domain_id: int, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Laboratory]:
    """The machines, ready; networks of their own, so that any domain does."""
    assert module_domain_id
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(ROOT)
        with Laboratory(tmp_path_factory.mktemp("machines")) as laboratory:
            yield laboratory


def test_an_intruder_moves_what_is_on_the_network_and_not_what_is_in_the_tunnel(
    laboratory: Laboratory,
) -> None:
    outside = laboratory.shell("robot")  # a driver that is not in the tunnel, which shows that he can
    outside.type(". ./env.sh\nros2 run teo_bringup up driver --namespace plain &")
    outside.wait_for("every node is ready", timeout=PATIENCE)
    robot = json.loads(
        subprocess.check_output(laboratory.host("robot").entered("ip", "-json", "link", "show", "lan0"))
    )
    intruder = laboratory.shell("intruder")
    # Whatever he addresses to the tunnel goes to the robot's own network card.
    intruder.type(
        "ip route add 10.77.0.0/24 dev lan0 &&"
        f" ip neighbour add 10.77.0.3 lladdr {robot[0]['address']} dev lan0 && . ./env.sh"
    )
    intruder.type("export ROS_STATIC_PEERS='192.168.10.3;10.77.0.3'")
    intruder.type(f"python test/support/nodes/intruder.py {ATTEMPT}", timeout=PATIENCE)
    learnt = json.loads(next(line for line in intruder.said if line.startswith("{")))
    assert "/plain/teo_sim_driver" in learnt["nodes"]
    assert learnt["turned"]["plain/"] == pytest.approx(TURN, abs=0.01)
    assert "plain/" in learnt["services"]
    assert not [name for name in learnt["nodes"] if not name.startswith("/plain") and name != "//intruder"]
    assert learnt["turned"][""] == 0.0
    assert "" not in learnt["services"]
    seen = laboratory.wait(lambda seen: seen.at_rest, PATIENCE)
    assert (seen.trunk < 0.01, seen.trajectory_publishers, seen.sentences) == (True, 1, 0)


def test_nodes_have_nothing_open_that_the_permissions_do_not_allow(
    laboratory: Laboratory, tmp_path: Path
) -> None:
    (tmp_path / "graph.py").write_text(GRAPH)
    shell = laboratory.inside("robot")
    shell.type(f"python {tmp_path / 'graph.py'}", timeout=PATIENCE)
    told = next(line for line in shell.said if line.startswith("graph"))
    graph: dict[str, list[list[str]]] = json.loads(told.removeprefix("graph"))
    for enclave, node in (
        ("translator", "translator"),
        ("executor", "executor"),
        ("driver", "teo_sim_driver"),
    ):
        for topics, allowed in zip(graph[node], read_table()[enclave], strict=True):
            assert topics
            assert [topic for topic in topics if not any(fnmatchcase(topic, may) for may in allowed)] == []


def test_what_a_late_lossy_and_cut_network_loses_is_named_and_the_robot_keeps_its_limits(
    laboratory: Laboratory,
) -> None:
    network = laboratory.network
    network.delay(0.05)
    network.lose(0.02)
    laboratory.say()
    laboratory.wait(lambda seen: not seen.at_rest and seen.sentences == 1, PATIENCE)
    network.cut("robot")
    time.sleep(CUT)  # what is tested
    network.heal()
    after = laboratory.wait(lambda seen: seen.at_rest and len(seen.outcomes) == 1, PATIENCE)
    network.delay(0.0)
    network.lose(0.0)
    laboratory.say()
    later = laboratory.wait(lambda seen: seen.at_rest and len(seen.outcomes) == 2, PATIENCE)
    assert (after.sentences, later.sentences) == (1, 2)
    assert after.outcomes[0] == "signed" or after.outcomes[0] in after.named
    assert later.fastest < 1.001  # stamps are whole nanoseconds, positions are not
    assert later.outside <= 0.0


def test_machines_that_know_the_pages_discovery_server_alone_hear_each_other(laboratory: Laboratory) -> None:
    (server,) = (block.text for block in blocks_of(PAGE) if "discovery_server" in block.text)
    (client,) = (block.text for block in blocks_of(PAGE) if "network client" in block.text)
    laboratory.shell("robot").type(server.rstrip() + " &")
    speaker, hearer = laboratory.shell("workstation"), laboratory.shell("laptop")
    for shell in (speaker, hearer):
        shell.type(client)
    speaker.type("ros2 topic pub -r 5 /greeting std_msgs/msg/String \"{data: 'buenos días'}\" &")
    hearer.type(
        f"timeout {PATIENCE:.0f} ros2 topic echo --once /greeting std_msgs/msg/String", timeout=PATIENCE
    )
    assert "data: buenos días" in hearer.said
