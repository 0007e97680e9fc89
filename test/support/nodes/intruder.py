# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Somebody on the network who wants the robot to move: `python intruder.py SECONDS`.

Turns the trunk by a trajectory, sends a sentence and a text, in the namespaces `/` and `/plain`, and looks
for the driver's services. Prints as a line of JSON what it came to know.
"""

from __future__ import annotations

import json
import sys
import time

import rclpy
from builtin_interfaces.msg import Duration
from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from std_srvs.srv import Trigger
from teo_sign_msgs.msg import SignSentence, SignToken
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from teo_names import COMMANDED_JOINTS, HOME

TURN = 0.2  # [rad] of the trunk
PLACES = ("", "plain/")


def main(seconds: float) -> None:
    """Try for some time."""
    rclpy.init()
    node = Node("intruder")
    turned = dict.fromkeys(PLACES, 0.0)
    stopped: set[str] = set()

    def hear(place: str, message: JointState) -> None:
        turn = abs(message.position[message.name.index("AxialTrunk")])
        turned[place] = max(turned[place], turn)

    publishers = {
        place: (
            node.create_publisher(JointTrajectory, f"{place}joint_trajectory", 10),
            node.create_publisher(SignSentence, f"{place}sign_tokens", 10),
            node.create_publisher(String, f"{place}text", 10),
        )
        for place in PLACES
    }
    clients = {place: node.create_client(Trigger, f"{place}stop") for place in PLACES}
    for place in PLACES:
        node.create_subscription(JointState, f"{place}joint_states", lambda m, p=place: hear(p, m), 10)
    there = HOME | {"AxialTrunk": TURN}
    point = JointTrajectoryPoint(
        positions=[there[name] for name in COMMANDED_JOINTS], time_from_start=Duration(sec=2)
    )
    trajectory = JointTrajectory(joint_names=list(COMMANDED_JOINTS), points=[point])
    sentence = SignSentence(utterance_id="intruder", sentence_count=1, tokens=[SignToken(gloss="HOLA")])
    messages = (trajectory, sentence, String(data="Hola"))
    names: set[str] = set()
    end = time.monotonic() + seconds
    due = 0.0
    while time.monotonic() < end:
        rclpy.spin_once(node, timeout_sec=0.05)
        names |= {f"{place}/{name}" for name, place in node.get_node_names_and_namespaces()}
        if time.monotonic() < due:
            continue
        due = time.monotonic() + 3.0  # longer than the motion: each goes to its end
        for place, given in publishers.items():
            for publisher, message in zip(given, messages, strict=True):
                publisher.publish(message)
            stopped |= {place} if clients[place].service_is_ready() else set()
    print(json.dumps({"nodes": sorted(names), "turned": turned, "services": sorted(stopped)}), flush=True)


if __name__ == "__main__":
    main(float(sys.argv[1]))
