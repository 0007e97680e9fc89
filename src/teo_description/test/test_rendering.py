# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import functools
from dataclasses import replace
from itertools import pairwise

import cv2
import msgspec
import numpy as np
import pytest

from teo_description import DescriptionError
from teo_description.humanoid import Humanoid, load_humanoid
from teo_description.pictures.rendering import (
    Camera,
    Renderer,
    camera_named,
    cameras,
    render_pose,
    save_png,
)
from teo_description.pictures.visual_parts import from_file
from teo_description.robot import Robot
from teo_names import HOME, RIGHT_ARM

CAMERAS = cameras(load_humanoid("teo"))

# The right hand raised, its palm towards the addressee (the arm of TEO's own letter E).
RAISED = dict(zip(RIGHT_ARM, np.radians([-75.4, 12.4, 9.6, -83.5, 86.2, 2.3]), strict=True))


@pytest.fixture(scope="module")
def renderer():
    return Renderer()


def pixel(camera, point):
    """Where a point of base_link [m] falls on the picture: a pinhole camera of the test's own."""
    eye, forward = np.array(camera.position), np.subtract(camera.target, camera.position)
    forward = forward / np.linalg.norm(forward)
    right = np.cross(forward, [0, 0, 1])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    ray = np.asarray(point) - eye
    width, height = camera.size
    scale = height / 2 / np.tan(camera.field_of_view / 2) / (ray @ forward)
    return round(width / 2 + scale * (ray @ right)), round(height / 2 - scale * (ray @ up))


@functools.cache
def background(height, width):
    """What a camera that looks away from TEO sees."""
    away = Camera(position=(5, 0, 0), target=(9, 0, 0), field_of_view=0.5, size=(width, height))
    return render_pose({}, away).astype(int)


def figure(image):
    """Which pixels are not background."""
    return np.abs(image.astype(int) - background(*image.shape[:2])).sum(axis=2) > 6


def test_a_camera_knows_where_its_picture_shows_a_point():
    points = np.array([[0.4, 0.0, 0.3], [0.5, -0.3, 0.6], [0.2, 0.25, 0.1]])
    for camera in (each for each in CAMERAS.values() if each.follows is None):
        shown = [pixel(camera, point) for point in points]
        np.testing.assert_allclose(camera.pixels(points), shown, atol=0.5)


def test_a_picture_has_the_size_of_the_camera_and_shows_something(renderer):
    for name, camera in CAMERAS.items():
        image = renderer.render({}, name)
        assert image.shape == (480, 640, 3), name
        assert image.dtype == np.uint8
        assert image.shape[:2] == camera.size[::-1]
        assert 0.05 < figure(image).mean() < 0.7, name
    inside = Camera(position=(0.05, 0.0, 0.4), target=(1.0, 0.0, 0.4), field_of_view=1.0, size=(64, 48))
    assert renderer.render({}, inside).shape == (48, 64, 3)
    assert renderer.render({}, CAMERAS["full"].sized(300, 200)).shape == (200, 300, 3)


def test_full_view_holds_the_whole_robot_and_front_view_the_head_and_a_raised_hand(renderer):
    for camera, positions, edges in (
        ("full", HOME, "all"),
        ("full", {"FrontalLeftShoulder": -1.57, "FrontalRightShoulder": -1.57}, "all"),
        ("front", RAISED, "top and sides"),
        ("front", {"FrontalLeftShoulder": -1.57, "FrontalRightShoulder": -1.57}, "top and sides"),
    ):
        seen = figure(renderer.render(positions, camera))
        assert not seen[0].any()
        assert not seen[:, [0, -1]].any()
        assert edges != "all" or not seen[-1].any()


def test_finger_tips_are_drawn_where_the_kinematics_puts_them(renderer, robot):
    camera = CAMERAS["front"].sized(1280, 960)
    image = renderer.render(RAISED, camera)
    q = robot.configuration(RAISED)
    for finger in ("Index", "Middle", "Ring", "Pinky"):
        tip, joint = robot.placements(q, [f"Right{finger}FingerTip", f"Right{finger}FingerDistal_link"])[
            :, :3, 3
        ]
        x, y = pixel(camera, 0.6 * tip + 0.4 * joint)
        red, _, blue = image[y, x].astype(int)
        assert blue > red + 40, finger  # the tips are blue


def test_fingers_can_be_told_apart_in_the_front_view(renderer, robot):
    camera = CAMERAS["front"]
    grey = renderer.render(RAISED, camera).astype(int).sum(axis=2)
    q = robot.configuration(RAISED)
    names = [f"Right{finger}Finger" for finger in ("Index", "Middle", "Ring", "Pinky")]
    across = []
    for name in names:  # the middle of each first phalanx
        ends = robot.placements(q, [f"{name}_link", f"{name}Middle_link"])[:, :3, 3]
        across.append(np.array(pixel(camera, ends.mean(axis=0))))
    for first, second in pairwise(across):
        line = [grey[y, x] for x, y in np.linspace(first, second, 9).round().astype(int)]
        edges = min(line[0], line[-1])
        assert max(abs(value - edges) for value in line[2:-2]) > 60  # of 765


