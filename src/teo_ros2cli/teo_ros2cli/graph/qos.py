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

from teo_ros2cli.bags.qos_record import INFINITE, QosRecord


def to_record(profile: Any) -> QosRecord:
    """Return what a bag stores of a profile."""
    return QosRecord(
        history=profile.history.name.lower(),
        depth=profile.depth,
        reliability=profile.reliability.name.lower(),
        durability=profile.durability.name.lower(),
        deadline=_nanoseconds(profile.deadline),
        lifespan=_nanoseconds(profile.lifespan),
        liveliness=profile.liveliness.name.lower(),
        liveliness_lease_duration=_nanoseconds(profile.liveliness_lease_duration),
        avoid_ros_namespace_conventions=bool(profile.avoid_ros_namespace_conventions),
    )


def _nanoseconds(duration: Any) -> int:
    # Zero stands for unspecified.
    return int(duration.nanoseconds) or INFINITE


def from_record(record: QosRecord) -> Any:
    """Return the profile to publish or subscribe with."""
    return QoSProfile(
        history=HistoryPolicy[record.history.upper()],
        depth=record.depth,
        reliability=ReliabilityPolicy[record.reliability.upper()],
        durability=DurabilityPolicy[record.durability.upper()],
        deadline=Duration(nanoseconds=record.deadline),
        lifespan=Duration(nanoseconds=record.lifespan),
        liveliness=LivelinessPolicy[record.liveliness.upper()],
        liveliness_lease_duration=Duration(nanoseconds=record.liveliness_lease_duration),
        avoid_ros_namespace_conventions=record.avoid_ros_namespace_conventions,
    )


def from_options(options: Any) -> Any:
    """Return the profile that the `--qos-*` options of a command describe."""
    # The presets are shared objects: a copy is changed.
    preset = QoSPresetProfiles.get_from_short_key(options.qos_profile)
    profile = QoSProfile(**{slot[1:]: getattr(preset, slot[1:]) for slot in QoSProfile.__slots__})
    if options.qos_history:
        profile.history = HistoryPolicy.get_from_short_key(options.qos_history)
    if options.qos_durability:
        profile.durability = DurabilityPolicy.get_from_short_key(options.qos_durability)
    if options.qos_reliability:
        profile.reliability = ReliabilityPolicy.get_from_short_key(options.qos_reliability)
    if options.qos_liveliness:
        profile.liveliness = LivelinessPolicy.get_from_short_key(options.qos_liveliness)
    if options.qos_liveliness_lease_duration_seconds is not None:
        profile.liveliness_lease_duration = Duration(seconds=options.qos_liveliness_lease_duration_seconds)
    if options.qos_depth is not None:
        profile.depth = options.qos_depth
    elif profile.durability == DurabilityPolicy.TRANSIENT_LOCAL and profile.depth == 0:
        profile.depth = 1
    return profile
