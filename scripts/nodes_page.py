# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Writes docs/nodes.md, the page of nodes and parameters: `python scripts/nodes_page.py`."""

from __future__ import annotations

import importlib
import json
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import yaml
from parameter_file import TABLES

from teo_bringup.graph import NODES
from teo_common.parameters import ParameterRow, Value

_ROOT = Path(__file__).parents[1]
FILE = _ROOT / "docs" / "nodes.md"
# What each node publishes, hears, serves and calls; compared with the running nodes by tests.
_ACCESS = _ROOT / "src" / "teo_bringup" / "config" / "access.yaml"
# Behind the name of a parameter that is read when the node starts.
_READ_ONLY = "°"


class Interface(NamedTuple):
    """A topic, service or action of the graph."""

    name: str
    type: str
    content: str
    """What a message says, or what a call does. Markdown."""
    declared: str = ""
    """The pattern that stands for it in `access.yaml`; empty: its name."""


TOPICS = (
    Interface("text", "std_msgs/String", "Sentences in the spoken language"),
    Interface("speech", "std_msgs/String", "What a speech recogniser heard"),
    Interface(
        "sign_tokens",
        "teo_sign_msgs/SignSentence",
        "One sentence a message, in order; the last 100 are latched, for executors with a journal",
    ),
    Interface(
        "translation_status", "teo_sign_msgs/TranslationStatus", "What became of each text; depth 5000"
    ),
    Interface(
        "joint_trajectory",
        "trajectory_msgs/JointTrajectory",
        "Joints of the whole robot, in any order, to a standstill. The stamp is when it begins, "
        "0 for at once; one point stops",
    ),
    Interface(
        "LIMB/joint_trajectory",
        "trajectory_msgs/JointTrajectory",
        "The same for `head`, `trunk`, `left_arm`, `right_arm`, `left_hand` or `right_hand`; "
        "the newest command wins",
        "*/joint_trajectory",
    ),
    Interface(
        "executor_status", "teo_sign_msgs/ExecutorStatus", "State, reason, timing of every token; latched"
    ),
    Interface(
        "joint_states",
        "sensor_msgs/JointState",
        "Positions [rad] and velocities [rad/s] of all joints, 100 Hz; heard best effort",
    ),
    Interface("driver_state", "teo_sign_msgs/DriverState", "Mode and why; who commands; latched"),
    Interface(
        "speed_scaling_input",
        "control_msgs/SpeedScalingFactor",
        "Speed, 0 to 1; 0 pauses",
    ),
    Interface(
        "controller_state",
        "control_msgs/JointTrajectoryControllerState",
        "Wanted and measured motion, while somebody listens",
    ),
    Interface("robot_description", "std_msgs/String", "The URDF; latched"),
    Interface(
        "dextra_setpoints",
        "std_msgs/Float64MultiArray",
        "What TEO's real hands would receive, left then right: abductor [deg], thumb and fingers "
        "[mm of tendon]; latched",
    ),
    Interface(
        "camera/color/image_raw",
        "sensor_msgs/Image",
        "RGB, BGR, grey or YUV 4:2:2; also `/compressed` (JPEG, PNG)",
        "camera/*",
    ),
    Interface(
        "camera/aligned_depth_to_color/image_raw",
        "sensor_msgs/Image",
        "Depth of each colour pixel: `16UC1`, `mono16` [mm], `32FC1` [m]; also `/compressedDepth` (PNG, RVL)",
        "camera/*",
    ),
    Interface(
        "camera/color/camera_info",
        "sensor_msgs/CameraInfo",
        "Calibration of the colour camera: `plumb_bob` or `rational_polynomial`",
        "camera/*",
    ),
    Interface(
        "skeletons",
        "teo_sign_msgs/SkeletonArray",
        "Everybody in an image: body, hands and face in space; empty if nobody is there",
    ),
    Interface(
        "skeleton_markers", "visualization_msgs/MarkerArray", "The same for viewers, while somebody listens"
    ),
    Interface("overlay/image", "sensor_msgs/Image", "The image with keypoints drawn, while somebody listens"),
    Interface("capture_state", "std_msgs/String", "What the recording of a sign is doing; latched"),
    Interface("diagnostics", "diagnostic_msgs/DiagnosticArray", "Health, counts and delays, 1 Hz"),
)
SERVICES = (
    Interface("translate", "teo_sign_msgs/Translate", "Translate a text without publishing it"),
    Interface(
        "list_signs",
        "teo_sign_msgs/ListSigns",
        "Glosses that are signed, not spelled; the translator asks every two seconds",
    ),
    Interface("get_sign", "teo_sign_msgs/GetSign", "Knots and file of one sign"),
    Interface("list_queue", "teo_sign_msgs/ListQueue", "Sentences not yet signed to the end"),
    Interface("clear_queue", "std_srvs/Trigger", "Forget the sentences that wait"),
    Interface("stop", "std_srvs/Trigger", "Slow down on the path, hold, and refuse motions until `rearm`"),
    Interface(
        "rearm",
        "std_srvs/Trigger",
        "Accept motions again after `stop` or a fault, once the robot is at rest",
    ),
    Interface("pause", "std_srvs/Trigger", "Stand still on the path"),
    Interface("resume", "std_srvs/Trigger", "Continue after `pause`"),
    Interface(
        "query_state", "control_msgs/QueryTrajectoryState", "Where the joints are to be at a given time"
    ),
    Interface(
        "lock_signer",
        "teo_sign_msgs/LockSigner",
        "Follow one person as the signer; -1: choose by the rule again",
    ),
    Interface("capture_sign", "teo_sign_msgs/CaptureSign", "Record a sign of the signer and save it"),
    *(
        Interface(f"{node}/set_parameters", "rcl_interfaces/SetParameters", "Chooses the sign language")
        for node in ("executor", "translator")
    ),
)
ACTIONS = (
    Interface(
        "execute_sentence",
        "teo_sign_msgs/ExecuteSentence",
        "Sign one sentence, in the same queue; feedback at 10 Hz",
    ),
    Interface(
        "follow_joint_trajectory",
        "control_msgs/FollowJointTrajectory",
        "As joint_trajectory_controller's, with tolerances; called if `trajectory_interface` is `action`",
    ),
    Interface(
        "LIMB/follow_joint_trajectory",
        "control_msgs/FollowJointTrajectory",
        "The same for one limb",
        "*/follow_joint_trajectory",
    ),
)

