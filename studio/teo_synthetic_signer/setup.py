# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from setuptools import find_packages, setup

PACKAGE = "teo_synthetic_signer"

setup(
    name=PACKAGE,
    version="0.2.0",
    packages=find_packages(exclude=["test", "test.*"]),
    package_data={PACKAGE: ["*.pyi", "py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
    ],
    install_requires=[
        "anny",
        "embreex",
        "lazy-loader",
        "numpy",
        "opencv-python-headless",
        "pydantic",
        "PyYAML",
        "rich",
        "rosbags",
        "scipy",
        "typer",
    ],
    zip_safe=False,
    maintainer="TEO signing project",
    maintainer_email="teo-sign@example.org",
    description="People who sign before a depth camera, rendered, with the exact place of every keypoint.",
    license="Apache-2.0",
    extras_require={"test": ["pytest"]},
    entry_points={
        "console_scripts": [
            "synthesize = teo_synthetic_signer.cli.synthesize_cli:main",
            "sensor_study = teo_synthetic_signer.cli.sensor_study:main",
        ],
        # What `ros2 run teo_skeleton_retriever NAME` runs.
        "teo.commands": [
            "synthesize = teo_synthetic_signer.cli.synthesize_cli:main",
            "sensor_study = teo_synthetic_signer.cli.sensor_study:main",
        ],
    },
)
