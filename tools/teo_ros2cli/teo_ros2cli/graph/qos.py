# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""QoS profiles of rclpy, and their counterparts on the command line and in bags."""

from __future__ import annotations

from typing import Any

from rclpy.duration import Duration
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
    QoSPresetProfiles,
    QoSProfile,
    ReliabilityPolicy,
)

from teo_ros2cli.bags.qos_record import DURATIONS, INFINITE, QosRecord

_POLICIES: dict[str, Any] = {
    "history": HistoryPolicy,
    "reliability": ReliabilityPolicy,
    "durability": DurabilityPolicy,
    "liveliness": LivelinessPolicy,
}


def to_record(profile: Any) -> QosRecord:
    """Return what a bag stores of a profile."""
    policies: dict[str, Any] = {name: getattr(profile, name).name.lower() for name in _POLICIES}
    # Zero stands for unspecified.
    times: dict[str, Any] = {name: getattr(profile, name).nanoseconds or INFINITE for name in DURATIONS}
    avoid = bool(profile.avoid_ros_namespace_conventions)
    return QosRecord(depth=profile.depth, avoid_ros_namespace_conventions=avoid, **policies, **times)


def from_record(record: QosRecord) -> Any:
    """Return the profile to publish or subscribe with."""
    return QoSProfile(
        depth=record.depth,
        avoid_ros_namespace_conventions=record.avoid_ros_namespace_conventions,
        **{name: policy[getattr(record, name).upper()] for name, policy in _POLICIES.items()},
        **{name: Duration(nanoseconds=getattr(record, name)) for name in DURATIONS},
    )


def from_options(options: Any) -> Any:
    """Return the profile that the `--qos-*` options of a command describe."""
    # The presets are shared objects: a copy is changed.
    preset = QoSPresetProfiles.get_from_short_key(options.qos_profile)
    profile = QoSProfile(**{slot[1:]: getattr(preset, slot[1:]) for slot in QoSProfile.__slots__})
    for name, policy in _POLICIES.items():
        if word := getattr(options, f"qos_{name}"):
            setattr(profile, name, policy.get_from_short_key(word))
    if options.qos_liveliness_lease_duration_seconds is not None:
        profile.liveliness_lease_duration = Duration(seconds=options.qos_liveliness_lease_duration_seconds)
    if options.qos_depth is not None:
        profile.depth = options.qos_depth
    elif profile.durability == DurabilityPolicy.TRANSIENT_LOCAL and profile.depth == 0:
        profile.depth = 1
    return profile
