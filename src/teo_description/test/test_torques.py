# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from teo_names import COMMANDED_JOINTS, HOME, urdf_text

GRAVITY = 9.81


def row(**positions):
    values = {name: HOME[name] for name in COMMANDED_JOINTS} | positions
    return np.array([[values[name] for name in COMMANDED_JOINTS]])


def masses_below(joint):
    """Mass [kg] and place from the joint's axis [m] of each link that a joint carries, frames parallel."""
    tree = ET.fromstring(urdf_text())
    links = {link.attrib["name"]: link.find("inertial") for link in tree.iter("link")}
    found = []

    def walk(link, place):
        inertial = links[link]
        if inertial is not None:
            centre = np.array(inertial.find("origin").attrib["xyz"].split(), float)
            found.append((float(inertial.find("mass").attrib["value"]), place + centre))
        for child in tree.iter("joint"):
            if child.find("parent").attrib["link"] == link:
                origin = np.array(child.find("origin").attrib["xyz"].split(), float)
                walk(child.find("child").attrib["link"], place + origin)

    walk(f"{joint}_link", np.zeros(3))
    return found


@pytest.mark.parametrize("side", ["Left", "Right"])
def test_an_arm_held_out_weighs_its_masses_times_their_levers(robot, side):
    # Fingers straight, which is beyond their limit, so that all frames are parallel.
    straight = {name: 0.0 for name in COMMANDED_JOINTS if side in name}
    joint = f"Frontal{side}Shoulder"
    column = COMMANDED_JOINTS.index(joint)
    levers = masses_below(joint)
    still = np.zeros((1, 28))
    thumb = {f"{side}ThumbFinger": 0.0}
    for angle, axis in ((-np.pi / 2.0, 2), (0.0, 0)):
        pose = row(**(straight | thumb | {joint: angle}))
        # Turned forward by 90 deg about y, what hung down the arm's own z is ahead.
        forward = [place[0] if axis == 0 else -place[2] for _, place in levers]
        weight = sum(mass * GRAVITY * x for (mass, _), x in zip(levers, forward, strict=True))
        torque = robot.torques(pose, still, still)[0, column]
        # The second link of the thumb is bent by 46 deg when the first is straight: 0.1 kg, a centimetre.
        assert torque == pytest.approx(-weight, abs=0.1 * GRAVITY * 0.02)
        assert abs(torque) > 10.0 or axis == 0


def test_torques_are_what_energy_asks_for(robot):
    """Power put in equals the rate of change of kinetic and potential energy: a derivation of its own."""
    import pinocchio as pin

    rng = np.random.default_rng(3)
    start, speed, push = (rng.uniform(-0.4, 0.4, 28) * scale for scale in (1.0, 2.0, 5.0))
    step = 1e-4

    def energy(time):
        at = [start + speed * time + push * time**2 / 2.0, speed + push * time]
        q = [
            robot.configuration(dict(zip(COMMANDED_JOINTS, values.tolist(), strict=True)))
            for values in (at[0], at[0] + 1e-6 * at[1])
        ]
        velocity = (q[1] - q[0]) / 1e-6
        kinetic = pin.computeKineticEnergy(robot.model, robot.data, q[0], velocity)
        return kinetic + pin.computePotentialEnergy(robot.model, robot.data, q[0])

    power = (energy(step) - energy(-step)) / (2.0 * step)
    torques = robot.torques(start[None], speed[None], push[None])[0]
    assert torques @ speed == pytest.approx(power, rel=1e-3)
