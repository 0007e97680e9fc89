# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Quality of service: profiles as bags store them and as rclpy takes them, and choosing one that suits many.

Source of names and numbers: rmw/types.h and rmw/qos_string_conversions.h of ROS 2 Jazzy.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import yaml

from teo_ros2cli.errors import Ros2CliError

# RMW_DURATION_INFINITE [ns].
INFINITE = 2**63 - 1

# Names of the values of each policy; the number of a value is its place.
POLICIES: Mapping[str, tuple[str, ...]] = {
    "history": ("system_default", "keep_last", "keep_all", "unknown"),
    "reliability": ("system_default", "reliable", "best_effort", "unknown", "best_available"),
    "durability": ("system_default", "transient_local", "volatile", "unknown", "best_available"),
    "liveliness": (
        "system_default",
        "automatic",
        "manual_by_node",
        "manual_by_topic",
        "unknown",
        "best_available",
    ),
}
# The fields of a profile that are times.
DURATIONS = ("deadline", "lifespan", "liveliness_lease_duration")
# What implementations of the first ROS 2 releases gave for an infinite time [s, ns]: rosbag2 maps them too.
_OLD_INFINITES = {(2**31 - 1, 2**32 - 1), (2**31 - 1, 2**31 - 1)}


@dataclass(frozen=True)
class QosRecord:
    """One QoS profile, with the policy names of rmw. The defaults are those of a default publisher.

    Args:
        history: `keep_last`, `keep_all`, `system_default`, or `unknown` where discovery does not tell.
        depth: Length of the queue of `keep_last` [messages].
        reliability: `reliable`, `best_effort`, ...
        durability: `volatile`, `transient_local`, ...
        deadline: Longest time between messages that is promised [ns].
        lifespan: Age at which a message expires [ns].
        liveliness: `automatic`, `manual_by_topic`, ...
        liveliness_lease_duration: Time within which liveliness is shown [ns].
        avoid_ros_namespace_conventions: True if the topic name went to DDS unchanged.
    """

    history: str = "keep_last"
    depth: int = 10
    reliability: str = "reliable"
    durability: str = "volatile"
    deadline: int = INFINITE
    lifespan: int = INFINITE
    liveliness: str = "automatic"
    liveliness_lease_duration: int = INFINITE
    avoid_ros_namespace_conventions: bool = False

    def to_tree(self) -> dict[str, Any]:
        """Return the profile as rosbag2 writes it into metadata (version 9)."""
        fields = asdict(self)
        return {name: _time(value) if name in DURATIONS else value for name, value in fields.items()}

    @classmethod
    def from_tree(cls, tree: Mapping[str, Any]) -> QosRecord:
        """Read a profile; missing policies get their defaults, numbers of older versions their names.

        Raises:
            ValueError: A policy or a time has a value that does not exist.
        """
        unknown = set(tree) - set(cls.__dataclass_fields__)
        if unknown:
            raise ValueError(f"unknown QoS policy {', '.join(sorted(map(str, unknown)))}")
        values: dict[str, Any] = {name: _policy(name, tree[name]) for name in POLICIES if name in tree}
        values |= {name: _nanoseconds(name, tree[name]) for name in DURATIONS if name in tree}
        if "depth" in tree:
            depth = tree["depth"]
            if not isinstance(depth, int) or isinstance(depth, bool) or depth < 0:
                raise ValueError(f"QoS depth must be an integer of at least 0, got {depth!r}")
            values["depth"] = depth
        if "avoid_ros_namespace_conventions" in tree:
            values["avoid_ros_namespace_conventions"] = bool(tree["avoid_ros_namespace_conventions"])
        return cls(**values)


def _policy(name: str, value: Any) -> str:
    known = POLICIES[name]
    if isinstance(value, str) and value.lower() in known:
        return value.lower()
    if isinstance(value, int | float) and not isinstance(value, bool) and value in range(len(known)):
        return known[int(value)]
    raise ValueError(f"QoS {name} must be one of {', '.join(known)}, got {value!r}")


def _time(nanoseconds: int) -> dict[str, int]:
    seconds, rest = divmod(nanoseconds, 1_000_000_000)
    return {"sec": seconds, "nsec": rest}


def _nanoseconds(name: str, tree: Any) -> int:
    if not isinstance(tree, Mapping) or not all(isinstance(tree.get(key, 0), int) for key in ("sec", "nsec")):
        raise ValueError(f"QoS {name} must have integers `sec` and `nsec`, got {tree!r}")
    seconds, rest = tree.get("sec", 0), tree.get("nsec", 0)
    if seconds < 0 or rest < 0:
        raise ValueError(f"QoS {name} must not be negative, got {seconds} s {rest} ns")
    total = seconds * 1_000_000_000 + rest
    # Zero means unspecified to rmw, the same as infinite.
    if (seconds, rest) in _OLD_INFINITES or total == 0 or total > INFINITE:
        return INFINITE
    return int(total)


def request_for(topic: str, offers: Sequence[QosRecord], warn: Callable[[str], object]) -> QosRecord:
    """Choose the strictest request that every publisher of a topic can serve.

    Reliable only if all are reliable; transient local, which brings latched messages, only if all are. `warn`
    is called with a sentence for each of the two that only some publishers offer.
    """
    reliable = [offer.reliability == "reliable" for offer in offers]
    latched = [offer.durability == "transient_local" for offer in offers]
    if any(reliable) and not all(reliable):
        warn(
            f'Some, but not all, publishers on topic "{topic}" are reliable. Falling back to best effort, '
            "which connects to all of them; some messages from the reliable ones may be lost."
        )
    if any(latched) and not all(latched):
        warn(
            f'Some, but not all, publishers on topic "{topic}" are transient local. Falling back to '
            "volatile, which connects to all of them; messages latched before now are not received."
        )
    return QosRecord(
        reliability="best_effort" if offers and not all(reliable) else "reliable",
        durability="transient_local" if offers and all(latched) else "volatile",
    )


