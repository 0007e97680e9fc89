# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
import pytest
from action_msgs.msg import GoalStatus
from control_msgs.action import FollowJointTrajectory
from control_msgs.msg import JointTolerance, JointTrajectoryControllerState
from control_msgs.srv import QueryTrajectoryState
from rclpy.action import ActionClient
from rclpy.parameter import Parameter
from teo_sign_msgs.msg import DriverState
from trajectory_msgs.msg import JointTrajectory

from teo_names import COMMANDED_JOINTS, LEFT_ARM, RIGHT_ARM

Result = FollowJointTrajectory.Result
ELBOW = "FrontalRightElbow"


class Client:
    """Sends goals and waits for what becomes of them."""

    def __init__(self, bench, prefix=""):
        self.bench = bench
        name = f"{prefix}follow_joint_trajectory"
        self.client = ActionClient(bench.client, FollowJointTrajectory, name)
        bench.until(self.client.server_is_ready)
        self.feedback = []

    def send(self, trajectory, **fields):
        goal = FollowJointTrajectory.Goal(trajectory=trajectory, **fields)
        answer = self.client.send_goal_async(
            goal, feedback_callback=lambda message: self.feedback.append(message.feedback)
        )
        self.bench.until(answer.done)
        assert answer.result().accepted
        return answer.result()

    def end(self, handle):
        """Status and result of a goal."""
        answer = handle.get_result_async()
        self.bench.until(answer.done)
        return answer.result().status, answer.result().result

    def moving(self):
        self.bench.until(lambda: self.bench.position(ELBOW) < -0.02)


@pytest.fixture
def client(bench):
    return Client(bench)


def test_a_goal_is_executed_told_of_and_succeeds_at_its_end(bench, client, one_way):
    controller_states = []
    bench.client.create_subscription(
        JointTrajectoryControllerState, "controller_state", controller_states.append, 10
    )
    trajectory = one_way(duration=2.0, angle=-0.2)
    handle = client.send(trajectory, goal_tolerance=[JointTolerance(name=ELBOW, position=0.001)])
    client.moving()
    assert bench.driver_states[-1].source == DriverState.SOURCE_ACTION
    status, result = client.end(handle)
    assert (status, result.error_code, result.error_string) == (
        GoalStatus.STATUS_SUCCEEDED,
        Result.SUCCESSFUL,
        "",
    )
    assert abs(bench.position(ELBOW) + 0.2) < 1e-9
    elbow = COMMANDED_JOINTS.index(ELBOW)
    told = [each.actual.positions[elbow] for each in client.feedback]
    assert len(told) > 5
    assert sorted(told, reverse=True) == told
    bench.until(lambda: controller_states)
    assert list(controller_states[-1].joint_names) == list(COMMANDED_JOINTS)


def test_the_result_of_a_refused_goal_says_why(bench, client, one_way):
    incomplete, base = one_way(), FollowJointTrajectory.Goal().multi_dof_trajectory
    incomplete.joint_names.pop()
    base.joint_names = ["base"]
    for fields, code, reason in (
        ({"trajectory": incomplete}, Result.INVALID_JOINTS, "missing_joints"),
        (
            {"path_tolerance": [JointTolerance(name="none", position=1.0)]},
            Result.INVALID_GOAL,
            "bad_tolerance",
        ),
        ({"multi_dof_trajectory": base}, Result.INVALID_GOAL, "multi_dof"),
    ):
        status, result = client.end(client.send(**{"trajectory": one_way()} | fields))
        assert (status, result.error_code) == (GoalStatus.STATUS_ABORTED, code)
        assert result.error_string.startswith(f"{reason}: ")
        bench.until(lambda reason=reason: bench.driver_states[-1].refusal_code == reason)


def test_a_cancelled_goal_slows_down_and_holds(bench, client, one_way):
    handle = client.send(one_way(duration=4.0, angle=-0.5))
    client.moving()
    handle.cancel_goal_async()
    status, _ = client.end(handle)
    assert status == GoalStatus.STATUS_CANCELED
    bench.until(lambda: bench.mode() == DriverState.MODE_HOLDING)
    assert -0.5 < bench.position(ELBOW) < -0.02


