# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from setuptools import find_packages, setup

PACKAGE = "teo_skeleton_retriever"

setup(
    name=PACKAGE,
    version="0.2.0",
    packages=find_packages(exclude=["test", "test.*"]),
    package_data={PACKAGE: ["*.pyi", "py.typed", "lifting/networks.safetensors"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
    ],
    install_requires=[
        "av",
        "casadi",
        "flatbuffers",
        "lazy-loader",
        "lz4",
        "mcap",
        "mediapipe",
        "numpy",
        "opencv-python-headless",
        "rich",
        "rosbags",
        "safetensors",
        "scipy",
        "typer",
    ],
    zip_safe=False,
    maintainer="TEO signing project",
    maintainer_email="teo-sign@example.org",
    description=(
        "From colour and depth images to 3D keypoints of people's bodies, hands and faces: "
        "node, detectors, offline tools."
    ),
    license="Apache-2.0",
    extras_require={"test": ["pytest"]},
    entry_points={
        "console_scripts": [
            "retrieve = teo_skeleton_retriever.cli.retrieve_cli:main",
            "synthesize = teo_common.installed_packages:main",
            "sensor_study = teo_common.installed_packages:main",
            "retriever_node = teo_skeleton_retriever.node.retriever_node:main",
            "train_lifting = teo_common.installed_packages:main",
        ],
        "teo_skeleton_retriever.detectors": [
            f"mediapipe = {PACKAGE}.detectors.mediapipe.mediapipe_detector:MediaPipeDetector",
            f"openpose_json = {PACKAGE}.detectors.openpose_json_detector:OpenPoseJsonDetector",
            f"openpose_onnx = {PACKAGE}.detectors.openpose_onnx_detector:OpenPoseOnnxDetector",
            f"replay = {PACKAGE}.detectors.openpose_json_detector:ReplayDetector",
        ],
        "teo_skeleton_retriever.retrievers": [
            f"skeleton_retriever = {PACKAGE}.compat.compat_retriever:compat_retriever",
        ],
    },
)
