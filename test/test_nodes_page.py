# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""docs/nodes.md says what the nodes declare, and what the running nodes have open."""

from __future__ import annotations

import re
import time
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest
import rclpy
from nodes_page import FILE, nodes_page
from rclpy.context import Context
from rclpy.node import Node

from teo_bringup.graph import NODES, Graph

TIMEOUT = 240.0  # [s] for six processes on a loaded machine
LOOK_PERIOD = 0.5  # [s]
# What the driver and the retriever are called in the graph.
GRAPH_NAMES = {"driver": "teo_sim_driver", "retriever": "skeleton_retriever"}
LIMB = re.compile(r"^(head|trunk|(left|right)_(arm|hand))/")
# Every node has these.
COMMON = {"rosout", "parameter_events"}


class Use(NamedTuple):
    """A node's end of a topic, service or action."""

    node: str
    end: str
    """One of the headings of the page's tables: published by, heard by, served by, called by."""
    name: str
    type: str


def test_the_page_is_what_the_script_writes() -> None:
    assert FILE.read_text(encoding="utf-8") == nodes_page(), "run python scripts/nodes_page.py"


def uses_on_the_page() -> set[Use]:
    """Who uses what, as a reader finds it in the tables."""
    uses = set()
    headings: list[str] = []
    for line in FILE.read_text(encoding="utf-8").partition("## Parameters")[0].splitlines():
        cells = line.strip("|").split("|")
        if line.startswith("|name|"):
            headings = cells
        elif line.startswith("|`"):
            name, kind = (cell.strip("`") for cell in cells[:2])
            for end, nodes in zip(headings[2:4], cells[2:4], strict=True):
                uses |= {Use(node, end, name, kind) for node in nodes.split(", ") if node}
    return uses


def uses_in_the_graph(visitor: Node) -> Iterator[Use]:
    """Who has what open."""
    ends = {
        "published by": visitor.get_publisher_names_and_types_by_node,
        "heard by": visitor.get_subscriber_names_and_types_by_node,
        "served by": visitor.get_service_names_and_types_by_node,
        "called by": visitor.get_client_names_and_types_by_node,
    }
    present = visitor.get_node_names()
    for node in NODES:
        graph_name = GRAPH_NAMES.get(node, node)
        if graph_name not in present:
            continue
        for end, opened in ends.items():
            for path, (kind, *_) in opened(graph_name, "/"):
                name = path.removeprefix("/").removesuffix("/_action/send_goal")
                own = name in COMMON or name.startswith(f"{graph_name}/") or "/_action/" in name
                if not own:
                    plain = re.sub("/(msg|srv|action)/", "/", kind).removesuffix("_SendGoal")
                    yield Use(node, end, LIMB.sub("LIMB/", name), plain)


@pytest.mark.slow
def test_the_running_nodes_have_open_what_the_page_says(domain_id: int, tmp_path: Path) -> None:
    context = Context()
    rclpy.init(context=context, domain_id=domain_id)
    visitor = rclpy.create_node("visitor", context=context)
    # Any free port for the console; with its default the executor asks for no action.
    arguments = ("--ros-args", "-p", "port:=0", "-p", "trajectory_interface:=action")
    expected, found = uses_on_the_page(), set[Use]()
    try:
        with Graph(tmp_path) as graph:
            graph.start_nodes(NODES, arguments)
            deadline = time.monotonic() + TIMEOUT
            while found != expected and time.monotonic() < deadline:
                graph.check()
                time.sleep(LOOK_PERIOD)
                found = set(uses_in_the_graph(visitor))
    finally:
        visitor.destroy_node()
        rclpy.shutdown(context=context)
    assert sorted(found - expected) == []
    assert sorted(expected - found) == []
    # Whoever has a topic open hears all that is said on it.
    logs = {path.name: path.read_text(encoding="utf-8") for path in tmp_path.glob("*.log")}
    assert [name for name, said in logs.items() if "incompatible QoS" in said] == []