def test_the_newest_command_wins_and_the_goal_before_it_is_told(bench, client, one_way):
    first = client.send(one_way(duration=6.0, angle=-0.5))
    client.moving()
    back = one_way(duration=1.0, angle=0.0)
    for point in back.points:
        point.time_from_start.sec += 2
    second = client.send(back)
    status, result = client.end(first)
    assert (status, result.error_code) == (GoalStatus.STATUS_ABORTED, Result.INVALID_GOAL)
    assert "a newer goal" in result.error_string
    bench.commands.publish(back)
    status, result = client.end(second)
    assert (status, result.error_code) == (GoalStatus.STATUS_ABORTED, Result.INVALID_GOAL)
    assert "topic" in result.error_string
    bench.until(lambda: bench.driver_states[-1].source == DriverState.SOURCE_TOPIC)
    third = client.send(back)
    assert bench.call("stop").success
    status, result = client.end(third)
    assert (status, result.error_code) == (GoalStatus.STATUS_ABORTED, Result.INVALID_GOAL)
    assert result.error_string.startswith("stopped")


def test_limbs_are_commanded_side_by_side_until_the_whole_body_takes_over(bench, one_way):
    def limb(joints, joint):
        message = one_way(duration=20.0, angle=-0.6, joint=joint)
        columns = [COMMANDED_JOINTS.index(name) for name in joints]
        for point in message.points:
            for field in ("positions", "velocities", "accelerations"):
                setattr(point, field, [getattr(point, field)[i] for i in columns])
        message.joint_names = list(joints)
        return message

    left, right = Client(bench, "left_arm/"), Client(bench, "right_arm/")
    to_the_left = bench.client.create_publisher(JointTrajectory, "left_arm/joint_trajectory", 10)
    bench.until(to_the_left.get_subscription_count)
    first = left.send(limb(LEFT_ARM, "FrontalLeftElbow"))
    second = right.send(limb(RIGHT_ARM, ELBOW))
    bench.until(lambda: bench.position(ELBOW) < -0.02 and bench.position("FrontalLeftElbow") < -0.02)
    bench.until(lambda: left.feedback and list(left.feedback[-1].joint_names) == list(LEFT_ARM))
    to_the_left.publish(limb(RIGHT_ARM, ELBOW))
    bench.until(lambda: bench.driver_states[-1].refusal_code == "other_group")
    second.cancel_goal_async()
    status, _ = right.end(second)
    assert status == GoalStatus.STATUS_CANCELED
    whole = one_way(duration=20.0, angle=-0.3)
    for point in whole.points:  # however far the arm is by now, it has time to get to the first of them
        point.time_from_start.sec += 10
    bench.commands.publish(whole)
    status, result = left.end(first)
    assert (status, result.error_code) == (GoalStatus.STATUS_ABORTED, Result.INVALID_GOAL)
    assert "topic" in result.error_string


def test_a_joint_beyond_its_tolerance_aborts_the_goal_on_the_way_or_at_the_end(bench, client, one_way):
    assert bench.driver.set_parameters([Parameter("fault_lag", value=0.2)])[0].successful
    tolerance = [JointTolerance(name=ELBOW, position=0.005)]
    on_the_way = client.send(one_way(duration=4.0, angle=-0.5), path_tolerance=tolerance)
    status, result = client.end(on_the_way)
    assert (status, result.error_code) == (GoalStatus.STATUS_ABORTED, Result.PATH_TOLERANCE_VIOLATED)
    assert ELBOW in result.error_string
    bench.until(lambda: bench.mode() == DriverState.MODE_HOLDING)

    there = bench.driver_states[-1]
    assert there.at_rest
    back = one_way(duration=1.0, angle=0.0)
    for point in back.points:
        point.time_from_start.sec += 2
    assert bench.driver.set_parameters(
        [Parameter("fault_lag", value=0.0), Parameter("fault_tracking_error", value=0.02)]
    )[0].successful
    goal = {"goal_tolerance": tolerance}
    too_far = FollowJointTrajectory.Goal(trajectory=back, **goal)
    too_far.goal_time_tolerance.nanosec = 100_000_000
    status, result = client.end(client.send(back, goal_time_tolerance=too_far.goal_time_tolerance, **goal))
    assert (status, result.error_code) == (GoalStatus.STATUS_ABORTED, Result.GOAL_TOLERANCE_VIOLATED)


def test_where_the_joints_will_be_can_be_asked(bench, one_way):
    queries = bench.client.create_client(QueryTrajectoryState, "query_state")
    bench.until(queries.service_is_ready)
    bench.commands.publish(one_way(duration=2.0, angle=-0.2))
    bench.until(lambda: bench.position(ELBOW) < -0.02)

    def ask(seconds):
        time = (bench.driver.get_clock().now().nanoseconds + int(seconds * 1e9)) // 10**9
        request = QueryTrajectoryState.Request()
        request.time.sec = time
        answer = queries.call_async(request)
        bench.until(answer.done)
        return answer.result()

    later = ask(10.0)
    assert later.success
    assert abs(later.position[list(later.name).index(ELBOW)] + 0.2) < 1e-9
    assert not ask(-10.0).success
