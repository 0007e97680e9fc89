# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import re
from pathlib import Path

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from teo_ros2cli.bags.metadata import (
    BagMetadata,
    TopicRecord,
    block_text,
    offered_qos_text,
    parse_offered_qos,
)
from teo_ros2cli.bags.playback import Schedule
from teo_ros2cli.bags.selection import TopicSelection, is_hidden
from teo_ros2cli.bags.writer import BackgroundWriter, BagWriter
from teo_ros2cli.errors import Ros2CliError
from teo_ros2cli.interfaces import schema_of
from teo_ros2cli.qos import QosRecord, offer_for, read_overrides, request_for, serves

RELIABLE = QosRecord()
BEST_EFFORT = QosRecord(reliability="best_effort")
LATCHED = QosRecord(durability="transient_local")


# Quality of service


@pytest.mark.parametrize(
    ("offers", "reliability", "durability", "warnings"),
    [
        ([], "reliable", "volatile", 0),
        ([RELIABLE], "reliable", "volatile", 0),
        ([LATCHED, LATCHED], "reliable", "transient_local", 0),
        ([RELIABLE, LATCHED], "reliable", "volatile", 1),
        ([RELIABLE, BEST_EFFORT], "best_effort", "volatile", 1),
        ([BEST_EFFORT, LATCHED], "best_effort", "volatile", 2),
    ],
)
def test_the_request_is_the_strictest_that_all_publishers_serve(
    offers: list[QosRecord], reliability: str, durability: str, warnings: int
) -> None:
    told: list[str] = []
    request = request_for("/t", offers, told.append)
    assert (request.reliability, request.durability, len(told)) == (reliability, durability, warnings)
    assert all(serves(offer, request) for offer in offers)


def test_a_recorded_profile_is_offered_again_if_all_publishers_agreed() -> None:
    seen = QosRecord(history="unknown", depth=0, durability="transient_local", deadline=10**9)
    told: list[str] = []
    offer = offer_for("/t", [seen, seen], told.append)
    assert (offer.durability, offer.deadline) == ("transient_local", 10**9)
    assert (offer.history, offer.depth) == ("keep_last", 10)
    # What a reliable subscription missed is still there when it asks again: a second of 100 Hz at least.
    offer = offer_for("/t", [RELIABLE], told.append)
    assert (offer.reliability, offer.durability) == ("reliable", "volatile")
    assert offer.depth >= 100
    assert offer_for("/t", [], told.append) == offer
    assert told == []
    assert offer_for("/t", [LATCHED, RELIABLE], told.append) == offer
    assert len(told) == 1


def test_profiles_survive_their_text_and_old_numbers_are_understood() -> None:
    profiles = (
        LATCHED,
        QosRecord(history="keep_all", deadline=1_500_000_000, avoid_ros_namespace_conventions=True),
    )
    assert parse_offered_qos(offered_qos_text(profiles)) == profiles
    assert parse_offered_qos("") == parse_offered_qos(None) == parse_offered_qos(offered_qos_text(())) == ()
    old = "- history: 3\n  depth: 0\n  reliability: 1\n  durability: 1\n  deadline:\n    sec: 2147483647\n"
    old += "    nsec: 4294967295\n  lifespan: {sec: 0, nsec: 0}\n  liveliness: 1\n"
    assert parse_offered_qos(old) == (QosRecord(history="unknown", depth=0, durability="transient_local"),)


@pytest.mark.parametrize(
    "text",
    ["{a: 1}", "[1]", "- history: never", "- {depth: -1}", "- {deadline: {sec: -1}}", "- [", "- {x: 1}"],
)
def test_profiles_that_make_no_sense_are_refused(text: str) -> None:
    with pytest.raises(ValueError, match=r"\w"):
        parse_offered_qos(text)


def test_overrides_are_read_from_a_file(tmp_path: Path) -> None:
    path = tmp_path / "overrides.yaml"
    path.write_text(
        "chatter:\n  reliability: best_effort\n  depth: 5\n/other:\n  deadline: {sec: 1, nsec: 5}\n"
    )
    assert read_overrides(path) == {
        "/chatter": QosRecord(reliability="best_effort", depth=5),
        "/other": QosRecord(deadline=1_000_000_005),
    }
    assert read_overrides(None) == {}
    for text in ("[]", "a: {reliability: sometimes}", "a: {speed: 1}", ":", "a: 3"):
        path.write_text(text)
        with pytest.raises(Ros2CliError) as caught:
            read_overrides(path)
        assert caught.value.code == "invalid_overrides"


