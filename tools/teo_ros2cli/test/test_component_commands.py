# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`ros2 component` with a node of the test's own that answers as a container of rclcpp_components does."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from typing import Any

from composition_interfaces.srv import ListNodes, LoadNode, UnloadNode
from rclpy.parameter import parameter_value_to_python

Command = Callable[..., subprocess.CompletedProcess[str]]
TALKER = ("composition", "composition::Talker")


class Container:
    """Keeps what it was asked to load, by number."""

    def __init__(self, node: Any) -> None:
        self.loaded: dict[int, LoadNode.Request] = {}
        self._count = 0
        place = "/box/_container"
        node.create_service(ListNodes, f"{place}/list_nodes", self._list)
        node.create_service(LoadNode, f"{place}/load_node", self._load)
        node.create_service(UnloadNode, f"{place}/unload_node", self._unload)

    def _list(self, _request: ListNodes.Request, answer: ListNodes.Response) -> ListNodes.Response:
        answer.unique_ids = list(self.loaded)
        answer.full_node_names = [f"/{request.node_name or 'talker'}" for request in self.loaded.values()]
        return answer

    def _load(self, request: LoadNode.Request, answer: LoadNode.Response) -> LoadNode.Response:
        if (request.package_name, request.plugin_name) != TALKER:
            answer.error_message = "Failed to find class with the requested plugin name."
            return answer
        self._count += 1
        self.loaded[self._count] = request
        answer.success, answer.unique_id = True, self._count
        answer.full_node_name = f"/{request.node_name or 'talker'}"
        return answer

    def _unload(self, request: UnloadNode.Request, answer: UnloadNode.Response) -> UnloadNode.Response:
        answer.success = self.loaded.pop(request.unique_id, None) is not None
        answer.error_message = "" if answer.success else "No node found with unique_id: 9"
        return answer


def test_components_are_loaded_listed_and_unloaded(graph: Any, ros2_here: Command) -> None:
    container = Container(graph.node)
    done = ros2_here("component", "load", "box", *TALKER)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == "Loaded component 1 into '/box' container node as '/talker'\n"
    options = ("-n", "anna", "--node-namespace", "/left", "--log-level", "warn", "-r", "chatter:=text")
    values = ("-p", "rate:=2.5", "-p", "names:=[a, b]", "-e", "use_intra_process_comms:=true")
    assert ros2_here("component", "load", "-q", "/box", *TALKER, *options, *values).stdout == "2 /anna\n"
    request = container.loaded[2]
    assert (request.node_namespace, request.log_level, list(request.remap_rules)) == (
        "/left",
        30,
        ["chatter:=text"],
    )
    given = {entry.name: parameter_value_to_python(entry.value) for entry in request.parameters}
    assert (given["rate"], list(given["names"])) == (2.5, ["a", "b"])
    (extra,) = request.extra_arguments
    assert (extra.name, extra.value.bool_value) == ("use_intra_process_comms", True)
    assert ros2_here("component", "list").stdout == "/box\n  1  /talker\n  2  /anna\n"
    assert ros2_here("component", "list", "--containers-only").stdout == "/box\n"
    assert ros2_here("component", "unload", "/box", "1").stdout == (
        "Unloaded component 1 from '/box' container node\n"
    )
    assert ros2_here("component", "list", "box").stdout == "/box\n  2  /anna\n"
    for words, told in (
        (("load", "/nobody", *TALKER), "Unable to find container node '/nobody'\n"),
        (
            ("load", "/box", "composition", "composition::Nothing"),
            "Failed to load component: Failed to find class with the requested plugin name.\n",
        ),
        (
            ("unload", "/box", "9"),
            "Failed to unload component 9 from '/box' container node\n    No node found with unique_id: 9\n",
        ),
    ):
        refused = ros2_here("component", *words)
        assert (refused.returncode, refused.stdout, refused.stderr) == (1, "", told)
