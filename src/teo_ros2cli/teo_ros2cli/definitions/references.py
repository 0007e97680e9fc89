"""The interfaces that a definition text (`.msg`, or a part of a `.srv` or `.action`) refers to."""

from __future__ import annotations

import re
from collections.abc import Iterator

from teo_ros2cli.packages import InterfaceName

_INTEGERS = {f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)}
_BASIC = {"bool", "byte", "char", "float32", "float64", "string", "wstring", *_INTEGERS}
# A field or constant: type, optional array part, name. The type of a bounded string holds `<=`.
_FIELD = re.compile(r"^\s*([A-Za-z][\w/]*)(?:<=\d+)?(?:\[[^\]]*\])?\s+[A-Za-z]\w*")


def referenced_types(text: str, package: str) -> Iterator[InterfaceName]:
    """Yield the message types of the fields of a definition, in order, repeats included.

    Args:
        text: The definition, comments and all.
        package: Package that it belongs to: types without a package are of this one.
    """
    for line in text.splitlines():
        match = _FIELD.match(line.split("#", 1)[0])
        if match is None or match[1] in _BASIC:
            continue
        parts = match[1].split("/")
        if len(parts) == 1:
            # `Header` alone is the one type that ROS 1 let people write without its package.
            yield InterfaceName("std_msgs" if parts[0] == "Header" else package, "msg", parts[0])
        else:
            yield InterfaceName(parts[0], "msg", parts[-1])