# Metadata text


@given(st.dictionaries(st.text(max_size=8), st.text(max_size=90), max_size=4))
def test_custom_data_of_any_text_are_read_back_from_the_text_of_metadata(custom: dict[str, str]) -> None:
    tree = BagMetadata((), (), 5, 7, custom_data=custom).to_tree()
    read = yaml.safe_load(block_text({"rosbag2_bagfile_information": tree}))
    assert (read["rosbag2_bagfile_information"]["custom_data"] or {}) == custom


# Which topics


def test_all_topics_are_all_but_the_hidden_and_the_excluded() -> None:
    selection = TopicSelection(
        everything=True,
        excluded_names=frozenset({"/noise"}),
        excluded_pattern=re.compile("camera"),
        excluded_types=frozenset({"sensor_msgs/msg/Image"}),
    )
    assert selection.accepts("/text", "std_msgs/msg/String")
    assert not selection.accepts("/noise", "std_msgs/msg/String")
    assert not selection.accepts("/left/camera/info", "std_msgs/msg/String")
    assert not selection.accepts("/picture", "sensor_msgs/msg/Image")
    assert not selection.accepts("/a/_action/status", "x/msg/Y")
    assert TopicSelection(everything=True, include_hidden=True).accepts("/a/_action/status", "x/msg/Y")


def test_names_types_and_patterns_add_up() -> None:
    selection = TopicSelection(
        names=frozenset({"/a", "/_hidden"}), types=frozenset({"x/msg/Y"}), pattern=re.compile("^/arm/")
    )
    topics = {"/a": "t", "/_hidden": "t", "/b": "x/msg/Y", "/arm/1": "t", "/c/arm/1": "t"}
    chosen = [name for name, kind in topics.items() if selection.accepts(name, kind)]
    assert chosen == ["/a", "/_hidden", "/b", "/arm/1"]
    assert not selection.only_names
    assert TopicSelection(names=frozenset({"/a"})).only_names
    assert is_hidden("/a/_b") and not is_hidden("/a_/b_c")


# Times


def test_messages_are_due_at_their_distance_divided_by_the_rate() -> None:
    schedule = Schedule(10**18, 100.0, rate=2.0)
    assert schedule.due(10**18) == 100.0
    assert schedule.due(10**18 + 3_000_000_000) == pytest.approx(101.5)
    assert schedule.time_at(101.0) == 10**18 + 2_000_000_000


def test_a_pause_and_a_change_of_rate_move_what_is_due() -> None:
    schedule = Schedule(0, 0.0)
    schedule.pause(1.0)
    assert schedule.paused
    assert schedule.time_at(50.0) == 10**9
    schedule.resume(51.0)
    assert schedule.due(2 * 10**9) == pytest.approx(52.0)
    schedule.set_rate(10.0, 52.0)
    assert schedule.due(12 * 10**9) == pytest.approx(53.0)


# Writing in the background


def test_what_does_not_fit_the_cache_is_refused_and_the_rest_written(tmp_path: Path) -> None:
    bag = BagWriter(tmp_path / "bag")
    slow = BackgroundWriter(bag, cache_size=1000)
    slow.add_topic(TopicRecord("/t", "std_msgs/msg/String"), schema_of("std_msgs/msg/String"))
    taken = sum(slow.write("/t", i, i, b"x" * 900) for i in range(2000))
    metadata = slow.close()
    assert metadata.messages == taken >= 1
    # One message that is larger than the cache must not be lost for ever.
    second = BackgroundWriter(BagWriter(tmp_path / "second"), cache_size=10)
    second.add_topic(TopicRecord("/t", "std_msgs/msg/String"), schema_of("std_msgs/msg/String"))
    assert second.write("/t", 1, 1, b"x" * 100)
    assert second.close().messages == 1
