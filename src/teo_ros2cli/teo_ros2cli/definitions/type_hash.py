"""The hash of an installed interface (RIHS01 of REP 2016), as its build wrote it beside the definition."""

from __future__ import annotations

import json

from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.packages import InterfaceName, package_prefix


def installed_type_hash(type_name: str) -> str:
    """Return the type description hash, such as `RIHS01_df66...`, or an empty string if none is installed."""
    try:
        package, kind, short = type_name.split("/")
        base = short.split("_")[0]
        name = InterfaceName(package, kind, base)
        path = package_prefix(name.package) / "share" / name.package / name.kind / f"{name.type}.json"
        hashes = json.loads(path.read_text(encoding="utf-8"))["type_hashes"]
        return next((str(entry["hash_string"]) for entry in hashes if entry["type_name"] == type_name), "")
    except (Ros2CliError, OSError, ValueError, KeyError, TypeError):
        return ""