def serves(offer: QosRecord, request: QosRecord) -> bool:
    """Tell whether a publisher's reliability and durability satisfy a subscription's."""
    reliable = request.reliability != "reliable" or offer.reliability == "reliable"
    durable = request.durability != "transient_local" or offer.durability == "transient_local"
    return reliable and durable


# Messages that wait for a subscription that missed them and asks again, which it can do with every heartbeat
# (a tenth of a second): half a second of 200 Hz. A latched topic keeps its own number: late ones get so many.
_KEPT = 100


def offer_for(topic: str, recorded: Sequence[QosRecord], warn: Callable[[str], object]) -> QosRecord:
    """Choose the profile to publish a recorded topic with: the recorded one if all its publishers agreed.

    Unless it is latched its queue is deeper, so that what is missed can be sent again. `warn` is called with
    a sentence if the publishers did not agree.
    """
    if not recorded:
        return QosRecord(depth=_KEPT)
    # History and lifespan do not decide who connects to whom.
    effective = {replace(profile, history="keep_last", depth=0, lifespan=INFINITE) for profile in recorded}
    if len(effective) > 1:
        warn(
            f"Not all original publishers on topic {topic} offered the same QoS profiles; "
            "publishing with the default profile."
        )
        return QosRecord(depth=_KEPT)
    profile = recorded[0]
    if profile.history not in ("keep_last", "keep_all") or (
        profile.history == "keep_last" and not profile.depth
    ):
        profile = replace(profile, history="keep_last", depth=QosRecord.depth)
    if profile.durability != "transient_local" and profile.history == "keep_last":
        profile = replace(profile, depth=max(profile.depth, _KEPT))
    # Discovery did not tell these, and nobody can be asked for them.
    unknown = [n for n in ("reliability", "durability", "liveliness") if getattr(profile, n) == "unknown"]
    return replace(profile, **{name: getattr(QosRecord, name) for name in unknown})


def read_overrides(path: Path | None) -> dict[str, QosRecord]:
    """Read a file that says which profile to use for which topic; no file gives none.

    Raises:
        Ros2CliError: `invalid_overrides`.
    """
    if path is None:
        return {}
    try:
        tree = yaml.safe_load(path.read_text(encoding="utf-8"))
        if not isinstance(tree, dict):
            raise ValueError(f"expected a mapping of topic names to profiles, got {tree!r}")
        profiles = {str(name): QosRecord.from_tree(profile or {}) for name, profile in tree.items()}
    except (OSError, UnicodeDecodeError, yaml.YAMLError, ValueError, TypeError) as error:
        raise Ros2CliError(
            "invalid_overrides", f"QoS profile overrides '{path}' cannot be read: {error}"
        ) from error
    return {name if name.startswith("/") else f"/{name}": profile for name, profile in profiles.items()}


def to_record(profile: Any) -> QosRecord:
    """Return what a bag stores of a profile of rclpy's."""
    policies: dict[str, Any] = {name: getattr(profile, name).name.lower() for name in POLICIES}
    # Zero stands for unspecified.
    times: dict[str, Any] = {name: getattr(profile, name).nanoseconds or INFINITE for name in DURATIONS}
    avoid = bool(profile.avoid_ros_namespace_conventions)
    return QosRecord(depth=profile.depth, avoid_ros_namespace_conventions=avoid, **policies, **times)


def from_record(record: QosRecord) -> Any:
    """Return the rclpy.qos.QoSProfile to publish or subscribe with."""
    from rclpy.duration import Duration
    from rclpy.qos import QoSProfile

    return QoSProfile(
        depth=record.depth,
        avoid_ros_namespace_conventions=record.avoid_ros_namespace_conventions,
        **{name: _policy_class(name)[getattr(record, name).upper()] for name in POLICIES},
        **{name: Duration(nanoseconds=getattr(record, name)) for name in DURATIONS},
    )


def from_options(options: Any) -> Any:
    """Return the rclpy.qos.QoSProfile that the `--qos-*` options of a command describe."""
    from rclpy.duration import Duration
    from rclpy.qos import DurabilityPolicy, QoSPresetProfiles, QoSProfile

    # The presets are shared objects: a copy is changed.
    preset = QoSPresetProfiles.get_from_short_key(options.qos_profile or options.default_preset)
    profile = QoSProfile(**{slot[1:]: getattr(preset, slot[1:]) for slot in QoSProfile.__slots__})
    for name in POLICIES:
        if word := getattr(options, f"qos_{name}"):
            setattr(profile, name, _policy_class(name).get_from_short_key(word))
    if options.qos_liveliness_lease_duration_seconds is not None:
        profile.liveliness_lease_duration = Duration(seconds=options.qos_liveliness_lease_duration_seconds)
    if options.qos_depth is not None:
        profile.depth = options.qos_depth
    elif profile.durability == DurabilityPolicy.TRANSIENT_LOCAL and profile.depth == 0:
        profile.depth = 1
    return profile


def asked_record(options: Any) -> QosRecord | None:
    """Return the profile that the `--qos-*` options of a command describe, None if none of them is given."""
    given = {name for name, value in vars(options).items() if name.startswith("qos_") and value is not None}
    return to_record(from_options(options)) if given else None


def _policy_class(name: str) -> Any:
    """Return rclpy's enumeration of a policy, such as rclpy.qos.HistoryPolicy."""
    import rclpy.qos

    return getattr(rclpy.qos, f"{name.capitalize()}Policy")
