# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A humanoid as a rigid-body model: where its links are at a pose, and how they move with the joints."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from teo_description.clearance import Clearance, ClearanceChecker, Contact
from teo_description.errors import DescriptionError
from teo_description.humanoid import DEFAULT_ROBOT, Humanoid, load_humanoid

Matrix = NDArray[np.float64]


class Robot:
    """Kinematics of the URDF in Pinocchio.

    A configuration `q` is an array of all of the model's joint values [rad], the following phalanges
    included; make it with `configuration`. Frames are named as the links and fixed frames of the
    completed URDF; those of the hands stand in `Humanoid.file`, ``base_link`` is the root.

    Attributes:
        humanoid: What is said of the robot.
        model, data: Pinocchio's.

    Not for use by several threads at once: the results of Pinocchio's last call live in the object. Loading
    one takes some milliseconds, so give each thread its own.
    """

    def __init__(self, humanoid: Humanoid) -> None:
        self.humanoid = humanoid
        self.model: pin.Model = pin.buildModelFromXML(humanoid.urdf_text())
        self.data = self.model.createData()
        self._frames = {
            frame.name: index for index, frame in enumerate(self.model.frames) if frame.type == pin.BODY
        }
        self._names = humanoid.all_joints
        self._column = {name: index for index, name in enumerate(self._names)}
        self._expansion, self._offset = self._following()
        self._home = np.array([humanoid.home[name] for name in self._names])
        commanded = [self._column[name] for name in humanoid.commanded_joints]
        self._commanded = self._expansion[:, commanded]
        others = self._home.copy()
        others[commanded] = 0.0
        self._standing = self._expansion @ others + self._offset

    @classmethod
    def load(cls, name: str = DEFAULT_ROBOT) -> Robot:
        """Load a humanoid by its name; see `load_humanoid` for the errors."""
        return cls(load_humanoid(name))

    def _following(self) -> tuple[Matrix, Matrix]:
        """Matrix and offset that make a configuration of `all_joints`' values. Shapes (nq, joints), (nq,)."""
        matrix, offset = np.zeros((self.model.nq, len(self._names))), np.zeros(self.model.nq)
        for joint in self.humanoid.urdf_tree().findall("joint"):
            if joint.attrib["type"] == "fixed":
                continue
            name = joint.attrib["name"]
            mimic = joint.find("mimic")
            row = self.model.joints[self.model.getJointId(name)].idx_q
            if mimic is None:
                if name in self._column:  # any other stands at 0
                    matrix[row, self._column[name]] = 1.0
            elif mimic.attrib["joint"] in self._column:
                matrix[row, self._column[mimic.attrib["joint"]]] = float(mimic.get("multiplier", "1"))
                offset[row] = float(mimic.get("offset", "0"))
        return matrix, offset

    def configuration(self, positions: Mapping[str, float]) -> Matrix:
        """Expand named joint positions to the model's configuration.

        Args:
            positions: Joint positions [rad] by name, any of the humanoid's; joints not named are at home.
                Limits are not checked here.

        Returns:
            Configuration, the phalanges following their finger. Shape (nq,).

        Raises:
            DescriptionError: ``unknown_joint`` or ``not_finite``.
        """
        if not positions.keys() <= self._column.keys():
            self.humanoid.check_joint_names(positions)
        values = self._home.copy()
        for name, value in positions.items():
            values[self._column[name]] = value
        if not np.isfinite(values).all():
            bad = [name for name, value in zip(self._names, values, strict=True) if not np.isfinite(value)]
            raise DescriptionError(
                "not_finite", f"expected finite positions [rad]; got NaN or infinity for {', '.join(bad)}"
            )
        expanded: Matrix = self._expansion @ values + self._offset
        return expanded

    def configurations(self, positions: Matrix) -> Matrix:
        """Configurations of the commanded joints' positions, the other joints at home.

        Args:
            positions: In the order of `Humanoid.commanded_joints` [rad], not checked. Shape (..., joints).

        Returns:
            Shape (..., nq).
        """
        expanded: Matrix = positions @ self._commanded.T + self._standing
        return expanded

    def torques(self, positions: Matrix, velocities: Matrix, accelerations: Matrix) -> Matrix:
        """Torques that move the commanded joints so, against gravity, the legs standing at home [N m].

        Recursive Newton-Euler with the description's masses, without friction (R. Featherstone, "Rigid Body
        Dynamics Algorithms", 2008, 5.3). The phalanges that follow a hand axis load that axis.

        Args:
            positions: Of the commanded joints [rad]. Shape (n, joints), as all.
            velocities: [rad/s].
            accelerations: [rad/s^2].
        """
        turning = self._commanded
        rows = zip(
            self.configurations(positions), velocities @ turning.T, accelerations @ turning.T, strict=True
        )
        needed: Matrix = np.array([pin.rnea(self.model, self.data, *row) for row in rows]) @ turning
        return needed

    def placement(self, q: Matrix, frame: str) -> Matrix:
        """Pose of a frame in ``base_link``.

        Args:
            q: Configuration, shape (nq,).
            frame: Name of a link or of a fixed frame.

        Returns:
            Homogeneous transform [m]. Shape (4, 4).

        Raises:
            DescriptionError: ``unknown_frame`` or ``wrong_shape``.
        """
        index = self._frame_index(frame)
        pin.forwardKinematics(self.model, self.data, self._checked(q))
        matrix: Matrix = pin.updateFramePlacement(self.model, self.data, index).homogeneous
        return matrix

    def placements(self, q: Matrix, frames: Sequence[str]) -> Matrix:
        """Poses of several frames in ``base_link`` from one pass over the tree. Shape (n, 4, 4)."""
        indices = [self._frame_index(frame) for frame in frames]
        pin.forwardKinematics(self.model, self.data, self._checked(q))
        poses = np.empty((len(indices), 4, 4))
        for row, index in enumerate(indices):
            poses[row] = pin.updateFramePlacement(self.model, self.data, index).homogeneous
        return poses

    def joint_placements(self, q: Matrix, joints: Sequence[str]) -> Matrix:
        """Poses in ``base_link`` of what joints move, their origins on the joints' axes. Shape (n, 4, 4)."""
        pin.forwardKinematics(self.model, self.data, self._checked(q))
        return np.array([self.data.oMi[self.model.getJointId(name)].homogeneous for name in joints])

    def joint_axis(self, joint: str) -> Matrix:
        """The axis about which a joint turns what it moves, in the axes of that. Shape (3,)."""
        model = self.model.joints[self.model.getJointId(joint)]
        data = model.createData()
        model.calc(data, np.zeros(model.nq))
        axis: Matrix = np.asarray(data.S).ravel()[3:]
        return axis

    def moving_joint(self, frame: str) -> str:
        """The joint nearest to a link or fixed frame of those that move it.

        Raises:
            DescriptionError: ``unknown_frame``.
        """
        name: str = self.model.names[self.model.frames[self._frame_index(frame)].parentJoint]
        return name

    def carried_by(self, frame: str, joints: Sequence[str]) -> int:
        """How many of some joints move a link or fixed frame.

        Raises:
            DescriptionError: ``unknown_frame``.
        """
        joint, found = self.model.frames[self._frame_index(frame)].parentJoint, 0
        while joint:
            found += self.model.names[joint] in joints
            joint = self.model.parents[joint]
        return found

    def jacobian(self, q: Matrix, frame: str, joints: Sequence[str]) -> Matrix:
        """How a frame moves with some joints, the phalanges that follow included.

        Args:
            q: Configuration, shape (nq,).
            frame: Name of a link or of a fixed frame.
            joints: N names of the humanoid's joints.

        Returns:
            Linear velocity of the frame's origin [m/rad] over angular velocity [rad/rad], both in the axes of
            ``base_link`` (Pinocchio's LOCAL_WORLD_ALIGNED). Shape (6, n).

        Raises:
            DescriptionError: ``unknown_frame``, ``unknown_joint`` or ``wrong_shape``.
        """
        index = self._frame_index(frame)
        self.humanoid.check_joint_names(joints)
        columns = [self._column[name] for name in joints]
        full = pin.computeFrameJacobian(
            self.model, self.data, self._checked(q), index, pin.LOCAL_WORLD_ALIGNED
        )
        jacobian: Matrix = full @ self._expansion[:, columns]
        return jacobian

    def clearance(self, q: Matrix) -> Clearance:
        """Smallest distance between parts of the robot that must not touch; negative when they overlap.

        Which pairs count is said in `clearance.ClearanceChecker`.

        Raises:
            DescriptionError: ``wrong_shape``.
        """
        return self._checker.clearance(self._checked(q))

    def head_clearance(self, q: Matrix) -> Clearance:
        """The same of the head and neck alone, in a fraction of the time.

        Raises:
            DescriptionError: ``wrong_shape``.
        """
        return self._head_checker.clearance(self._checked(q))

    def contacts(self, q: Matrix, within: float) -> list[Contact]:
        """All pairs of parts that must not touch and are nearer than a distance [m]; see `clearance`.

        Raises:
            DescriptionError: ``wrong_shape``.
        """
        return self._checker.contacts(self._checked(q), within)

    @cached_property
    def _checker(self) -> ClearanceChecker:
        return ClearanceChecker(self.model, self.humanoid)

    @cached_property
    def _head_checker(self) -> ClearanceChecker:
        return ClearanceChecker(self.model, self.humanoid, of=self.humanoid.file.collision.head)

    def _frame_index(self, frame: str) -> int:
        index = self._frames.get(frame)
        if index is None:
            raise DescriptionError(
                "unknown_frame", f"expected a frame among {', '.join(self._frames)}; got {frame!r}"
            )
        return index

    def _checked(self, q: Matrix) -> Matrix:
        if np.shape(q) != (self.model.nq,):
            raise DescriptionError(
                "wrong_shape",
                f"expected a configuration of shape ({self.model.nq},) as configuration() makes it; "
                f"got {np.shape(q)}",
            )
        return q