def test_right_hand_is_on_the_left_of_the_picture_and_the_face_looks_at_the_viewer(renderer):
    image = renderer.render(RAISED)
    home = renderer.render(HOME)
    moved = np.abs(image.astype(int) - home.astype(int)).sum(axis=2) > 30
    assert moved[:, :320].sum() > 50 * moved[:, 320:].sum()
    eyes = np.array(pixel(CAMERAS["front"], (0.1, 0.0, 0.72)))
    x, y = eyes
    assert image[y, x].mean() < 60  # the visor between the eyes is dark
    behind = replace(CAMERAS["front"], position=(-2.3, 0.0, 0.55))
    x, y = pixel(behind, (-0.1, 0.0, 0.72))
    assert renderer.render(HOME, behind)[y, x].mean() > 90  # no face on the back of the head


def test_hand_view_follows_the_hand(renderer):
    for positions in ({}, RAISED):
        seen = figure(renderer.render(positions, "hand"))
        assert seen[220:260, 310:330].mean() > 0.5


def test_a_renderer_can_be_used_again_and_gives_the_same_picture(renderer):
    first = renderer.render(RAISED)
    renderer.render({}, "hand")
    assert np.array_equal(renderer.render(RAISED), first)
    assert np.array_equal(render_pose(RAISED), first)


@pytest.mark.parametrize(
    "figures",
    [
        {"size": (0, 480)},
        {"size": (641, 480)},
        {"size": (100_000, 480)},
        {"field_of_view": 0.0},
        {"near": 0.0},
        {"near": float("nan")},
        {"field_of_view": float("nan")},
        {"position": (float("inf"), 0.0, 0.0)},
        {"position": (0.0, 0.0, 3.0), "target": (0.0, 0.0, 0.0)},
        {"position": (0.0, 0.0, 0.0), "target": (0.0, 0.0, 0.0)},
    ],
)
def test_impossible_cameras_are_refused(figures):
    with pytest.raises(DescriptionError) as caught:
        replace(CAMERAS["front"], **figures)
    assert caught.value.code == "bad_camera"


def test_a_hand_behind_the_back_is_seen_through_the_body(renderer, robot):
    positions = {"FrontalRightShoulder": 0.7, "AxialRightShoulder": 0.9, "FrontalRightElbow": 1.2}
    camera = CAMERAS["hand"]
    q = robot.configuration(positions)
    knuckle = robot.placement(q, camera.follows)[:3, 3]
    assert knuckle[0] < -0.2
    seen = figure(renderer.render(positions, camera))
    tip = robot.placement(q, "RightMiddleFingerTip")[:3, 3] - knuckle
    x, y = pixel(camera, 0.9 * tip)
    assert seen[y - 3 : y + 4, x - 3 : x + 4].any()


def test_a_png_says_what_was_drawn_and_replaces_an_older_one(renderer, tmp_path):
    image = renderer.render({}, CAMERAS["front"].sized(64, 48))
    path = tmp_path / "señas.png"
    path.write_bytes(b"old")
    save_png(path, image)
    assert np.array_equal(cv2.imread(str(path))[..., ::-1], image)
    assert [file.name for file in tmp_path.iterdir()] == ["señas.png"]
    with pytest.raises(DescriptionError):
        save_png(path, image[:0])


def test_a_robot_is_drawn_of_its_meshes_where_its_shapes_are():
    """What is drawn and what a hand keeps clear of are measured apart: they cover each other on a picture."""
    robot = Robot.load("gr1t2")
    if robot.humanoid.mesh_path("../meshes/gr1t2/base_link.STL") is None:
        pytest.skip("the package with its meshes is not installed: make robots")
    ready = dict(zip(robot.humanoid.commanded_joints, robot.humanoid.ready.tolist(), strict=True))
    view = camera_named("front", robot.humanoid).sized(320, 240)
    empty = replace(view, target=(5.0, 0.0, 0.36))
    drawn = []
    for humanoid in (robot.humanoid, without_meshes(robot.humanoid)):
        renderer = Renderer(Robot(humanoid))
        image, background = (renderer.render(ready, camera).astype(int) for camera in (view, empty))
        drawn.append(np.abs(image - background).sum(axis=2) > 20)
    meshes, shapes = drawn
    assert np.count_nonzero(meshes & shapes) > 0.85 * np.count_nonzero(meshes)
    assert np.count_nonzero(meshes & shapes) > 0.75 * np.count_nonzero(shapes)


def without_meshes(humanoid: Humanoid) -> Humanoid:
    """The same robot on a machine without its package."""
    bare = Humanoid(humanoid.urdf_path().parents[1])
    bare.file = msgspec.structs.replace(humanoid.file, meshes=None)
    return bare


def test_a_mesh_file_that_is_none_is_refused(tmp_path):
    pytest.importorskip("trimesh")
    path = tmp_path / "part.stl"
    path.write_bytes(b"no mesh")
    with pytest.raises(DescriptionError, match=r"part\.stl") as caught:
        from_file(path, np.ones(3))
    assert caught.value.code == "bad_mesh"
