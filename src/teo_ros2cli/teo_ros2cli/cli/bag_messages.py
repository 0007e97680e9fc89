"""How the `ros2 bag` verbs speak of what is wrong."""

from __future__ import annotations

import sys

from teo_ros2cli.errors import Ros2CliError


def warn(sentence: str) -> None:
    """Print a warning."""
    print(f"[WARN] [ros2bag]: {sentence}", file=sys.stderr)


def as_bag_error(error: Ros2CliError) -> Ros2CliError:
    """Return an error whose text says that it comes from the bag tool."""
    return Ros2CliError(error.code, f"[ERROR] [ros2bag]: {error}")
