# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""What the permissions for SROS2 allow, decided by a reading of its own of the files that are written."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from datetime import UTC, datetime
from fnmatch import fnmatchcase
from pathlib import Path

import pytest

from teo_bringup.access import write_access_files

NOW = datetime(2026, 11, 23, 8, 0, 0, tzinfo=UTC)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("access") / "new"
    write_access_files(folder, domain=7, now=NOW)
    return folder


def who_may(folder: Path, act: str, topic: str) -> set[str]:
    """Enclaves that may publish or subscribe to a DDS topic: DDS Security 1.1, 9.4.1.3, by fnmatch."""
    return {
        path.parent.name
        for path in folder.glob("*/permissions.xml")
        for pattern in ET.parse(path).iterfind(f".//allow_rule/{act}/topics/topic")
        if fnmatchcase(topic, pattern.text or "")
    }


@pytest.mark.parametrize(
    ("act", "topic", "enclaves"),
    [
        ("publish", "rt/joint_trajectory", {"executor"}),
        ("publish", "rt/left_arm/joint_trajectory", set()),
        ("publish", "rt/follow_joint_trajectory/_action/status", {"driver"}),
        ("publish", "rq/follow_joint_trajectory/_action/send_goalRequest", {"executor"}),
        ("publish", "rt/sign_tokens", {"translator", "console"}),
        ("publish", "rt/text", {"console", "operator"}),
        ("publish", "rt/joint_states", {"driver"}),
        ("publish", "rq/stopRequest", {"console", "executor", "operator"}),
        ("publish", "rr/stopReply", {"driver"}),
        ("publish", "rq/teo_sim_driver/set_parametersRequest", set()),
        ("publish", "rq/executor/set_parametersRequest", {"console"}),
        ("subscribe", "rq/teo_sim_driver/set_parametersRequest", {"driver"}),
        ("subscribe", "rt/joint_trajectory", {"driver", "recorder", "operator"}),
        ("subscribe", "rt/camera/color/image_raw", {"retriever", "recorder", "operator"}),
    ],
)
def test_only_those_may_who_need_to(act: str, topic: str, enclaves: set[str], folder: Path) -> None:
    assert who_may(folder, act, topic) == enclaves


def test_all_else_is_denied_and_all_must_say_who_they_are(folder: Path) -> None:
    for path in folder.glob("*/permissions.xml"):
        grant = ET.parse(path).find("permissions/grant")
        assert grant is not None
        assert grant.findtext("default") == "DENY"
        assert grant.findtext("subject_name") == f"CN=/teo/{path.parent.name}"
        assert grant.findtext("validity/not_before") == "2026-11-23T08:00:00"
        assert grant.findtext("allow_rule/domains/id") == "7"
    rule = ET.parse(folder / "governance.xml").find("domain_access_rules/domain_rule")
    assert rule is not None
    assert rule.findtext("allow_unauthenticated_participants") == "false"
    assert rule.findtext("enable_join_access_control") == "true"
    assert rule.findtext("topic_access_rules/topic_rule/topic_expression") == "*"
    assert rule.findtext("topic_access_rules/topic_rule/data_protection_kind") == "ENCRYPT"


def test_elements_stand_in_the_order_of_the_standard(folder: Path) -> None:
    """DDS Security 1.1, 9.4.1.2 and 9.4.1.3; a parser by the schema refuses another."""
    governance = (
        "dds domain_access_rules domain_rule domains id allow_unauthenticated_participants "
        "enable_join_access_control discovery_protection_kind liveliness_protection_kind "
        "rtps_protection_kind topic_access_rules topic_rule topic_expression enable_discovery_protection "
        "enable_liveliness_protection enable_read_access_control enable_write_access_control "
        "metadata_protection_kind data_protection_kind"
    )
    assert [element.tag for element in ET.parse(folder / "governance.xml").iter()] == governance.split()
    permissions = (
        "dds permissions grant subject_name validity not_before not_after allow_rule domains id "
        "publish topics topic subscribe default"
    )
    for path in folder.glob("*/permissions.xml"):
        assert list(dict.fromkeys(each.tag for each in ET.parse(path).iter())) == permissions.split()
