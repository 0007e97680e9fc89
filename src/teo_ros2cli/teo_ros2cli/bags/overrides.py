"""Files that say which QoS profile to use for which topic."""

from __future__ import annotations

from pathlib import Path

import yaml

from teo_ros2cli.bags.qos_record import QosRecord
from teo_ros2cli.errors import Ros2CliError


def read_overrides(path: Path | None) -> dict[str, QosRecord]:
    """Read a file of QoS profiles by topic name; no file gives none.

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
