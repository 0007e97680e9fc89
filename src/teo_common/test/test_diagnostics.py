# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections.abc import Iterator

import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

from teo_common.diagnostics import Diagnosis, DiagnosticsPublisher, Level, RateMeter


@pytest.fixture
def context(domain_id: int) -> Iterator[Context]:
    context = Context()
    rclpy.init(context=context, domain_id=domain_id)
    yield context
    rclpy.try_shutdown(context=context)


def test_the_rate_is_counted_between_reports() -> None:
    meter = RateMeter()
    for i in range(11):
        meter.step(i * 0.01, i * 0.01 + 0.002)
    assert meter.report() == pytest.approx((100.0, 0.01, 0.002))
    meter.step(0.13, 0.131)
    assert meter.report() == pytest.approx((1.0 / 0.03, 0.03, 0.001))
    assert meter.report() == (0.0, 0.0, 0.0)


def test_a_diagnosis_is_sent_under_the_name_of_node_and_task(context: Context) -> None:
    node = Node("somebody", context=context)
    seen: list[DiagnosticArray] = []
    node.create_subscription(DiagnosticArray, "diagnostics", seen.append, 10)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    publisher = DiagnosticsPublisher(node, "joints")
    for _ in range(100):
        publisher.publish(Diagnosis(Level.WARN, "slow", {"rate [Hz]": "3.0"}))
        executor.spin_once(timeout_sec=0.1)
        if seen:
            break
    node.destroy_node()
    (status,) = seen[0].status
    assert (status.level, status.name, status.message) == (b"\x01", "somebody: joints", "slow")
    assert [(item.key, item.value) for item in status.values] == [("rate [Hz]", "3.0")]
    assert seen[0].header.stamp.sec > 0
