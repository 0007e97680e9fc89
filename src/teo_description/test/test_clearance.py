# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pinocchio as pin
import pytest

from teo_description.clearance import watched_pairs
from teo_description.humanoid import load_humanoid
from teo_names import LEFT_ARM, RIGHT_ARM, mirrored_name, urdf_text

# Poses [deg] in which the real TEO signed in public (teo-demos-misc, 20191023-ttd-congress.py): left, right.
REST = (0, 0, 0, 0, 0, 0)
DEMONSTRATED = {
    "hola 1": (REST, (-56.0, 9.9, 21.8, -99.6, 33.5, -26.1)),
    "hola 2": (REST, (-59.6, 9.9, 21.8, -83.6, 33.5, -17.6)),
    "mi": ((-24.5, 13.9, -51.6, -72.3, 0, 0), (-55.0, -5.0, 57.0, -99.6, -56.5, 6.7)),
    "nombre 1": ((-35.0, 7.0, -35.0, -85.0, 0, 0), (-65.0, 0, 50.0, -99.6, -20.0, 6.7)),
    "nombre 2": ((-35.0, 7.0, -35.0, -85.0, 0, 0), (-51.0, 2.0, 50.0, -80.0, -30.0, 15.0)),
    "T": (REST, (-73.2, 10.7, 10.6, -74.6, 34.7, 1.9)),
    "E": (REST, (-75.4, 12.4, 9.6, -83.5, 86.2, 2.3)),
    "O": (REST, (-73.4, 10.5, 13.1, -83.5, 25.7, -0.9)),
}


def arms(left, right):
    return dict(zip(LEFT_ARM, np.radians(left), strict=True)) | dict(
        zip(RIGHT_ARM, np.radians(right), strict=True)
    )


def test_home_is_free_of_contact_with_room_to_spare(robot):
    assert robot.clearance(robot.configuration({})).distance > 0.03


@pytest.mark.parametrize("pose", DEMONSTRATED)
def test_poses_that_the_real_robot_took_are_free_of_contact(robot, pose):
    assert robot.clearance(robot.configuration(arms(*DEMONSTRATED[pose]))).distance > 0.0


def test_hands_that_meet_are_a_collision_of_both(robot):
    positions = arms((-40, -20, -51, -80, 0, 0), (-40, 20, 51, -80, 0, 0))
    found = robot.clearance(robot.configuration(positions))
    assert found.distance < 0.0
    assert "Left" in found.first
    assert "Right" in found.second


@pytest.mark.parametrize("head_alone", [False, True])
def test_clearance_is_the_smallest_over_all_pairs(robot, random_positions, head_alone):
    """The short cut by bounding spheres against every pair measured one by one."""
    clearance = robot.head_clearance if head_alone else robot.clearance
    geometry = pin.buildGeomFromUrdfString(robot.model, urdf_text(), pin.GeometryType.COLLISION)
    by_link = {}
    for index, item in enumerate(geometry.geometryObjects):
        by_link.setdefault(robot.model.frames[item.parentFrame].name, []).append(index)
    for one, other in watched_pairs(load_humanoid()):
        if head_alone and other not in ("AxialNeck_link", "FrontalNeck_link"):
            continue
        for first in by_link[one]:
            for second in by_link[other]:
                geometry.addCollisionPair(pin.CollisionPair(first, second))
    data, geometry_data = robot.model.createData(), geometry.createData()
    for _ in range(40):
        q = robot.configuration(random_positions())
        pin.computeDistances(robot.model, data, geometry, geometry_data, q)
        smallest = min(result.min_distance for result in geometry_data.distanceResults)
        assert clearance(q).distance == pytest.approx(smallest, abs=2e-6)  # coal's own tolerance is 1e-6 m


def test_pairs_are_the_same_on_both_sides_and_none_is_a_neighbour(robot):
    pairs = {frozenset(pair) for pair in watched_pairs(load_humanoid())}
    assert pairs == {frozenset(map(mirrored_name, pair)) for pair in pairs}
    parents = {
        frozenset(
            (robot.model.names[joint] + "_link", robot.model.names[robot.model.parents[joint]] + "_link")
        )
        for joint in range(1, robot.model.njoints)
    }
    assert not pairs & parents


def test_contacts_are_all_pairs_within_a_distance_and_the_least_of_them_is_the_clearance(robot):
    q = robot.configuration(arms(*DEMONSTRATED["nombre 1"]))
    nearest = robot.clearance(q)
    contacts = robot.contacts(q, nearest.distance + 0.02)
    assert len(contacts) > 1
    least = min(contacts, key=lambda contact: contact.distance)
    assert (least.first, least.second) == (nearest.first, nearest.second)
    assert least.distance == pytest.approx(nearest.distance, abs=1e-6)
    assert robot.contacts(q, nearest.distance - 0.001) == []
    for contact in contacts:
        apart = contact.second_point - contact.first_point
        assert apart == pytest.approx(contact.distance * contact.normal, abs=1e-4)


def test_an_overlap_shrinks_as_the_link_moves_against_the_normal(robot):
    into = np.array([25, 0, 57.0, -99.6, 0, 0])
    q = robot.configuration(arms(REST, into))
    deepest = min(robot.contacts(q, 0.0), key=lambda contact: contact.distance)
    assert deepest.second == "FrontalTrunk_link"  # which stands still
    slope = robot.jacobian(q, deepest.first, RIGHT_ARM[:1])[:, 0]
    origin = robot.placement(q, deepest.first)[:3, 3]
    moves = slope[:3] + np.cross(slope[3:], deepest.first_point - origin)
    step = 0.2  # [deg]
    there = robot.contacts(robot.configuration(arms(REST, into + step * np.eye(6)[0])), 0.0)
    changed = min(contact.distance for contact in there) - deepest.distance
    assert changed == pytest.approx(-np.radians(step) * moves @ deepest.normal, rel=0.1)
