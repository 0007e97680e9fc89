"""`ros2 topic list`, `type` and `find`: which topics there are."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import Any, NamedTuple

from teo_ros2cli.bags.selection import is_hidden
from teo_ros2cli.cli.options import add_graph_arguments
from teo_ros2cli.packages import InterfaceName


class _Topic(NamedTuple):
    name: str
    types: Sequence[str]
    publishers: int
    subscribers: int


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `list`."""
    add_graph_arguments(parser)
    parser.add_argument("-t", "--show-types", action="store_true", help="Additionally show the topic type")
    parser.add_argument(
        "-c", "--count-topics", action="store_true", help="Only display the number of topics discovered"
    )
    parser.add_argument(
        "-a", "--include-hidden-topics", action="store_true", help="Consider hidden topics as well"
    )
    parser.add_argument("-v", "--verbose", action="store_true", help="List full details about each topic")


def run(options: argparse.Namespace) -> int:
    """Print the topics of the graph."""
    topics = _topics(options)
    if options.count_topics:
        print(len(topics))
    elif options.verbose:
        _print_side("Published", "publisher", [(topic, topic.publishers) for topic in topics])
        _print_side("Subscribed", "subscriber", [(topic, topic.subscribers) for topic in topics])
        print()
    else:
        for topic in topics:
            print(f"{topic.name} [{', '.join(topic.types)}]" if options.show_types else topic.name)
    return 0


def _print_side(title: str, noun: str, topics: Sequence[tuple[_Topic, int]]) -> None:
    print(f"\n{title} topics:")
    for topic, count in topics:
        if count:
            plural = "s" if count > 1 else ""
            print(f" * {topic.name} [{', '.join(topic.types)}] {count} {noun}{plural}")


def add_type_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `type`."""
    add_graph_arguments(parser)
    parser.add_argument("topic_name", help="Name of the ROS topic to get type (e.g. '/chatter')")


def run_type(options: argparse.Namespace) -> int:
    """Print the types of a topic; exit status 1 if there is no such topic."""
    name = options.topic_name if options.topic_name.startswith("/") else f"/{options.topic_name}"
    options.include_hidden_topics = True
    types = [kind for topic in _topics(options) if topic.name == name for kind in topic.types]
    for kind in types:
        print(kind)
    return 0 if types else 1


def add_find_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `find`."""
    add_graph_arguments(parser)
    parser.add_argument(
        "topic_type", help="Name of the ROS topic type to filter for (e.g. 'std_msgs/msg/String')"
    )
    parser.add_argument(
        "-c", "--count-topics", action="store_true", help="Only display the number of topics discovered"
    )
    parser.add_argument(
        "-a", "--include-hidden-topics", action="store_true", help="Consider hidden topics as well"
    )


def run_find(options: argparse.Namespace) -> int:
    """Print the topics of a type."""
    wanted = str(InterfaceName.parse(options.topic_type))
    names = [topic.name for topic in _topics(options) if wanted in topic.types]
    print(
        len(names) if options.count_topics else "\n".join(names),
        end="\n" if names or options.count_topics else "",
    )
    return 0


def _topics(options: argparse.Namespace) -> list[_Topic]:
    from teo_ros2cli.graph.cli_node import cli_node, settle

    with cli_node(use_sim_time=options.use_sim_time) as node:
        settle(node, options.spin_time)
        return [
            _Topic(name, types, _count(node, "publishers", name), _count(node, "subscribers", name))
            for name, types in node.get_topic_names_and_types()
            if options.include_hidden_topics or not is_hidden(name)
        ]


def _count(node: Any, side: str, topic: str) -> int:
    return int(getattr(node, f"count_{side}")(topic))