_HEAD = """\
<!-- Made by scripts/nodes_page.py; a test compares the two. -->
# Nodes and parameters

All names are relative: remap them, or put a node into a namespace. Lifecycle transitions, parameter services
and `use_sim_time` are as in every ROS 2 node. The message files of `src/teo_sign_msgs` explain the project's
own types. Where nothing else is said, publishers are reliable with a depth of 10, latched ones transient
local with a depth of 1. Cameras are heard best effort with a depth of 5.
"""
_PARAMETERS = f"""\
## Parameters

`src/teo_bringup/config/parameters.yaml` has the same parameters, ready to copy and change. {_READ_ONLY} marks
what is read when the node starts; the others can be changed while it runs.
"""


def nodes_page() -> str:
    """Give the text of the page."""
    access: dict[str, dict[str, Any]] = yaml.safe_load(_ACCESS.read_text(encoding="utf-8"))
    roles = {node: access[node] for node in NODES}
    return "\n".join(
        (
            _HEAD,
            *_interfaces("Topics", TOPICS, roles, ("published by", "publishes"), ("heard by", "subscribes")),
            *_interfaces("Services", SERVICES, roles, ("served by", "serves"), ("called by", "calls")),
            *_interfaces("Actions", ACTIONS, roles, ("served by", "executes"), ("called by", "asks")),
            _PARAMETERS,
            *_parameters(),
        )
    )


def nodes_with(interface: Interface, act: str, roles: dict[str, dict[str, Any]]) -> list[str]:
    """Nodes that do something with a topic, service or action.

    Args:
        interface: Which.
        act: A key of `access.yaml`, such as `publishes`.
        roles: What each node does, by its name.
    """
    declared = interface.declared or interface.name
    return [node for node, acts in roles.items() if declared in acts.get(act, ())]


def _interfaces(
    title: str,
    rows: Iterable[Interface],
    roles: dict[str, dict[str, Any]],
    *columns: tuple[str, str],
) -> Iterator[str]:
    yield f"## {title}\n"
    yield from _table_head(["name", "type", *(heading for heading, _ in columns), "content"])
    for row in rows:
        users = (", ".join(nodes_with(row, act, roles)) for _, act in columns)
        yield _line([f"`{row.name}`", f"`{row.type}`", *users, row.content])
    yield ""


def _parameters() -> Iterator[str]:
    for node, (module, attribute) in TABLES.items():
        rows: Iterable[ParameterRow] = getattr(importlib.import_module(module), attribute)
        yield f"### {node}\n"
        yield from _table_head(["parameter", "default", "range", "meaning"])
        for row in rows:
            mark = _READ_ONLY if row.read_only else ""
            yield _line([f"`{row.name}`{mark}", _default(row.default), _range(row), row.description])
        yield ""


def _default(value: Value) -> str:
    if isinstance(value, float):
        return f"{value:.4g}"
    plain = list(value) if isinstance(value, tuple) else value
    return f"`{json.dumps(plain, ensure_ascii=False)}`"


def _range(row: ParameterRow) -> str:
    if row.choices:
        return ", ".join(f"`{choice}`" if choice else "empty" for choice in row.choices)
    if row.low is None or row.high is None:
        return ""
    return f"{row.low:g}..{row.high:g}"


def _table_head(names: Sequence[str]) -> tuple[str, str]:
    return _line(names), "|---" * len(names) + "|"


def _line(cells: Iterable[str]) -> str:
    escaped = (cell.replace("|", r"\|") for cell in cells)
    return f"|{'|'.join(escaped)}|"


if __name__ == "__main__":
    FILE.write_text(nodes_page(), encoding="utf-8")
