# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Goals of the action as arrays, without an object for each point.

rclpy makes objects of a goal on the thread that publishes the joint states: of 20,000 points, for almost a
second. It asks the type of the request for a C function that makes Python's object of a message (rosidl's
`_CONVERT_TO_PY`). The request type here gives another: it reads the points from the message in memory, which
has the layout of rosidl's C structures, and leaves the rest to the function of the real type, which it shows
a message without points.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from control_msgs.action import FollowJointTrajectory
from numpy.typing import NDArray
from rclpy.type_support import check_for_type_support

from teo_sim_driver.checking.cdr import FIELDS
from teo_sim_driver.motion.bezier import FloatArray


class _Sequence(ctypes.Structure):
    """rosidl_runtime_c's sequences and strings."""

    _fields_ = (("data", ctypes.c_void_p), ("size", ctypes.c_size_t), ("capacity", ctypes.c_size_t))


class _RequestHead(ctypes.Structure):
    """FollowJointTrajectory_SendGoal_Request up to its trajectory's points."""

    _fields_ = (
        ("goal_id", ctypes.c_uint8 * 16),
        ("stamp_sec", ctypes.c_int32),
        ("stamp_nanosec", ctypes.c_uint32),
        ("frame_id", _Sequence),
        ("joint_names", _Sequence),
        ("points", _Sequence),
    )


# trajectory_msgs__msg__JointTrajectoryPoint
_POINT = np.dtype(
    [
        ("fields", [("data", np.uintp), ("size", np.uintp), ("capacity", np.uintp)], len(FIELDS)),
        ("sec", np.int32),
        ("nanosec", np.uint32),
    ],
    align=True,
)
_DOUBLE = 8  # [bytes]

_get_pointer = ctypes.pythonapi.PyCapsule_GetPointer
_get_pointer.restype, _get_pointer.argtypes = ctypes.c_void_p, (ctypes.py_object, ctypes.c_char_p)
_new_capsule = ctypes.pythonapi.PyCapsule_New
_new_capsule.restype = ctypes.py_object
_new_capsule.argtypes = (ctypes.c_void_p, ctypes.c_char_p, ctypes.c_void_p)
_Convert = ctypes.PYFUNCTYPE(ctypes.py_object, ctypes.c_void_p)


@dataclass(frozen=True, eq=False)
class GoalPoints:
    """The trajectory of a goal as arrays; attributes and `table` as those of `reading.Fields`."""

    stamp: tuple[int, int]
    names: list[str]
    count: int
    lengths: NDArray[np.int64]
    times: NDArray[np.int64]
    tables: tuple[FloatArray, ...]

    def table(self, field: int) -> FloatArray:
        """See `reading.Fields`."""
        return self.tables[field]


class LeanGoal(NamedTuple):
    """A goal."""

    message: Any
    """control_msgs/action/FollowJointTrajectory, Goal; its trajectory without points."""
    points: GoalPoints


class LeanRequest(NamedTuple):
    """What rclpy's action server reads of a request."""

    goal_id: Any
    goal: LeanGoal


def lean_action(most_points: Callable[[], int]) -> Any:
    """The action type for a server whose goals' requests are `LeanGoal`.

    Args:
        most_points: Of messages with more, only their number is read.
    """
    check_for_type_support(FollowJointTrajectory)
    request_type = FollowJointTrajectory.Impl.SendGoalService.Request
    as_objects = _Convert(_get_pointer(type(request_type)._CONVERT_TO_PY, None))

    def convert(address: int) -> LeanRequest:
        sequence = _RequestHead.from_address(address).points
        count = sequence.size
        sequence.size = 0
        try:
            request = as_objects(address)
        finally:
            sequence.size = count  # of what is freed afterwards
        trajectory = request.goal.trajectory
        stamp = (trajectory.header.stamp.sec, trajectory.header.stamp.nanosec)
        names = list(trajectory.joint_names)
        read = count if count <= most_points() else 0
        return LeanRequest(
            request.goal_id,
            LeanGoal(request.goal, GoalPoints(stamp, names, count, *_read(sequence.data, read, len(names)))),
        )

    callback = _Convert(convert)

    class RequestType(type(request_type)):  # type: ignore[misc]  # rosidl's types carry these in their metaclass
        _CONVERT_TO_PY = _new_capsule(ctypes.cast(callback, ctypes.c_void_p), None, None)
        keep = callback  # the capsule does not

    class Request(request_type, metaclass=RequestType):  # type: ignore[misc, valid-type]
        pass

    class SendGoalService(FollowJointTrajectory.Impl.SendGoalService):
        pass

    SendGoalService.Request = Request

    class Impl(FollowJointTrajectory.Impl):
        pass

    Impl.SendGoalService = SendGoalService

    class Action(FollowJointTrajectory):
        pass

    Action.Impl = Impl
    return Action


def _read(
    address: int | None, count: int, width: int
) -> tuple[NDArray[np.int64], NDArray[np.int64], tuple[FloatArray, ...]]:
    """Lengths, times and tables of points in memory; as `reading.Fields` has them."""
    memory = (ctypes.c_char * (count * _POINT.itemsize)).from_address(address or 0)
    points = np.ndarray(count, _POINT, buffer=memoryview(memory))
    lengths = points["fields"]["size"].astype(np.int64)
    times = np.column_stack([points["sec"], points["nanosec"]]).astype(np.int64)
    tables = tuple(np.zeros((count, width)) for _ in FIELDS)
    size = width * _DOUBLE
    for field, table in enumerate(tables):
        # Points with another number of values are refused before their values are looked at.
        whole = np.flatnonzero(lengths[:, field] == width)
        sources = points["fields"]["data"][whole, field].tolist()
        targets = (table.ctypes.data + whole * size).tolist()
        for source, target in zip(sources, targets, strict=True):
            ctypes.memmove(target, source, size)
    return lengths, times, tables
