"""The definition of an interface as it is shown to people: nested types expanded, one tab deeper each."""

from __future__ import annotations

from collections.abc import Iterator

from teo_ros2cli.definitions.references import referenced_types
from teo_ros2cli.packages import InterfaceName, interface_file

_SECTION = "---"


def definition_lines(name: InterfaceName, *, comments: bool, nested_comments: bool) -> Iterator[str]:
    """Yield the lines of an interface's definition, after each field of a message type the lines of that.

    Args:
        name: The interface.
        comments: Keep comments and empty lines of the interface itself.
        nested_comments: Keep those of nested types as well.
    """
    text = interface_file(name).read_text(encoding="utf-8")
    yield from _expand(text, name.package, 0, comments, nested_comments)


def _expand(text: str, package: str, depth: int, comments: bool, nested_comments: bool) -> Iterator[str]:
    keep = comments if depth == 0 else nested_comments
    for line in text.splitlines():
        bare = line.split("#", 1)[0].rstrip()
        if not keep and not bare:
            continue
        # A `#` inside a default value of a string is kept: only lines without comments are cut.
        shown = line.rstrip() if keep or '"' in line or "'" in line else bare
        yield "\t" * depth + shown
        if bare == _SECTION:
            continue
        for nested in referenced_types(line, package):
            definition = interface_file(nested).read_text(encoding="utf-8")
            yield from _expand(definition, nested.package, depth + 1, comments, nested_comments)
