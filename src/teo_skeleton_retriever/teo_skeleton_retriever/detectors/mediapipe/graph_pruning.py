"""Graphs of MediaPipe without what nobody asks of them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from teo_skeleton_retriever.errors import DetectorError


def only_for(configuration: Any, streams: Iterable[str]) -> Any:
    """Leave out all that none of some streams follows from.

    A node costs some microseconds in each image also where it has nothing to do.

    Args:
        configuration: a CalculatorGraphConfig without subgraphs.
        streams: by name.

    Returns:
        A new one, with the nodes in their order and without outputs: its streams are to be observed.

    Raises:
        DetectorError: nothing gives one of the streams.
    """
    wanted = set(streams)
    needed: set[int] = set()
    while more := {
        i
        for i, node in enumerate(configuration.node)
        if i not in needed and wanted & _names(node.output_stream, node.output_side_packet)
    }:
        needed |= more
        for i in more:
            node = configuration.node[i]
            wanted |= _names(node.input_stream, node.input_side_packet)
    given = _names(configuration.input_stream, configuration.input_side_packet)
    for i in needed:
        node = configuration.node[i]
        given |= _names(node.output_stream, node.output_side_packet)
    if missing := wanted - given:
        raise DetectorError(
            "bad_graph", f"expected a graph that gives {sorted(missing)}, got one that does not"
        )
    pruned = type(configuration)()
    pruned.CopyFrom(configuration)
    del pruned.node[:], pruned.output_stream[:], pruned.input_side_packet[:]
    pruned.node.extend(configuration.node[i] for i in sorted(needed))
    pruned.input_side_packet.extend(
        packet for packet in configuration.input_side_packet if _names([packet]) & wanted
    )
    return pruned


def _names(*lists: Iterable[str]) -> set[str]:
    """Names of streams or side packets without the tags before them."""
    return {entry.rpartition(":")[2] for entries in lists for entry in entries}
