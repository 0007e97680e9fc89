"""Writing YAML in the form that rosbag2's emitter gives it: block style, lists indented, no key sorted."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import yaml

# Text that is a plain scalar in every YAML version: anything else is quoted.
_PLAIN = re.compile(r"[A-Za-z0-9_/.][A-Za-z0-9_/.+-]*")
_RESOLVER = yaml.resolver.Resolver()


def block_yaml(tree: Mapping[str, Any] | Sequence[Any]) -> str:
    """Return a tree of mappings, sequences and scalars as YAML text that ends in a line break."""
    return "".join(f"{line}\n" for line in _lines(tree))


def _lines(tree: Any) -> Iterator[str]:
    if isinstance(tree, Mapping):
        for key, value in tree.items():
            yield from _entry(f"{_scalar(key)}:", value, "  ")
    else:
        for value in tree:
            inner = list(_lines(value)) if _is_branch(value) else [_scalar(value)]
            yield f"- {inner[0]}"
            yield from (f"  {line}" for line in inner[1:])


def _entry(head: str, value: Any, indent: str) -> Iterator[str]:
    if _is_branch(value):
        yield head
        yield from (f"{indent}{line}" for line in _lines(value))
    else:
        yield f"{head} {_scalar(value)}"


def _is_branch(value: Any) -> bool:
    return isinstance(value, Mapping | list | tuple) and bool(value)


def _scalar(value: Any) -> str:
    if value is None or value == {}:
        return "~"
    if isinstance(value, list | tuple):
        return "[]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    text = str(value)
    tag: str = _RESOLVER.resolve(yaml.ScalarNode, text, (True, False))  # type: ignore[no-untyped-call]
    if tag == "tag:yaml.org,2002:str" and _PLAIN.fullmatch(text):
        return text
    return '"' + "".join(map(_quoted, text)) + '"'


def _quoted(character: str) -> str:
    if character in '"\\':
        return "\\" + character
    if character.isprintable():
        return character
    code = ord(character)
    return f"\\x{code:02x}" if code < 0x100 else f"\\u{code:04x}" if code < 0x10000 else f"\\U{code:08x}"
