# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Goals of the action with their trajectory as bytes, as a topic has it, without an object for each point.

rclpy makes objects of a goal on the thread that publishes the joint states: of 20,000 points, for almost a
second. It asks the type of the request for a C function that makes Python's object of a message (rosidl's
`_CONVERT_TO_PY`). The request type here gives another: it has the trajectory serialized from where it is in
memory, and shows the function of the real type a message without points.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from typing import Any, NamedTuple

from control_msgs.action import FollowJointTrajectory
from rclpy.serialization import serialize_message
from rclpy.type_support import check_for_type_support
from trajectory_msgs.msg import JointTrajectory


class _Sequence(ctypes.Structure):
    """rosidl_runtime_c's sequences and strings."""

    _fields_ = (("data", ctypes.c_void_p), ("size", ctypes.c_size_t), ("capacity", ctypes.c_size_t))


class _Trajectory(ctypes.Structure):
    """trajectory_msgs__msg__JointTrajectory."""

    _fields_ = (
        ("stamp_sec", ctypes.c_int32),
        ("stamp_nanosec", ctypes.c_uint32),
        ("frame_id", _Sequence),
        ("joint_names", _Sequence),
        ("points", _Sequence),
    )


class _RequestHead(ctypes.Structure):
    """FollowJointTrajectory_SendGoal_Request up to its trajectory."""

    _fields_ = (("goal_id", ctypes.c_uint8 * 16), ("trajectory", _Trajectory))


_get_pointer = ctypes.pythonapi.PyCapsule_GetPointer
_get_pointer.restype, _get_pointer.argtypes = ctypes.c_void_p, (ctypes.py_object, ctypes.c_char_p)
_new_capsule = ctypes.pythonapi.PyCapsule_New
_new_capsule.restype = ctypes.py_object
_new_capsule.argtypes = (ctypes.c_void_p, ctypes.c_char_p, ctypes.c_void_p)
_ConvertToPy = ctypes.PYFUNCTYPE(ctypes.py_object, ctypes.c_void_p)
_Create = ctypes.PYFUNCTYPE(ctypes.c_void_p)
_ConvertFromPy = ctypes.PYFUNCTYPE(ctypes.c_bool, ctypes.py_object, ctypes.c_void_p)
_Destroy = ctypes.PYFUNCTYPE(None, ctypes.c_void_p)


class LeanGoal(NamedTuple):
    """A goal."""

    message: Any
    """control_msgs/action/FollowJointTrajectory, Goal; its trajectory without points."""
    points: int
    """How many the trajectory has."""
    trajectory: bytes
    """trajectory_msgs/JointTrajectory, serialized; empty if it has more points than are taken."""


class _LeanRequest(NamedTuple):
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
    as_objects = _ConvertToPy(_get_pointer(type(request_type)._CONVERT_TO_PY, None))

    def convert(address: int) -> _LeanRequest:
        trajectory = _RequestHead.from_address(address).trajectory
        count = trajectory.points.size
        data = _serialized(trajectory) if count <= most_points() else b""
        trajectory.points.size = 0
        try:
            request = as_objects(address)
        finally:
            trajectory.points.size = count  # of what is freed afterwards
        return _LeanRequest(request.goal_id, LeanGoal(request.goal, count, data))

    callback = _ConvertToPy(convert)

    class RequestType(type(request_type)):  # type: ignore[misc]  # rosidl's types carry these in their metaclass
        _CONVERT_TO_PY = _capsule(callback)
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


def _serialized(trajectory: _Trajectory) -> bytes:
    """A message in memory as bytes: rclpy is shown it where it would make one of an object."""
    create = _Create(lambda: ctypes.addressof(trajectory))
    fill = _ConvertFromPy(lambda *_: True)  # it is filled
    keep = _Destroy(lambda _: None)  # whose it is frees it

    class InMemory(metaclass=type(JointTrajectory)):  # type: ignore[metaclass]  # has the type support
        _CREATE_ROS_MESSAGE, _CONVERT_FROM_PY, _DESTROY_ROS_MESSAGE = map(_capsule, (create, fill, keep))

    data: bytes = serialize_message(InMemory())
    return data


def _capsule(function: Any) -> Any:
    """A C function as rosidl's types carry theirs."""
    return _new_capsule(ctypes.cast(function, ctypes.c_void_p), None, None)
