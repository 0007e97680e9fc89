# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Where the data files of a package are: in its source tree, or installed."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path


def package_path(package: str, relative: str) -> Path:
    """Find a file or folder of a package's data.

    Args:
        package: Name of a package of this workspace, for example ``teo_signs``.
        relative: Path below the package's source folder, which is also the path below its share folder.

    Raises:
        FileNotFoundError: Neither the source tree nor the installed package holds it; the message names the
            places that were looked at.
    """
    looked: list[str] = []
    spec = find_spec(package)
    if spec is not None and spec.origin is not None:
        place = Path(spec.origin).resolve().parents[1] / relative
        if place.exists():
            return place
        looked.append(str(place))
    try:
        from ament_index_python.packages import PackageNotFoundError, get_package_share_directory
    except ImportError:
        pass  # no ROS in this environment: only the source tree is left
    else:
        try:
            place = Path(get_package_share_directory(package)) / relative
        except PackageNotFoundError:
            pass  # nothing of that name is installed
        else:
            if place.exists():
                return place
            looked.append(str(place))
    places = ", ".join(looked) or "the source tree and the installed packages"
    raise FileNotFoundError(f"{package}: expected {relative} in {places}; build the package again")
